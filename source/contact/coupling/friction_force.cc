// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/coupling/friction_force.h"

#include <deal.II/base/mpi.h>

#include <utility>

namespace signorini
{
template <int dim>
FrictionForce<dim>::FrictionForce(const ContactForce<dim> &surface_contact, double coefficient,
                                  contact::SlidUnder slid_under, const MPI_Comm &mpi_communicator)
    : contact(&surface_contact), friction(surface_contact.surface_potential(), coefficient, slid_under),
      communicator(mpi_communicator)
{
}

template <int dim>
void FrictionForce<dim>::update(const Vector &velocity)
{
  follow_surface();
  if (contact->surface_potential().is_linear())
    friction.follow();
  else
    friction.evaluate(contact->nodes().gather(velocity));
}

template <int dim>
void FrictionForce<dim>::follow_surface()
{
  if (std::exchange(n_searches_of_memory, contact->n_searches()) != contact->n_searches() &&
      friction.has_memory())
    friction.set_positions_of_last_commit(contact->nodes().extend(friction.positions_of_last_commit()));
}

template <int dim>
void FrictionForce<dim>::add_points(double least, contact::ContactProblem<dim> &problem) const
{
  friction.for_each_linear_point(least, [&](const contact::LinearPoint<dim> &point)
                                 { contact->add_point(point, problem); });
}

template <int dim>
double FrictionForce<dim>::energy() const
{
  return dealii::Utilities::MPI::sum(friction.energy(), communicator);
}

template <int dim>
double FrictionForce<dim>::held_energy() const
{
  return dealii::Utilities::MPI::sum(friction.held_energy(), communicator);
}

template <int dim>
void FrictionForce<dim>::add_force(Vector &force) const
{
  std::vector<SpatialVector<dim>> nodal(contact->nodes().n_nodes(), SpatialVector<dim>::Zero());
  friction.add_forces(nodal);
  contact->nodes().add_to_owners(nodal, force);
}

template <int dim>
void FrictionForce<dim>::add_tangent(TangentSystem &system) const
{
  friction.for_each_tangent([&](const std::vector<unsigned int> &nodes, const Eigen::MatrixXd &block)
                            { contact->add_block(nodes, block, system); });
}

template <int dim>
double FrictionForce<dim>::commit()
{
  return dealii::Utilities::MPI::sum(friction.commit(), communicator);
}

template <int dim>
std::vector<contact::PlacedSlip<dim>> FrictionForce<dim>::placed_slips() const
{
  constexpr unsigned int n_numbers = 3 + 3 * dim;
  std::vector<double> packed;
  for (const contact::PlacedSlip<dim> &own : friction.placed_slips())
  {
    const auto [body, target, is_on_obstacle] = own.partners;
    packed.insert(packed.end(), {double(body), double(target), is_on_obstacle ? 1. : 0.});
    for (const SpatialVector<dim> &vector :
         {SpatialVector<dim>(own.position + contact->surface().origin), own.slip.elastic, own.slip.normal})
      packed.insert(packed.end(), vector.begin(), vector.end());
  }
  std::vector<contact::PlacedSlip<dim>> slips;
  for (const std::vector<double> &of_rank : dealii::Utilities::MPI::all_gather(communicator, packed))
    for (std::size_t i = 0; i < of_rank.size(); i += n_numbers)
    {
      const double *number = &of_rank[i];
      const auto vector = [number](unsigned int index)
      { return Eigen::Map<const SpatialVector<dim>>(number + 3 + dim * index); };
      slips.push_back(
          {{static_cast<unsigned int>(number[0]), static_cast<unsigned int>(number[1]), number[2] > 0.},
           vector(0),
           {vector(1), vector(2)}});
    }
  return slips;
}

template <int dim>
void FrictionForce<dim>::remember(std::vector<contact::PlacedSlip<dim>> slips)
{
  for (contact::PlacedSlip<dim> &placed : slips)
    placed.position -= contact->surface().origin;
  friction.remember(std::move(slips));
}

template class FrictionForce<2>;
template class FrictionForce<3>;
} // namespace signorini
