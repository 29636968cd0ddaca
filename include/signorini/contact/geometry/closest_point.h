// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/geometry/facet_shape.h"

namespace signorini::contact
{
/// The point of one facet that is closest to a given point.
template <int dim>
struct ClosestPoint
{
  LocalPoint<dim> xi;          ///< its local coordinates, on a side or in a corner exactly where held there
  SpatialVector<dim> position; ///< the foot y(ξ)
  double distance = 0.;        ///< |x − y|

  template <typename Archive>
  void serialize(Archive &archive, unsigned int /*version*/)
  {
    archive &xi &position &distance;
  }
};

/// Minimises |x − y(ξ)| over the facet, its edges and its corners, to round-off. Robust for warped and
/// strongly curved facets: starts from several points where one start is not safe.
template <int dim>
ClosestPoint<dim> find_closest_point(const FacetNodes<dim> &nodes, const SpatialVector<dim> &x);
} // namespace signorini::contact
