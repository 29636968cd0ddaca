// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/base/spatial_vector.h"
#include "signorini/discretization/discretization.h"

#include <deal.II/base/partitioner.h>

#include <array>
#include <memory>
#include <vector>

namespace signorini
{
/// Joins a list of nodes, which each rank has its own of, to the degrees of freedom. What nodes have travels
/// between them and the ranks that own their degrees of freedom, in messages between these ranks only.
template <int dim>
class NodeMap
{
public:
  using NodeDofs = std::array<dealii::types::global_dof_index, dim>;

  /// Values of a distributed vector at the nodes (collective).
  std::vector<SpatialVector<dim>> gather(const Vector &values) const;

  /// Adds nodal forces, of which every rank holds a part, to their owners' entries (collective).
  void add_to_owners(const std::vector<SpatialVector<dim>> &nodal_forces, Vector &forces) const;

  /// Replaces what each rank has of a node by the sum, or the largest, of what all ranks have of it
  /// (collective).
  void sum(std::vector<SpatialVector<dim>> &nodal) const;
  void sum(std::vector<double> &nodal) const;
  void maximize(std::vector<double> &nodal) const;

  unsigned int n_nodes() const { return static_cast<unsigned int>(dofs.size()); }

  /// Global degrees of freedom of a node.
  const NodeDofs &node_dofs(unsigned int node) const { return dofs[node]; }

  /// A node, held or not, by its first degree of freedom, and its weight.
  using Master = std::pair<dealii::types::global_dof_index, double>;

  /// The nodes that a node hangs between; itself where it does not hang.
  const std::vector<Master> &masters(unsigned int node) const { return node_masters[node]; }

  /// Degrees of freedom of several nodes, one after the other.
  std::vector<dealii::types::global_dof_index> collect_dofs(const std::vector<unsigned int> &nodes) const;

  /// Adds the constraints of nodes that this rank has no cell at, so that forces between them can be
  /// assembled here. `constraints` must have been made for relevant_dofs().
  void add_remote_hanging_constraints(dealii::AffineConstraints<double> &constraints) const;

  /// Relevant to this rank's cells, or of the nodes, or a master of such.
  const dealii::IndexSet &relevant_dofs() const { return all_relevant_dofs; }

protected:
  explicit NodeMap(const Discretization<dim> &discretization);
  ~NodeMap() = default;

  /// Takes the nodes by their degrees of freedom, in the place of those before (collective).
  void set_nodes(std::vector<NodeDofs> node_dofs);

  /// Every node's value in place of all values but those of the first `n_known` nodes, which must be the same
  /// wherever they are among these (collective).
  void spread_known(unsigned int n_known, std::vector<SpatialVector<dim>> &nodal) const;

  const Discretization<dim> *discretization;

private:
  using Line = typename dealii::AffineConstraints<double>::ConstraintLine;

  void number_entries();
  /// Asks for the constraints of the nodes those who know them.
  void find_hanging_lines();
  void find_masters();
  std::vector<double> pack_lines(const std::vector<dealii::types::global_dof_index> &of_dofs) const;
  void unpack_lines(const std::vector<double> &packed);

  /// Values at the nodes of an array of owned entries.
  std::vector<SpatialVector<dim>> fetch(const dealii::ArrayView<const double> &owned) const;
  /// Combines nodal values with an array of owned entries.
  void give(const std::vector<SpatialVector<dim>> &nodal, dealii::VectorOperation::values operation,
            const dealii::ArrayView<double> &owned) const;
  void reduce(std::vector<SpatialVector<dim>> &nodal, dealii::VectorOperation::values operation) const;
  void reduce(std::vector<double> &nodal, dealii::VectorOperation::values operation) const;

  std::vector<NodeDofs> dofs;
  std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner; ///< its ghosts: those of the nodes
  std::vector<std::array<unsigned int, dim>> entries;                     ///< of the nodes in it
  std::vector<Line> lines;                                                ///< of the nodes that hang
  std::vector<std::vector<Master>> node_masters;
  dealii::IndexSet all_relevant_dofs;
};

/// Moves the positions of all ranks so that the middle of their bounding box is the origin; returns where
/// that was [m]. The same on any number of ranks to the last digit (collective).
template <int dim>
SpatialVector<dim> move_to_middle(std::vector<SpatialVector<dim>> &positions, const MPI_Comm &communicator);
} // namespace signorini
