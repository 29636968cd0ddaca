// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/geometry/depth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace signorini::contact
{
namespace
{
/// A line from one place to another, with the outside to its right.
Facet<2> add_line(const SpatialVector<2> &from, const SpatialVector<2> &to,
                  std::vector<SpatialVector<2>> &positions)
{
  Facet<2> facet;
  for (unsigned int i = 0; i < 2; ++i)
  {
    facet.nodes[i] = static_cast<unsigned int>(positions.size());
    positions.push_back(i == 0 ? from : to);
  }
  return facet;
}

/// Of the flanks of a spike that points down, for a point on its middle axis, whichever comes first and
/// whatever round-off makes of their distances.
TEST(Facing, ChoosesAmongEquallyCloseFacets)
{
  const SpatialVector<2> tip(.3, .7), left(.2, 1.7), right(.4, 1.7);
  const unsigned int flanks[] = {0, 1};
  for (const bool left_comes_first : {true, false})
    for (const bool looks_left : {true, false})
      for (const double beside : {0., 1e-13, -1e-13})
      {
        std::vector<SpatialVector<2>> positions;
        std::vector<Facet<2>> facets;
        for (const bool is_left : {left_comes_first, !left_comes_first})
          facets.push_back(is_left ? add_line(left, tip, positions) : add_line(tip, right, positions));
        const SpatialVector<2> below(.3, .6), above(.3, .8);
        facets.push_back(looks_left ? add_line(above, below, positions) : add_line(below, above, positions));
        const SurfacePlace<2> contactor{2, LocalPoint<2>::Constant(.5)};
        const SurfaceFoot<2> foot = find_foot(facets, positions, flanks, 2, {.3 + beside, .75},
                                              std::numeric_limits<double>::infinity(), &contactor);
        // The outside of the left flank is on the left: it faces what looks to the right.
        EXPECT_EQ(foot.facet == 0, looks_left != left_comes_first);
        EXPECT_NEAR(foot.depth, .05 * .1 / std::sqrt(1.01), 1e-11);
      }
}
} // namespace
} // namespace signorini::contact
