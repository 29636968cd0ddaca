// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/discretization/node_map.h"

#include <deal.II/base/mpi.h>

#include <map>

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
  const Vector layout = discretization->make_vector();
  for (unsigned int node = 0; node < dofs.size(); ++node)
    if (discretization->owned_dofs.is_element(dofs[node][0]))
    {
      std::array<unsigned int, dim> local;
      for (unsigned int d = 0; d < dim; ++d)
        local[d] = layout.get_partitioner()->global_to_local(dofs[node][d]);
      owned_nodes.emplace_back(node, local);
    }
  gather_constraints();
  find_masters();
}

template <int dim>
void NodeMap<dim>::find_masters()
{
  // All components of a node hang alike: the first speaks for them.
  std::map<dealii::types::global_dof_index, unsigned int> node_of_dof;
  node_masters.resize(dofs.size());
  for (unsigned int node = 0; node < dofs.size(); ++node)
  {
    node_of_dof[dofs[node][0]] = node;
    node_masters[node] = {{node, 1.}};
  }
  for (const auto &line : lines)
    if (const auto hanging = node_of_dof.find(line.index); hanging != node_of_dof.end())
    {
      node_masters[hanging->second].clear();
      for (const auto &[master, weight] : line.entries)
        node_masters[hanging->second].emplace_back(node_of_dof.at(master), weight);
    }
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
void NodeMap<dim>::gather_constraints()
{
  std::vector<double> packed;
  for (const auto &[node, local] : owned_nodes)
    for (const dealii::types::global_dof_index dof : dofs[node])
      if (discretization->hanging_constraints.is_constrained(dof))
      {
        const auto &entries = *discretization->hanging_constraints.get_constraint_entries(dof);
        packed.push_back(static_cast<double>(dof));
        packed.push_back(static_cast<double>(entries.size()));
        for (const auto &[master, weight] : entries)
        {
          packed.push_back(static_cast<double>(master));
          packed.push_back(weight);
        }
      }
  all_relevant_dofs = discretization->relevant_dofs;
  for (const auto &node_dofs : dofs)
    for (const dealii::types::global_dof_index dof : node_dofs)
      all_relevant_dofs.add_index(dof);
  for (const auto &of_rank : dealii::Utilities::MPI::all_gather(discretization->communicator(), packed))
    for (auto value = of_rank.begin(); value != of_rank.end();)
    {
      typename dealii::AffineConstraints<double>::ConstraintLine line;
      line.index = static_cast<dealii::types::global_dof_index>(*value++);
      const auto n_entries = static_cast<unsigned int>(*value++);
      for (unsigned int i = 0; i < n_entries; ++i)
      {
        const auto master = static_cast<dealii::types::global_dof_index>(*value++);
        line.entries.emplace_back(master, *value++);
        all_relevant_dofs.add_index(master);
      }
      lines.push_back(line);
    }
}

template <int dim>
std::vector<SpatialVector<dim>> NodeMap<dim>::gather(const Vector &values) const
{
  std::vector<SpatialVector<dim>> gathered(dofs.size(), SpatialVector<dim>::Zero());
  for (const auto &[node, local] : owned_nodes)
    for (unsigned int d = 0; d < dim; ++d)
      gathered[node][d] = values.local_element(local[d]);
  if (dealii::Utilities::MPI::n_mpi_processes(discretization->communicator()) > 1)
    MPI_Allreduce(MPI_IN_PLACE, gathered.data(), static_cast<int>(dim * gathered.size()), MPI_DOUBLE, MPI_SUM,
                  discretization->communicator());
  return gathered;
}

template <int dim>
void NodeMap<dim>::add_to_owners(const std::vector<SpatialVector<dim>> &nodal_forces, Vector &forces) const
{
  const std::vector<SpatialVector<dim>> *total = &nodal_forces;
  std::vector<SpatialVector<dim>> summed;
  if (dealii::Utilities::MPI::n_mpi_processes(discretization->communicator()) > 1)
  {
    summed = nodal_forces;
    MPI_Allreduce(MPI_IN_PLACE, summed.data(), static_cast<int>(dim * summed.size()), MPI_DOUBLE, MPI_SUM,
                  discretization->communicator());
    total = &summed;
  }
  for (const auto &[node, local] : owned_nodes)
    for (unsigned int d = 0; d < dim; ++d)
      forces.local_element(local[d]) += (*total)[node][d];
}

template <int dim>
void NodeMap<dim>::add_remote_hanging_constraints(dealii::AffineConstraints<double> &constraints) const
{
  for (const auto &line : lines)
    if (!constraints.is_constrained(line.index))
    {
      constraints.add_line(line.index);
      constraints.add_entries(line.index, line.entries);
    }
}

template <int dim>
SpatialVector<dim> move_to_middle(std::vector<SpatialVector<dim>> &positions)
{
  SpatialVector<dim> low = positions.at(0), high = low;
  for (const SpatialVector<dim> &x : positions)
  {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  const SpatialVector<dim> middle = 0.5 * (low + high);
  for (SpatialVector<dim> &x : positions)
    x -= middle;
  return middle;
}

template class NodeMap<2>;
template class NodeMap<3>;
template SpatialVector<2> move_to_middle(std::vector<SpatialVector<2>> &);
template SpatialVector<3> move_to_middle(std::vector<SpatialVector<3>> &);
} // namespace signorini
