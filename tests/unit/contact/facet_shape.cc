// SPDX-License-Identifier: LGPL-2.1-or-later
#include "facet_samples.h"

#include <gtest/gtest.h>

namespace signorini::contact
{
namespace
{
using testing::Dice;

template <typename Dimension>
class FacetShapeTest : public ::testing::Test
{
};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(FacetShapeTest, Dimensions);

TYPED_TEST(FacetShapeTest, IsOneAtItsNodeAndZeroAtTheOthers)
{
  constexpr int dim = TypeParam::value;
  for (const unsigned int degree : {1u, 2u})
  {
    const FacetNodes<dim> nodes = testing::make_unit_facet<dim>(degree);
    for (unsigned int i = 0; i < nodes.n_nodes; ++i)
    {
      const LocalPoint<dim> xi = nodes.position[i].template head<dim - 1>();
      const FacetShape<dim> shape = evaluate_facet_shape<dim>(degree, xi);
      ASSERT_EQ(shape.n_nodes, nodes.n_nodes);
      for (unsigned int j = 0; j < nodes.n_nodes; ++j)
        EXPECT_EQ(shape.value[j], i == j ? 1. : 0.);
    }
  }
}

TYPED_TEST(FacetShapeTest, SumsToOneAndDerivativesMatchDifferences)
{
  constexpr int dim = TypeParam::value;
  constexpr double step = 1e-5;
  Dice dice(1);
  for (unsigned int n = 0; n < 200; ++n)
  {
    const unsigned int degree = 1 + n % 2;
    const LocalPoint<dim> xi = dice.point<dim - 1>(0., 1.);
    const FacetShape<dim> shape = evaluate_facet_shape<dim>(degree, xi);
    double sum = 0.;
    for (const double value : shape.value)
      sum += value;
    EXPECT_NEAR(sum, 1., 1e-14);
    for (int b = 0; b < dim - 1; ++b)
    {
      const LocalPoint<dim> h = step * LocalPoint<dim>::Unit(b);
      const FacetShape<dim> above = evaluate_facet_shape<dim>(degree, xi + h);
      const FacetShape<dim> below = evaluate_facet_shape<dim>(degree, xi - h);
      for (unsigned int i = 0; i < shape.n_nodes; ++i)
      {
        EXPECT_NEAR(shape.first[i][b], (above.value[i] - below.value[i]) / (2. * step), 1e-9);
        for (int a = 0; a <= b; ++a)
          EXPECT_NEAR(shape.second[i][dim == 2 ? 0 : a + b],
                      (above.first[i][a] - below.first[i][a]) / (2. * step), 1e-9);
      }
    }
  }
}

TYPED_TEST(FacetShapeTest, FrameReproducesAnAffineMapAndPointsOutwards)
{
  constexpr int dim = TypeParam::value;
  Dice dice(2);
  for (const unsigned int degree : {1u, 2u})
  {
    FacetNodes<dim> nodes = testing::make_unit_facet<dim>(degree);
    const SpatialTensor<dim> map = 3. * dice.rotation<dim>();
    for (unsigned int i = 0; i < nodes.n_nodes; ++i)
      nodes.position[i] = map * nodes.position[i];
    const LocalPoint<dim> xi = dice.point<dim - 1>(0., 1.);
    const FacetFrame<dim> frame = evaluate_facet_frame(nodes, xi);
    EXPECT_LT((frame.position - map.template leftCols<dim - 1>() * xi).norm(), 1e-14);
    for (int a = 0; a < dim - 1; ++a)
      EXPECT_LT((frame.tangent[a] - map.col(a)).norm(), 1e-14);
    const SpatialVector<dim> normal = (dim == 2 ? -3. : 9.) / 3. * map.col(dim - 1);
    EXPECT_LT((frame.area_normal - normal).norm(), 1e-13) << frame.area_normal.transpose();
  }
}

TEST(GatherNodes, TakesThePositionsInTheFacetsOrder)
{
  Facet<3> facet;
  facet.nodes = {3, 1, 0, 2};
  const std::vector<SpatialVector<3>> positions = {{0., 0., 0.}, {1., 0., 0.}, {2., 0., 0.}, {3., 0., 0.}};
  const FacetNodes<3> nodes = gather_nodes(facet, positions);
  ASSERT_EQ(nodes.n_nodes, 4u);
  EXPECT_EQ(nodes.degree, 1u);
  for (unsigned int i = 0; i < 4; ++i)
    EXPECT_EQ(nodes.position[i].x(), facet.nodes[i]);
}
} // namespace
} // namespace signorini::contact
