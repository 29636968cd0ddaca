// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace signorini::contact
{
/// Points and a facet of degree 1 in 3-D for each, component by component, so that the points of a batch are
/// treated side by side.
struct InnerFeetBatch
{
  static constexpr int size = 8;
  using Numbers = double[size];

  // Given.
  Numbers node[4][3]; ///< in the order of Facet::nodes; the fourth of a triangle makes it a parallelogram [m]
  Numbers point[3];   ///< x [m]
  Numbers rim;        ///< of a triangle 0; of a quadrilateral 2

  // Found, for each point by itself: no digit depends on the others.
  Numbers s[2];      ///< 2ξ − 1
  Numbers normal[3]; ///< outward unit normal at the foot
  Numbers depth;     ///< (y − x)·n [m]
  Numbers is_inner;  ///< 1 where this is the closest point of the facet and lies off its sides, else 0
};

/// Finds the feet of points on the insides of facets: by Newton's method for the least distance, as
/// find_closest_point() does, where that is surely convex over the facet. Says where there is none such.
void find_inner_feet(InnerFeetBatch &batch);
} // namespace signorini::contact
