// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/discretization/node_map.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>
#include <map>
#include <unordered_map>

namespace signorini
{
template <int dim>
NodeMap<dim>::NodeMap(const Discretization<dim> &the_discretization) : discretization(&the_discretization)
{
}

template <int dim>
void NodeMap<dim>::set_nodes(std::vector<NodeDofs> node_dofs)
{
  dofs = std::move(node_dofs);
  number_entries();
  all_relevant_dofs = discretization->relevant_dofs;
  all_relevant_dofs.add_indices(partitioner->ghost_indices());
  find_hanging_lines();
  find_masters();
  all_relevant_dofs.compress();
}

template <int dim>
void NodeMap<dim>::number_entries()
{
  std::vector<dealii::types::global_dof_index> remote;
  for (const NodeDofs &node_dofs : dofs)
    for (const dealii::types::global_dof_index dof : node_dofs)
      if (!discretization->owned_dofs.is_element(dof))
        remote.push_back(dof);
  std::sort(remote.begin(), remote.end());
  dealii::IndexSet ghosts(discretization->owned_dofs.size());
  ghosts.add_indices(remote.begin(), std::unique(remote.begin(), remote.end()));
  ghosts.compress();
  partitioner = std::make_shared<dealii::Utilities::MPI::Partitioner>(discretization->owned_dofs, ghosts,
                                                                      discretization->communicator());
  entries.clear();
  for (const NodeDofs &node_dofs : dofs)
  {
    entries.emplace_back();
    for (unsigned int d = 0; d < dim; ++d)
      entries.back()[d] = partitioner->global_to_local(node_dofs[d]);
  }
}

template <int dim>
void NodeMap<dim>::find_hanging_lines()
{
  lines.clear();
  const MPI_Comm &communicator = discretization->communicator();
  if (dealii::Utilities::MPI::max(discretization->hanging_dofs.size(), communicator) == 0)
    return;
  using Dofs = std::vector<dealii::types::global_dof_index>;
  const dealii::IndexSet &ghosts = partitioner->ghost_indices();
  const std::vector<unsigned int> owners =
      dealii::Utilities::MPI::compute_index_owner(discretization->owned_dofs, ghosts, communicator);
  std::map<unsigned int, Dofs> wanted;
  for (std::size_t i = 0; i < owners.size(); ++i)
    wanted[owners[i]].push_back(ghosts.nth_index_in_set(i));
  std::map<unsigned int, std::vector<double>> known;
  for (const auto &[rank, of_dofs] : dealii::Utilities::MPI::some_to_some(communicator, wanted))
    known[rank] = pack_lines(of_dofs);
  for (const auto &[rank, packed] : dealii::Utilities::MPI::some_to_some(communicator, known))
    unpack_lines(packed);
  Dofs owned;
  for (const NodeDofs &node_dofs : dofs)
    std::copy_if(node_dofs.begin(), node_dofs.end(), std::back_inserter(owned),
                 [&](auto dof) { return discretization->owned_dofs.is_element(dof); });
  unpack_lines(pack_lines(owned));
}

template <int dim>
std::vector<double>
NodeMap<dim>::pack_lines(const std::vector<dealii::types::global_dof_index> &of_dofs) const
{
  std::vector<double> packed;
  for (const dealii::types::global_dof_index dof : of_dofs)
    if (const auto *masters = discretization->hanging_constraints.get_constraint_entries(dof))
    {
      packed.insert(packed.end(), {static_cast<double>(dof), static_cast<double>(masters->size())});
      for (const auto &[master, weight] : *masters)
        packed.insert(packed.end(), {static_cast<double>(master), weight});
    }
  return packed;
}

template <int dim>
void NodeMap<dim>::unpack_lines(const std::vector<double> &packed)
{
  for (auto value = packed.begin(); value != packed.end();)
  {
    Line line;
    line.index = static_cast<dealii::types::global_dof_index>(*value++);
    const auto n_masters = static_cast<unsigned int>(*value++);
    for (unsigned int i = 0; i < n_masters; ++i)
    {
      const auto master = static_cast<dealii::types::global_dof_index>(*value++);
      line.entries.emplace_back(master, *value++);
      all_relevant_dofs.add_index(master);
    }
    lines.push_back(line);
  }
}

template <int dim>
void NodeMap<dim>::find_masters()
{
  // All components of a node hang alike: the first speaks for them.
  std::unordered_map<dealii::types::global_dof_index, const Line *> line_of_dof;
  for (const Line &line : lines)
    line_of_dof[line.index] = &line;
  node_masters.assign(dofs.size(), {});
  for (unsigned int node = 0; node < dofs.size(); ++node)
    if (const auto hanging = line_of_dof.find(dofs[node][0]); hanging != line_of_dof.end())
      node_masters[node].assign(hanging->second->entries.begin(), hanging->second->entries.end());
    else
      node_masters[node] = {{dofs[node][0], 1.}};
}

template <int dim>
std::vector<dealii::types::global_dof_index>
NodeMap<dim>::collect_dofs(const std::vector<unsigned int> &nodes) const
{
  std::vector<dealii::types::global_dof_index> collected;
  for (const unsigned int node : nodes)
    collected.insert(collected.end(), dofs[node].begin(), dofs[node].end());
  return collected;
}

template <int dim>
std::vector<SpatialVector<dim>> NodeMap<dim>::fetch(const dealii::ArrayView<const double> &owned) const
{
  std::vector<double> ghosts(partitioner->n_ghost_indices()), sent(partitioner->n_import_indices());
  std::vector<MPI_Request> requests;
  partitioner->template export_to_ghosted_array_start<double, dealii::MemorySpace::Host>(
      0, owned, dealii::make_array_view(sent), dealii::make_array_view(ghosts), requests);
  partitioner->template export_to_ghosted_array_finish<double, dealii::MemorySpace::Host>(
      dealii::make_array_view(ghosts), requests);
  std::vector<SpatialVector<dim>> nodal(dofs.size());
  const unsigned int n_owned = partitioner->locally_owned_size();
  for (unsigned int node = 0; node < dofs.size(); ++node)
    for (unsigned int d = 0; d < dim; ++d)
    {
      const unsigned int entry = entries[node][d];
      nodal[node][d] = entry < n_owned ? owned[entry] : ghosts[entry - n_owned];
    }
  return nodal;
}

template <int dim>
void NodeMap<dim>::give(const std::vector<SpatialVector<dim>> &nodal,
                        const dealii::VectorOperation::values operation,
                        const dealii::ArrayView<double> &owned) const
{
  const bool is_sum = operation == dealii::VectorOperation::add;
  std::vector<double> ghosts(partitioner->n_ghost_indices(),
                             is_sum ? 0. : std::numeric_limits<double>::lowest()),
      received(partitioner->n_import_indices());
  const unsigned int n_owned = partitioner->locally_owned_size();
  for (unsigned int node = 0; node < dofs.size(); ++node)
    for (unsigned int d = 0; d < dim; ++d)
    {
      const unsigned int entry = entries[node][d];
      double &value = entry < n_owned ? owned[entry] : ghosts[entry - n_owned];
      value = is_sum ? value + nodal[node][d] : std::max(value, nodal[node][d]);
    }
  std::vector<MPI_Request> requests;
  partitioner->template import_from_ghosted_array_start<double, dealii::MemorySpace::Host>(
      operation, 0, dealii::make_array_view(ghosts), dealii::make_array_view(received), requests);
  partitioner->template import_from_ghosted_array_finish<double, dealii::MemorySpace::Host>(
      operation, dealii::ArrayView<const double>(received.data(), received.size()), owned,
      dealii::make_array_view(ghosts), requests);
}

template <int dim>
void NodeMap<dim>::reduce(std::vector<SpatialVector<dim>> &nodal,
                          const dealii::VectorOperation::values operation) const
{
  const bool is_sum = operation == dealii::VectorOperation::add;
  std::vector<double> owned(partitioner->locally_owned_size(),
                            is_sum ? 0. : std::numeric_limits<double>::lowest());
  give(nodal, operation, dealii::make_array_view(owned));
  nodal = fetch(dealii::ArrayView<const double>(owned.data(), owned.size()));
}

template <int dim>
void NodeMap<dim>::reduce(std::vector<double> &nodal, const dealii::VectorOperation::values operation) const
{
  std::vector<SpatialVector<dim>> equal;
  for (const double value : nodal)
    equal.push_back(SpatialVector<dim>::Constant(value));
  reduce(equal, operation);
  for (unsigned int node = 0; node < nodal.size(); ++node)
    nodal[node] = equal[node][0];
}

template <int dim>
void NodeMap<dim>::sum(std::vector<SpatialVector<dim>> &nodal) const
{
  reduce(nodal, dealii::VectorOperation::add);
}

template <int dim>
void NodeMap<dim>::sum(std::vector<double> &nodal) const
{
  reduce(nodal, dealii::VectorOperation::add);
}

template <int dim>
void NodeMap<dim>::maximize(std::vector<double> &nodal) const
{
  reduce(nodal, dealii::VectorOperation::max);
}

template <int dim>
void NodeMap<dim>::spread_known(unsigned int n_known, std::vector<SpatialVector<dim>> &nodal) const
{
  nodal.resize(n_known);
  nodal.resize(dofs.size(), SpatialVector<dim>::Constant(std::numeric_limits<double>::lowest()));
  reduce(nodal, dealii::VectorOperation::max);
}

template <int dim>
std::vector<SpatialVector<dim>> NodeMap<dim>::gather(const Vector &values) const
{
  return fetch(dealii::ArrayView<const double>(values.begin(), values.locally_owned_size()));
}

template <int dim>
void NodeMap<dim>::add_to_owners(const std::vector<SpatialVector<dim>> &nodal_forces, Vector &forces) const
{
  give(nodal_forces, dealii::VectorOperation::add,
       dealii::ArrayView<double>(forces.begin(), forces.locally_owned_size()));
}

template <int dim>
void NodeMap<dim>::add_remote_hanging_constraints(dealii::AffineConstraints<double> &constraints) const
{
  for (const Line &line : lines)
    if (!constraints.is_constrained(line.index))
    {
      constraints.add_line(line.index);
      constraints.add_entries(line.index, line.entries);
    }
}

template <int dim>
SpatialVector<dim> move_to_middle(std::vector<SpatialVector<dim>> &positions, const MPI_Comm &communicator)
{
  SpatialVector<dim> high = SpatialVector<dim>::Constant(std::numeric_limits<double>::lowest()), low = -high;
  for (const SpatialVector<dim> &x : positions)
  {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  MPI_Allreduce(MPI_IN_PLACE, low.data(), dim, MPI_DOUBLE, MPI_MIN, communicator);
  MPI_Allreduce(MPI_IN_PLACE, high.data(), dim, MPI_DOUBLE, MPI_MAX, communicator);
  const SpatialVector<dim> middle = 0.5 * (low + high);
  for (SpatialVector<dim> &x : positions)
    x -= middle;
  return middle;
}

template class NodeMap<2>;
template class NodeMap<3>;
template SpatialVector<2> move_to_middle(std::vector<SpatialVector<2>> &, const MPI_Comm &);
template SpatialVector<3> move_to_middle(std::vector<SpatialVector<3>> &, const MPI_Comm &);
} // namespace signorini
