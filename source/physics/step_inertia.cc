// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/physics/step_inertia.h"

namespace signorini
{
template <int dim>
StepInertia<dim>::StepInertia(const Vector &lumped_mass)
    : ForceTerm("inertia", Kind::load, false), mass(&lumped_mass)
{
}

template <int dim>
void StepInertia<dim>::set_step(const Vector &start_displacement, double step)
{
  start = start_displacement;
  time_step = step;
}

template <int dim>
void StepInertia<dim>::update(const State &state)
{
  way = state.displacement;
  way -= start;
}

template <int dim>
double StepInertia<dim>::energy() const
{
  double sum = 0.;
  for (unsigned int i = 0; i < mass->locally_owned_size(); ++i)
    sum += mass->local_element(i) * way.local_element(i) * way.local_element(i);
  return dealii::Utilities::MPI::sum(sum, way.get_mpi_communicator()) / (time_step * time_step);
}

template <int dim>
void StepInertia<dim>::add_force(Vector &force) const
{
  for (unsigned int i = 0; i < mass->locally_owned_size(); ++i)
    force.local_element(i) -= 2. / (time_step * time_step) * mass->local_element(i) * way.local_element(i);
}

template <int dim>
void StepInertia<dim>::add_tangent(TangentSystem &system) const
{
  const auto &partitioner = *mass->get_partitioner();
  for (unsigned int i = 0; i < mass->locally_owned_size(); ++i)
  {
    const dealii::types::global_dof_index dof = partitioner.local_to_global(i);
    if (!system.constraints->is_constrained(dof))
      system.matrix.add(dof, dof, 2. / (time_step * time_step) * mass->local_element(i));
  }
}

template <int dim>
ConstantForce<dim>::ConstantForce(const std::string &term_name) : ForceTerm(term_name, Kind::load, false)
{
}

template <int dim>
void ConstantForce<dim>::set(const Vector &force, const Vector &start_displacement)
{
  nodal = force;
  start = start_displacement;
}

template <int dim>
void ConstantForce<dim>::update(const State &state)
{
  Vector way = state.displacement;
  way -= start;
  work_to_do = -(nodal * way);
}

template <int dim>
void ConstantForce<dim>::add_force(Vector &force) const
{
  for (unsigned int i = 0; i < nodal.locally_owned_size(); ++i)
    force.local_element(i) += nodal.local_element(i);
}

template class StepInertia<2>;
template class StepInertia<3>;
template class ConstantForce<2>;
template class ConstantForce<3>;
} // namespace signorini
