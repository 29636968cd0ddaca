// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/discretization/contact_surface.h"
#include "signorini/discretization/discretization.h"

#include <array>
#include <vector>

namespace signorini
{
/// An outer face of a cell with all that a rank needs to know of it which has no such cell.
template <int dim>
struct OuterFacet
{
  struct Node
  {
    std::array<dealii::types::global_dof_index, dim> dofs;
    SpatialVector<dim> position; ///< undeformed [m]
  };

  Facet<dim> facet; ///< its nodes count those below
  std::vector<Node> nodes;

  /// Appends it to plain numbers, as which it travels between ranks.
  void pack(std::vector<double> &packed) const;

  /// Takes it from there; moves on behind it.
  static OuterFacet unpack(std::vector<double>::const_iterator &value);
};

/// The outer faces of this rank's cells, in their order, without moduli and numbers.
///
/// Facets of simplices have the mean thickness around them, by area: over the facets at each node that face
/// the same way within 30°, then over the nodes. Heights of simplices differ at random from one to the next,
/// and under one pressure depths would differ as they do.
template <int dim>
std::vector<OuterFacet<dim>> collect_outer_facets(const Discretization<dim> &discretization);
} // namespace signorini
