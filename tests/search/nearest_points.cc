// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/search/nearest_points.h"

#include "../laws/box_surface.h"

#include <gtest/gtest.h>

using namespace signorini;

namespace
{
template <typename Dimension>
class NearestPoints : public testing::Test
{
};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(NearestPoints, Dimensions);

TYPED_TEST(NearestPoints, AreThoseOfBruteForce)
{
  constexpr int dim = TypeParam::value;
  test::RandomVectors<dim> random(1);
  const auto points = random.field(200, 1.), queries = random.field(100, 1.5);
  const auto nearest = contact::find_nearest_points<dim>(points, queries);
  ASSERT_EQ(nearest.size(), queries.size());
  for (std::size_t q = 0; q < queries.size(); ++q)
    for (const auto &point : points)
      EXPECT_LE((points[nearest[q]] - queries[q]).norm(), (point - queries[q]).norm());
}
} // namespace
