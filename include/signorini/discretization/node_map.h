// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/base/spatial_vector.h"
#include "signorini/discretization/discretization.h"

#include <array>
#include <vector>

namespace signorini
{
/// Joins a list of nodes, which every rank holds whole, to the degrees of freedom.
template <int dim>
class NodeMap
{
public:
  using NodeDofs = std::array<dealii::types::global_dof_index, dim>;

  /// Values of a distributed vector at the nodes, known to all ranks after the call (collective).
  std::vector<SpatialVector<dim>> gather(const Vector &values) const;

  /// Adds nodal forces, of which every rank holds a part, to their owners' entries (collective).
  void add_to_owners(const std::vector<SpatialVector<dim>> &nodal_forces, Vector &forces) const;

  unsigned int n_nodes() const { return static_cast<unsigned int>(dofs.size()); }

  /// Global degrees of freedom of a node.
  const NodeDofs &node_dofs(unsigned int node) const { return dofs[node]; }

  /// The nodes that a node hangs between, with their weights; itself where it does not hang.
  const std::vector<std::pair<unsigned int, double>> &masters(unsigned int node) const
  {
    return node_masters[node];
  }

  /// Those of several nodes, one after the other.
  std::vector<dealii::types::global_dof_index> collect_dofs(const std::vector<unsigned int> &nodes) const;

  /// Adds the constraints of nodes that this rank has no cell at, so that forces between them can be
  /// assembled here. `constraints` must have been made for relevant_dofs().
  void add_remote_hanging_constraints(dealii::AffineConstraints<double> &constraints) const;

  /// Relevant to this rank's cells, or of the nodes, or a master of such.
  const dealii::IndexSet &relevant_dofs() const { return all_relevant_dofs; }

protected:
  explicit NodeMap(const Discretization<dim> &discretization);
  ~NodeMap() = default;

  /// Takes the nodes by their degrees of freedom, the same on every rank (collective).
  void set_nodes(std::vector<NodeDofs> node_dofs);

  const Discretization<dim> *discretization;

private:
  void gather_constraints();
  void find_masters();

  std::vector<NodeDofs> dofs;
  std::vector<std::pair<unsigned int, std::array<unsigned int, dim>>> owned_nodes; ///< node, local indices
  std::vector<typename dealii::AffineConstraints<double>::ConstraintLine> lines;
  std::vector<std::vector<std::pair<unsigned int, double>>> node_masters;
  dealii::IndexSet all_relevant_dofs;
};

/// Moves positions so that the middle of their bounding box is the origin; returns where that was [m].
template <int dim>
SpatialVector<dim> move_to_middle(std::vector<SpatialVector<dim>> &positions);
} // namespace signorini
