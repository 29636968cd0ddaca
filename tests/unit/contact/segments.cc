// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/geometry/segments.h"

#include "signorini/contact/geometry/closest_point.h"

#include "facet_samples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace signorini::contact
{
namespace
{
using testing::Dice;

template <int dim>
using Points = std::vector<FacetQuadraturePoint<dim>>;

template <int dim>
FacetNodes<dim> map_nodes(FacetNodes<dim> nodes, const SpatialTensor<dim> &map,
                          const SpatialVector<dim> &shift)
{
  for (unsigned int i = 0; i < nodes.n_nodes; ++i)
    nodes.position[i] = map * nodes.position[i] + shift;
  return nodes;
}

/// The same facet with its normal turned round (its first direction runs backwards).
template <int dim>
FacetNodes<dim> turn_round(const FacetNodes<dim> &nodes)
{
  FacetNodes<dim> turned = nodes;
  const unsigned int n = nodes.degree + 1;
  for (unsigned int i = 0; i < nodes.n_nodes; ++i)
    turned.position[i] = nodes.position[i - i % n + (n - 1 - i % n)];
  return turned;
}

/// ∫ ξ_0^p ξ_1^q over the points' share of the local square.
template <int dim>
double compute_moment(const Points<dim> &points, const int p, const int q)
{
  double sum = 0.;
  for (const auto &point : points)
    sum += point.weight * std::pow(point.xi[0], p) * (dim == 3 ? std::pow(point.xi[dim - 2], q) : 1.);
  return sum;
}

/// All moments up to the total degree that the rule integrates exactly over the whole square.
template <int dim>
void expect_exact_moments(const Points<dim> &points, const unsigned int n_points,
                          const double tolerance = 1e-13)
{
  const int order = static_cast<int>(2 * n_points - 1);
  for (int p = 0; p <= order; ++p)
    for (int q = 0; q <= (dim == 3 ? order - p : 0); ++q)
      EXPECT_NEAR(compute_moment<dim>(points, p, q), 1. / ((p + 1.) * (q + 1.)), tolerance) << p << " " << q;
  for (const auto &point : points)
  {
    EXPECT_GT(point.weight, 0.);
    EXPECT_GE(point.xi.minCoeff(), 0.);
    EXPECT_LE(point.xi.maxCoeff(), 1.);
  }
}

template <int dim>
void append(Points<dim> &all, const Points<dim> &more)
{
  all.insert(all.end(), more.begin(), more.end());
}

TEST(GaussPoints, IntegratePolynomialsExactly)
{
  for (unsigned int n = 1; n <= 8; ++n)
  {
    EXPECT_EQ(make_gauss_points<2>(n).size(), n);
    EXPECT_EQ(make_gauss_points<3>(n).size(), n * n);
    expect_exact_moments<2>(make_gauss_points<2>(n), n, 1e-14);
    expect_exact_moments<3>(make_gauss_points<3>(n), n, 1e-14);
    const int beyond = static_cast<int>(2 * n);
    EXPECT_GT(std::abs(compute_moment<2>(make_gauss_points<2>(n), beyond, 0) - 1. / (beyond + 1.)), 1e-11);
  }
  EXPECT_THROW(make_gauss_points<2>(0), std::invalid_argument);
  EXPECT_THROW(make_gauss_points<3>(9), std::invalid_argument);
}

/// Facets of an n_contactor grid against those of an n_target grid over the same parallelogram: nothing lost
/// or counted twice, polynomials of the contactor and shape functions of the target integrated exactly.
template <int dim>
void compare_tilings(const unsigned int n_contactor, const unsigned int n_target, const unsigned int degree,
                     const unsigned int n_points, Dice &dice)
{
  SpatialTensor<dim> map = dice.rotation<dim>();
  if (dim == 3)
    map.col(1) += dice.number(-0.5, 0.5) * map.col(0);
  const SpatialVector<dim> shift = dice.point<dim>(-3., 3.);
  const auto piece = [&](const unsigned int n, const unsigned int index)
  {
    SpatialVector<dim> corner = SpatialVector<dim>::Zero();
    corner[0] = static_cast<double>(index % n) / n;
    if (dim == 3)
      corner[1] = static_cast<double>(index / n) / n;
    const FacetNodes<dim> scaled =
        map_nodes<dim>(testing::make_unit_facet<dim>(degree), SpatialTensor<dim>::Identity() / n, corner);
    return map_nodes<dim>(scaled, map, shift);
  };
  const auto count = [](const unsigned int n) { return dim == 2 ? n : n * n; };

  // ∫ N_i of each target, in parts of its own measure.
  std::vector<std::array<double, Facet<dim>::max_n_nodes>> of_target(count(n_target));
  for (unsigned int c = 0; c < count(n_contactor); ++c)
  {
    Points<dim> all;
    const FacetNodes<dim> contactor = piece(n_contactor, c);
    for (unsigned int t = 0; t < count(n_target); ++t)
    {
      const FacetNodes<dim> target = turn_round(piece(n_target, t));
      const Points<dim> points = make_segment_points(contactor, target, n_points);
      append(all, points);
      for (const auto &point : points)
      {
        const auto foot = find_closest_point(target, evaluate_facet_frame(contactor, point.xi).position);
        const auto shape = evaluate_facet_shape<dim>(degree, foot.xi);
        for (unsigned int i = 0; i < shape.n_nodes; ++i)
          of_target[t][i] += shape.value[i] * point.weight * count(n_target) / count(n_contactor);
      }
    }
    expect_exact_moments<dim>(all, n_points);
  }

  const unsigned int n_exact = 3;
  for (const auto &integrals : of_target)
  {
    std::array<double, Facet<dim>::max_n_nodes> exact{};
    for (const auto &point : make_gauss_points<dim>(n_exact))
      for (unsigned int i = 0; i < exact.size(); ++i)
        exact[i] += point.weight * evaluate_facet_shape<dim>(degree, point.xi).value[i];
    for (unsigned int i = 0; i < exact.size(); ++i)
      EXPECT_NEAR(integrals[i], exact[i], 1e-13);
  }
}

TEST(SegmentPoints, TileAParallelogramExactlyWhateverItsPlacement)
{
  Dice dice(23);
  for (unsigned int turn = 0; turn < testing::count_cases(8); ++turn)
  {
    compare_tilings<2>(3, 4, 1, 2, dice);
    compare_tilings<2>(3, 5, 2, 2, dice);
    compare_tilings<3>(3, 4, 1, 2, dice);
    compare_tilings<3>(4, 3, 1, 4, dice);
    compare_tilings<3>(2, 3, 2, 3, dice);
    compare_tilings<3>(2, 2, 1, 2, dice); // edges on edges
  }
}

/// One contactor under a turned grid of targets that reaches beyond it, from a distance.
TEST(SegmentPoints, CoverAFacetUnderATurnedGrid)
{
  Dice dice(29);
  const FacetNodes<3> contactor = testing::make_unit_facet<3>(1);
  for (unsigned int turn = 0; turn < testing::count_cases(50); ++turn)
  {
    const double angle = dice.number(0., 6.3);
    const SpatialTensor<3> rotation = Eigen::AngleAxisd(angle, SpatialVector<3>::UnitZ()).toRotationMatrix();
    Points<3> all;
    for (int j = -4; j < 4; ++j)
      for (int i = -4; i < 4; ++i)
      {
        const FacetNodes<3> cell = map_nodes<3>(testing::make_unit_facet<3>(1),
                                                0.6 * SpatialTensor<3>::Identity(), {0.6 * i, 0.6 * j, 0.3});
        append<3>(all, make_segment_points<3>(contactor,
                                              turn_round(map_nodes<3>(cell, rotation, {0.5, 0.5, 0.})), 3));
      }
    expect_exact_moments<3>(all, 3);
  }
}

/// Quadrilaterals that are no parallelograms, also with a corner bent inwards, and warped ones, covered by
/// one target of the same outline, by a larger one, and by a grid of targets.
TEST(SegmentPoints, CoverAnyQuadrilateral)
{
  Dice dice(31);
  for (unsigned int n = 0; n < testing::count_cases(200); ++n)
  {
    const unsigned int degree = 1 + n % 2;
    FacetNodes<3> contactor = testing::make_unit_facet<3>(degree);
    for (unsigned int i = 0; i < contactor.n_nodes; ++i)
      contactor.position[i] +=
          0.3 / degree * dice.point<3>(-1., 1.).cwiseProduct(SpatialVector<3>(1., 1., 0.3));
    expect_exact_moments<3>(make_segment_points<3>(contactor, turn_round(contactor), 3), 3);
    const FacetNodes<3> large =
        map_nodes<3>(testing::make_unit_facet<3>(1), 5. * SpatialTensor<3>::Identity(), {-2., -2., 0.1});
    expect_exact_moments<3>(make_segment_points<3>(contactor, turn_round(large), 3), 3);

    Points<3> all;
    for (int t = 0; t < 36; ++t)
    {
      const FacetNodes<3> target =
          map_nodes<3>(testing::make_unit_facet<3>(1), 0.5 * SpatialTensor<3>::Identity(),
                       {0.5 * (t % 6) - 1.07, 0.5 * (t / 6) - 1.03, 0.});
      append<3>(all, make_segment_points<3>(contactor, turn_round(target), 3));
    }
    expect_exact_moments<3>(all, 3, 1e-12);
  }
  FacetNodes<3> dart = testing::make_unit_facet<3>(1);
  dart.position[3] = {0.3, 0.3, 0.};
  expect_exact_moments<3>(make_segment_points<3>(dart, turn_round(dart), 2), 2);
}

TEST(SegmentPoints, AreWhereTheTargetIs)
{
  const FacetNodes<3> contactor = testing::make_unit_facet<3>(1);
  SpatialTensor<3> half = SpatialTensor<3>::Identity();
  half(0, 0) = 0.25;
  const FacetNodes<3> target = turn_round(map_nodes<3>(contactor, half, {0.5, 0.5, 0.2}));
  const Points<3> points = make_segment_points<3>(contactor, target, 2);
  ASSERT_FALSE(points.empty());
  EXPECT_NEAR(compute_moment<3>(points, 0, 0), 0.125, 1e-15);
  EXPECT_NEAR(compute_moment<3>(points, 1, 0), 0.125 * 0.625, 1e-15);
  EXPECT_NEAR(compute_moment<3>(points, 0, 1), 0.125 * 0.75, 1e-15);
  for (const auto &point : points)
  {
    EXPECT_TRUE(point.xi[0] > 0.5 && point.xi[0] < 0.75);
    EXPECT_GT(point.xi[1], 0.5);
  }
}

template <int dim>
void expect_nothing_without_overlap()
{
  const SpatialTensor<dim> unmoved = SpatialTensor<dim>::Identity();
  const FacetNodes<dim> contactor = testing::make_unit_facet<dim>(1);
  const FacetNodes<dim> target = turn_round(contactor);
  const SpatialVector<dim> along = SpatialVector<dim>::UnitX();
  EXPECT_FALSE(make_segment_points(contactor, target, 2).empty());
  EXPECT_FALSE(make_segment_points(contactor, map_nodes<dim>(target, unmoved, 0.999 * along), 2).empty());
  EXPECT_TRUE(make_segment_points(contactor, map_nodes<dim>(target, unmoved, 1.001 * along), 2).empty());
  EXPECT_TRUE(make_segment_points(contactor, map_nodes<dim>(target, unmoved, along), 2).empty());
  EXPECT_TRUE(make_segment_points(contactor, contactor, 2).empty()); // normals do not oppose each other
  SpatialTensor<dim> quarter_turn = SpatialTensor<dim>::Zero();
  quarter_turn(0, dim - 1) = -1.;
  quarter_turn(dim - 1, 0) = 1.;
  if (dim == 3)
    quarter_turn(1, 1) = 1.;
  EXPECT_TRUE(make_segment_points(contactor, map_nodes<dim>(target, quarter_turn, 0.5 * along), 2).empty());
}

TEST(SegmentPoints, AreNoneWithoutOverlapOrFacingNormals)
{
  expect_nothing_without_overlap<2>();
  expect_nothing_without_overlap<3>();
}

TEST(SegmentPoints, AreSymmetricAboutTheCentroid)
{
  const FacetNodes<3> facet = testing::make_unit_facet<3>(1);
  double odd = 0., even = 0.; // of a degree the rule does not integrate exactly
  for (const auto &point : make_segment_points(facet, turn_round(facet), 1))
  {
    odd += point.weight * std::pow(point.xi[0] - 0.5, 3);
    even += point.weight * std::pow(point.xi[0] - 0.5, 2);
  }
  EXPECT_NEAR(odd, 0., 1e-16);
  EXPECT_GT(std::abs(even - 1. / 12.), 1e-3);
}

TEST(SegmentPoints, FollowTheMidSideNodes)
{
  FacetNodes<3> target = testing::make_unit_facet<3>(2);
  target.position[5].x() = 0.8; // the side at ξ_0 = 1 bends inwards: two triangles of 0.2 · 0.5 / 2 are lost
  const Points<3> points = make_segment_points<3>(testing::make_unit_facet<3>(1), turn_round(target), 2);
  EXPECT_NEAR(compute_moment<3>(points, 0, 0), 0.9, 1e-14);
  FacetNodes<2> contactor = testing::make_unit_facet<2>(2),
                straight = turn_round(testing::make_unit_facet<2>(1));
  contactor.position[1].x() = 0.4;
  straight.position[0].x() = 0.7; // covers the first sub-facet and half of the second
  EXPECT_NEAR(compute_moment<2>(make_segment_points<2>(contactor, straight, 2), 0, 0), 0.75, 1e-15);
}
} // namespace
} // namespace signorini::contact
