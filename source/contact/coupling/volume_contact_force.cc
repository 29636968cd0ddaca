// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/coupling/volume_contact_force.h"

#include <deal.II/base/mpi.h>

#include <algorithm>

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
  std::vector<double> shares = potential.sunk_shares();
  dealii::Utilities::MPI::sum(shares, this->communicator, shares);
  return this->sum(potential.measure(shares), map->volume().origin);
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
    cells.push_back(map->volume().simplices[pair.first].cell - map->first_own_cell());
  return cells;
}

template <int dim>
std::vector<double> VolumeContactForce<dim>::cell_errors() const
{
  std::vector<double> errors(map->n_cells(), 0.);
  potential.add_cell_errors(errors);
  dealii::Utilities::MPI::sum(errors, this->communicator, errors);
  const auto first = errors.begin() + map->first_own_cell();
  return {first, first + map->n_own_cells()};
}

template <int dim>
std::set<std::vector<dealii::types::global_dof_index>> VolumeContactForce<dim>::faces_in_contact() const
{
  std::vector<std::vector<dealii::types::global_dof_index>> own;
  for (const std::vector<unsigned int> &nodes : potential.faces_in_contact())
  {
    own.emplace_back();
    for (const unsigned int node : nodes)
      own.back().push_back(map->node_dofs(node)[0]);
    std::sort(own.back().begin(), own.back().end());
  }
  std::set<std::vector<dealii::types::global_dof_index>> all;
  for (const auto &of_rank : dealii::Utilities::MPI::all_gather(this->communicator, own))
    all.insert(of_rank.begin(), of_rank.end());
  return all;
}

template class VolumeContactForce<2>;
template class VolumeContactForce<3>;
} // namespace signorini
