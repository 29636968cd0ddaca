// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/geometry/inner_feet.h"

#include "facet_samples.h"
#include "signorini/contact/geometry/closest_point.h"
#include "signorini/contact/geometry/local_domain.h"

#include <gtest/gtest.h>

using namespace signorini;
using namespace signorini::contact;
using namespace signorini::contact::testing;

namespace
{
/// A facet of side 1 about the origin, bent by up to `bend`.
FacetNodes<3> make_facet(FacetType type, double bend, Dice &dice)
{
  FacetNodes<3> nodes;
  nodes.degree = 1;
  nodes.type = type;
  const SpatialTensor<3> rotation = dice.rotation<3>();
  for (unsigned int a = 0; a < nodes.n_nodes(); ++a)
  {
    const LocalPoint<3> xi = node_coordinates<3>(nodes, a);
    const SpatialVector<3> flat(xi[0] - .5, xi[1] - .5, 0.);
    nodes.position[a] = rotation * (flat + dice.point<3>(-bend, bend));
  }
  return nodes;
}

void put(const FacetNodes<3> &nodes, const SpatialVector<3> &x, int i, InnerFeetBatch &batch)
{
  const bool is_triangle = nodes.type == FacetType::triangle;
  for (int d = 0; d < 3; ++d)
  {
    for (int a = 0; a < 3; ++a)
      batch.node[a][d][i] = nodes.position[a][d];
    batch.node[3][d][i] = is_triangle ? nodes.position[1][d] + nodes.position[2][d] - nodes.position[0][d]
                                      : nodes.position[3][d];
    batch.point[d][i] = x[d];
  }
  batch.rim[i] = is_triangle ? 0. : 2.;
}

void expect_closest_points(FacetType type, double bend, double least_share)
{
  Dice dice(3);
  const unsigned int n_batches = count_cases(500);
  unsigned int n_inner = 0, n_off_sides = 0;
  for (unsigned int n = 0; n < n_batches; ++n)
  {
    InnerFeetBatch batch{};
    std::array<ClosestPoint<3>, InnerFeetBatch::size> closest;
    std::array<FacetNodes<3>, InnerFeetBatch::size> nodes;
    std::array<SpatialVector<3>, InnerFeetBatch::size> x;
    for (int i = 0; i < InnerFeetBatch::size; ++i)
    {
      nodes[i] = make_facet(type, bend, dice);
      x[i] = dice.point<3>(-.5, .5);
      closest[i] = find_closest_point(nodes[i], x[i]);
      put(nodes[i], x[i], i, batch);
    }
    find_inner_feet(batch);
    for (int i = 0; i < InnerFeetBatch::size; ++i)
    {
      const LocalPoint<3> xi(.5 * (1. + batch.s[0][i]), .5 * (1. + batch.s[1][i]));
      const bool is_off_sides = find_local_place(nodes[i], closest[i].xi, 2e-6).n_free == 2;
      n_off_sides += is_off_sides;
      if (batch.is_inner[i] == 0.)
        continue;
      ++n_inner;
      EXPECT_TRUE(find_local_place(nodes[i], closest[i].xi, 1e-7).n_free == 2);
      EXPECT_LT((xi - closest[i].xi).norm(), 1e-11);
      EXPECT_NEAR(std::abs(batch.depth[i]), closest[i].distance, 1e-12);
      const SpatialVector<3> normal(batch.normal[0][i], batch.normal[1][i], batch.normal[2][i]);
      const SpatialVector<3> expected =
          evaluate_facet_frame(nodes[i], closest[i].xi).area_normal.normalized();
      EXPECT_LT((normal - expected).norm(), 1e-11);
      EXPECT_NEAR(batch.depth[i], (closest[i].position - x[i]).dot(expected), 1e-12);
    }
  }
  EXPECT_GT(n_inner, least_share * n_off_sides);
  EXPECT_GT(n_off_sides, n_batches);
}
} // namespace

TEST(InnerFeet, AreTheClosestPointsOfFlatFacets)
{
  expect_closest_points(FacetType::triangle, .1, .999);
  expect_closest_points(FacetType::tensor_product, 0., .999);
}

TEST(InnerFeet, AreTheClosestPointsOfWarpedFacets)
{
  expect_closest_points(FacetType::tensor_product, .05, .3);
}
