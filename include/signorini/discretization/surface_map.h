// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/discretization/contact_surface.h"
#include "signorini/discretization/discretization.h"
#include "signorini/discretization/supports.h"

#include <array>

namespace signorini
{
/// Joins the contact surface to the degrees of freedom. Every rank holds the whole surface.
template <int dim>
class SurfaceMap
{
public:
  /// Collects the outer faces of all bodies.
  SurfaceMap(const Scene<dim> &scene, const Discretization<dim> &discretization);

  const ContactSurface<dim> &surface() const { return contact_surface; }

  /// Values of a distributed vector at the surface's nodes, known to all ranks after the call (collective).
  std::vector<SpatialVector<dim>> gather(const Vector &values) const;

  /// Positions of the surface's nodes under a displacement, relative to the surface's origin, known to all
  /// ranks after the call [m] (collective).
  std::vector<SpatialVector<dim>> positions(const Vector &displacement) const;

  /// Adds nodal forces, of which every rank holds a part, to their owners' entries (collective).
  void add_to_owners(const std::vector<SpatialVector<dim>> &nodal_forces, Vector &forces) const;

  /// Global degrees of freedom of a surface node.
  const std::array<dealii::types::global_dof_index, dim> &node_dofs(unsigned int node) const
  {
    return dofs[node];
  }

  /// Adds the constraints of surface nodes that this rank has no cell at, so that contact with them can be
  /// assembled here. `constraints` must have been made for relevant_dofs().
  void add_remote_hanging_constraints(dealii::AffineConstraints<double> &constraints) const;

  /// Relevant to this rank's cells, or of the surface, or a master of such.
  const dealii::IndexSet &relevant_dofs() const { return all_relevant_dofs; }

private:
  void number_nodes(const std::vector<std::vector<double>> &packed_facets, unsigned int this_rank);
  void move_origin();
  void gather_constraints();

  const Discretization<dim> *discretization;
  ContactSurface<dim> contact_surface;
  std::vector<std::array<dealii::types::global_dof_index, dim>> dofs;
  std::vector<std::pair<unsigned int, std::array<unsigned int, dim>>> owned_nodes; ///< node, local indices
  std::vector<typename dealii::AffineConstraints<double>::ConstraintLine> lines;
  dealii::IndexSet all_relevant_dofs;
};
} // namespace signorini
