// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/coupling/volume_contact_force.h"

#include <deal.II/base/mpi.h>

namespace signorini
{
template <int dim>
VolumeContactForce<dim>::VolumeContactForce(const std::string &term_name, const VolumeMap<dim> &volume_map,
                                            const contact::VolumePotentialSettings &settings,
                                            const MPI_Comm &mpi_communicator)
    : ContactTerm<dim>(term_name, false, mpi_communicator), map(&volume_map),
      potential(volume_map.volume(), settings)
{
}

template <int dim>
double VolumeContactForce<dim>::renew(const State &state)
{
  const std::vector<SpatialVector<dim>> x = map->positions(state.displacement);
  const double jump = potential.update(x);
  potential.evaluate(x);
  return dealii::Utilities::MPI::sum(jump, this->communicator);
}

template <int dim>
void VolumeContactForce<dim>::update(const State &state)
{
  const std::vector<SpatialVector<dim>> x = map->positions(state.displacement);
  if (potential.is_stale(x))
    potential.update(x);
  potential.evaluate(x);
}

template <int dim>
double VolumeContactForce<dim>::energy() const
{
  return dealii::Utilities::MPI::sum(potential.energy(), this->communicator);
}

template <int dim>
void VolumeContactForce<dim>::add_force(Vector &force) const
{
  std::vector<SpatialVector<dim>> nodal(map->n_nodes(), SpatialVector<dim>::Zero());
  potential.add_forces(nodal);
  map->add_to_owners(nodal, force);
}

template <int dim>
void VolumeContactForce<dim>::add_couplings(const dealii::AffineConstraints<double> &constraints,
                                            dealii::TrilinosWrappers::SparsityPattern &pattern) const
{
  potential.for_each_coupling(
      [&](const std::vector<unsigned int> &nodes)
      { constraints.add_entries_local_to_global(map->collect_dofs(nodes), pattern, false); });
}

template <int dim>
void VolumeContactForce<dim>::add_tangent(TangentSystem &system) const
{
  potential.for_each_tangent([&](const std::vector<unsigned int> &nodes, const Eigen::MatrixXd &block)
                             { this->add_block(nodes, block, system); });
}

template <int dim>
void VolumeContactForce<dim>::add_row_sum_bounds(Vector &stiffness, Vector &) const
{
  std::vector<double> nodal(map->n_nodes(), 0.);
  potential.add_row_sum_bounds(nodal);
  this->spread(nodal, stiffness);
}

template <int dim>
contact::ContactMeasures<dim> VolumeContactForce<dim>::measure() const
{
  return this->sum(potential.measure(), map->volume().origin);
}

template <int dim>
contact::PairForces<dim> VolumeContactForce<dim>::pair_forces(const State &) const
{
  return this->sum(potential.pair_forces());
}

template <int dim>
std::vector<unsigned int> VolumeContactForce<dim>::cells_of_pairs() const
{
  std::vector<unsigned int> cells;
  for (const auto &pair : potential.pairs())
    cells.push_back(map->cell_of(pair.first));
  return cells;
}

template class VolumeContactForce<2>;
template class VolumeContactForce<3>;
} // namespace signorini
