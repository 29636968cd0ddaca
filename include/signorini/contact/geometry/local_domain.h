// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/discretization/contact_surface.h"

// The local points of a facet: [0, 1] of a line, [0, 1]² of a quadrilateral, ξ_0, ξ_1 ≥ 0, ξ_0 + ξ_1 ≤ 1 of a
// triangle.
namespace signorini::contact
{
template <int dim>
using LocalTensor = Eigen::Matrix<double, dim - 1, dim - 1>;

/// Corners, and sides, of the domain of a facet in 3-D.
constexpr unsigned int n_local_corners(const FacetType type)
{
  return type == FacetType::triangle ? 3 : 4;
}

/// Corner `k` (modulo their number), counter-clockwise.
inline LocalPoint<3> local_corner(const FacetType type, const unsigned int k)
{
  if (type == FacetType::triangle)
    return {k % 3 == 1 ? 1. : 0., k % 3 == 2 ? 1. : 0.};
  return {k % 4 == 1 || k % 4 == 2 ? 1. : 0., k % 4 >= 2 ? 1. : 0.};
}

/// a_0 b_1 − a_1 b_0
inline double cross(const LocalPoint<3> &a, const LocalPoint<3> &b)
{
  return a[0] * b[1] - a[1] * b[0];
}

/// Where a point of the domain stands, and which ways lead on from it.
template <int dim>
struct LocalPlace
{
  unsigned int n_free = dim - 1; ///< directions that may be gone both ways: 0 at a corner, 1 on a side in 3-D

  /// A right-handed basis, one direction a column: those that are free first, the others may be gone forwards
  /// only. On a side the first runs along it, counter-clockwise. At a corner they run along its two sides,
  /// the next one first.
  LocalTensor<dim> directions = LocalTensor<dim>::Identity();
};

/// `tolerance`: how near to a side a point counts as lying on it.
template <int dim>
LocalPlace<dim> find_local_place(const FacetElement<dim> &element, const LocalPoint<dim> &xi,
                                 double tolerance);
} // namespace signorini::contact
