// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/discretization/contact_surface.h"

#include <Eigen/Geometry>

namespace signorini::contact
{
template <int dim>
using BoundingBox = Eigen::AlignedBox<double, dim>;

/// A box that holds the whole facet, not only its nodes: that of its Bernstein control points.
template <int dim>
BoundingBox<dim> make_facet_box(const Facet<dim> &facet, const std::vector<SpatialVector<dim>> &positions);

/// How far a point of a facet may move at most when its nodes move by one: the Lebesgue constant of the
/// facet's nodes, 1 for degree 1, 1.25 a direction for degree 2.
template <int dim>
constexpr double motion_factor(unsigned int degree)
{
  if (degree == 1)
    return 1.;
  return dim == 2 ? 1.25 : 1.25 * 1.25;
}
} // namespace signorini::contact
