// SPDX-License-Identifier: LGPL-2.1-or-later
#include "facet_samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

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
  for (const FacetElement<dim> &element : testing::all_elements<dim>())
    for (unsigned int i = 0; i < element.n_nodes(); ++i)
    {
      const FacetShape<dim> shape = evaluate_facet_shape(element, node_coordinates(element, i));
      ASSERT_EQ(shape.n_nodes, element.n_nodes());
      for (unsigned int j = 0; j < shape.n_nodes; ++j)
      {
        EXPECT_EQ(shape.value[j], i == j ? 1. : 0.);
        EXPECT_EQ(evaluate_hat_function(element, j, node_coordinates(element, i)), i == j ? 1. : 0.);
      }
    }
}

TEST(NodeCoordinates, RunAsTheElementSays)
{
  const std::array<LocalPoint<3>, 6> triangle{LocalPoint<3>(0., 0.), LocalPoint<3>(1., 0.),
                                              LocalPoint<3>(0., 1.), LocalPoint<3>(.5, 0.),
                                              LocalPoint<3>(.5, .5), LocalPoint<3>(0., .5)};
  for (const FacetElement<3> &element : testing::all_elements<3>())
  {
    const bool is_triangle = element.type == FacetType::triangle;
    const unsigned int degree = element.degree, n_line = degree + 1;
    EXPECT_EQ(element.n_nodes(), is_triangle ? 3 * degree : n_line * n_line);
    for (unsigned int i = 0; i < element.n_nodes(); ++i)
      EXPECT_EQ(node_coordinates(element, i),
                is_triangle ? triangle[i] : LocalPoint<3>(LocalPoint<3>(i % n_line, i / n_line) / degree));
  }
  EXPECT_EQ(node_coordinates(FacetElement<2>{2}, 1)[0], .5);
}

/// Linear on every straight part of a facet: so it follows from its values at the parts' corners.
TYPED_TEST(FacetShapeTest, HatFunctionsSumToOneAndAreLinearBetweenNodes)
{
  constexpr int dim = TypeParam::value;
  Dice dice(4);
  for (const FacetElement<dim> &element : testing::all_elements<dim>())
    for (unsigned int n = 0; n < 100; ++n)
    {
      const LocalPoint<dim> xi = testing::make_local_point(element, 0., dice);
      double sum = 0.;
      LocalPoint<dim> mean = LocalPoint<dim>::Zero();
      for (unsigned int i = 0; i < element.n_nodes(); ++i)
      {
        const double hat = evaluate_hat_function(element, i, xi);
        EXPECT_GE(hat, 0.);
        sum += hat;
        mean += hat * node_coordinates(element, i);
      }
      EXPECT_NEAR(sum, 1., 1e-14);
      EXPECT_LT((mean - xi).norm(), 1e-14);
    }
}

TYPED_TEST(FacetShapeTest, LebesgueConstantIsTheLargestSumOfMagnitudes)
{
  constexpr int dim = TypeParam::value;
  for (const FacetElement<dim> &element : testing::all_elements<dim>())
  {
    double largest = 0.;
    for (int j = 0; j <= (dim == 2 ? 0 : 60); ++j)
      for (int i = 0; i + (element.type == FacetType::triangle ? j : 0) <= 60; ++i)
      {
        LocalPoint<dim> xi = LocalPoint<dim>::Constant(j / 60.);
        xi[0] = i / 60.;
        double sum = 0.;
        for (const double value : evaluate_facet_shape(element, xi).value)
          sum += std::abs(value);
        largest = std::max(largest, sum);
      }
    EXPECT_NEAR(largest, lebesgue_constant(element), 1e-14);
  }
}

TYPED_TEST(FacetShapeTest, SumsToOneAndDerivativesMatchDifferences)
{
  constexpr int dim = TypeParam::value;
  constexpr double step = 1e-5;
  Dice dice(1);
  for (unsigned int n = 0; n < 200; ++n)
  {
    const auto elements = testing::all_elements<dim>();
    const FacetElement<dim> element = elements[n % elements.size()];
    const LocalPoint<dim> xi = dice.point<dim - 1>(0., 1.);
    const FacetShape<dim> shape = evaluate_facet_shape(element, xi);
    double sum = 0.;
    for (const double value : shape.value)
      sum += value;
    EXPECT_NEAR(sum, 1., 1e-14);
    for (int b = 0; b < dim - 1; ++b)
    {
      const LocalPoint<dim> h = step * LocalPoint<dim>::Unit(b);
      const FacetShape<dim> above = evaluate_facet_shape<dim>(element, xi + h);
      const FacetShape<dim> below = evaluate_facet_shape<dim>(element, xi - h);
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
  for (const FacetElement<dim> &element : testing::all_elements<dim>())
  {
    FacetNodes<dim> nodes = testing::make_unit_facet(element);
    const SpatialTensor<dim> map = 3. * dice.rotation<dim>();
    for (unsigned int i = 0; i < nodes.n_nodes(); ++i)
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
  ASSERT_EQ(nodes.n_nodes(), 4u);
  EXPECT_EQ(nodes.degree, 1u);
  for (unsigned int i = 0; i < 4; ++i)
    EXPECT_EQ(nodes.position[i].x(), facet.nodes[i]);
}

/// Points of the whole facet, its corners too, no farther apart than asked.
TEST(Lattice, CoversTheFacet)
{
  const std::vector<SpatialVector<3>> positions = {{0., 0., 0.}, {2., 0., 0.}, {0., 1., 0.}, {2., 1., 0.}};
  for (const FacetType type : {FacetType::tensor_product, FacetType::triangle})
  {
    Facet<3> facet;
    facet.type = type;
    facet.nodes = {0, 1, 2, 3};
    const auto points = make_lattice(facet, positions, .25);
    Dice dice(6);
    for (unsigned int n = 0; n < 200; ++n)
    {
      const LocalPoint<3> xi = testing::make_local_point(facet, 0., dice);
      double nearest = 1.;
      for (const auto &point : points)
        nearest = std::min(nearest, (point - SpatialVector<3>(2. * xi[0], xi[1], 0.)).norm());
      EXPECT_LT(nearest, .25 * std::sqrt(.5));
    }
    for (const auto &point : points)
      EXPECT_TRUE(point.minCoeff() >= 0. &&
                  (type == FacetType::tensor_product || .5 * point.x() + point.y() <= 1. + 1e-15));
    for (unsigned int i = 0; i < facet.n_nodes(); ++i)
      EXPECT_EQ(std::count(points.begin(), points.end(), positions[i]), 1);
  }
}
} // namespace
} // namespace signorini::contact
