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

/// Of a spike that points down with its left flank first or last, and a point on the surface of another body
/// that looks to the left or right: the foot beside the middle axis.
struct Spike
{
  Spike(bool left_comes_first, bool does_look_left)
  {
    const SpatialVector<2> tip(.3, .7), left(.2, 1.7), right(.4, 1.7), below(.3, .6), above(.3, .8);
    for (const bool is_left : {left_comes_first, !left_comes_first})
      facets.push_back(is_left ? add_line(left, tip, positions) : add_line(tip, right, positions));
    facets.push_back(does_look_left ? add_line(above, below, positions) : add_line(below, above, positions));
  }

  SurfaceFoot<2> find_foot_of(double aside, double height = .05) const
  {
    const std::vector<unsigned int> flanks = {0, 1};
    const SurfacePlace<2> contactor{2, LocalPoint<2>::Constant(.5)};
    return FootSearch<2>(facets, positions, flanks)
        .find({.3 + aside, .7 + height}, std::numeric_limits<double>::infinity(), &contactor);
  }

  static double depth(double toward, double height = .05) { return (.1 * height + toward) / std::sqrt(1.01); }

  std::vector<SpatialVector<2>> positions;
  std::vector<Facet<2>> facets;
};

/// The outside of the left flank is on the left: it faces what looks to the right. So it does whatever
/// round-off makes of the distances, and however little the other flank is closer.
TEST(Facing, OfFlanksTheOneThatIsLookedAt)
{
  for (const bool left_comes_first : {true, false})
    for (const bool looks_left : {true, false})
      for (const double aside : {0., 1e-13, -1e-13, 1e-9, -1e-9, 1e-5, -1e-5})
      {
        const SurfaceFoot<2> foot = Spike(left_comes_first, looks_left).find_foot_of(aside);
        EXPECT_EQ(foot.facet == 0, looks_left != left_comes_first);
        EXPECT_NEAR(foot.depth, Spike::depth(looks_left ? -aside : aside), 1e-15);
      }
}

TEST(Facing, OfFlanksTheCloserOneWhereTheOtherIsFar)
{
  for (const bool left_comes_first : {true, false})
    for (const bool looks_left : {true, false})
      for (const double aside : {1e-3, -1e-3})
      {
        const SurfaceFoot<2> foot = Spike(left_comes_first, looks_left).find_foot_of(aside);
        EXPECT_EQ(foot.facet == 0, (aside < 0.) == left_comes_first);
        EXPECT_NEAR(foot.depth, Spike::depth(-1e-3), 1e-15);
      }
}

TEST(Facing, MakesNothingOfPointsOutside)
{
  for (const bool looks_left : {true, false})
    for (const double aside : {1e-5, -1e-5})
      EXPECT_LT(Spike(true, looks_left).find_foot_of(aside, 5e-5).depth, 0.);
}
} // namespace
} // namespace signorini::contact
