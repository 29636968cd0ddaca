// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/geometry/closest_point.h"

#include "signorini/contact/geometry/local_domain.h"

#include "facet_samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace signorini::contact
{
namespace
{
using testing::Dice;

/// The point of the local domain beside `xi`.
template <int dim>
LocalPoint<dim> move_inside(const FacetElement<dim> &element, LocalPoint<dim> xi)
{
  if (element.type == FacetType::triangle && xi.sum() > 1.)
    xi -= LocalPoint<dim>::Constant(.5 * (xi.sum() - 1.));
  xi = xi.cwiseMax(0.).cwiseMin(1.);
  if (element.type == FacetType::triangle && xi.sum() > 1.)
    xi[1] = 1. - xi[0];
  return xi;
}

/// Lowest distance over a grid of local points about `middle`; moves `middle` there.
template <int dim>
double search_grid(const FacetNodes<dim> &nodes, const SpatialVector<dim> &x, LocalPoint<dim> &middle,
                   const double half_width, const int n)
{
  double best = std::numeric_limits<double>::max();
  LocalPoint<dim> best_xi = middle;
  for (int j = 0; j <= (dim == 2 ? 0 : n); ++j)
    for (int i = 0; i <= n; ++i)
    {
      LocalPoint<dim> xi = middle;
      xi[0] = middle[0] + half_width * (2. * i / n - 1.);
      if (dim == 3)
        xi[dim - 2] = middle[dim - 2] + half_width * (2. * j / n - 1.);
      xi = move_inside(nodes, xi);
      const double distance = (evaluate_facet_frame(nodes, xi).position - x).norm();
      if (distance < best)
      {
        best = distance;
        best_xi = xi;
      }
    }
  middle = best_xi;
  return best;
}

/// Closest distance by sampling alone, sharing nothing with the code under test but the shape functions.
template <int dim>
double find_distance_by_sampling(const FacetNodes<dim> &nodes, const SpatialVector<dim> &x)
{
  LocalPoint<dim> middle = LocalPoint<dim>::Constant(0.5);
  double best = search_grid(nodes, x, middle, 0.5, dim == 2 ? 400 : 32);
  for (double half_width = 0.05; half_width > 1e-8; half_width *= 0.5)
    best = std::min(best, search_grid(nodes, x, middle, half_width, 4));
  return best;
}

/// First-order conditions of the constrained minimum, to round-off.
template <int dim>
void expect_stationary(const FacetNodes<dim> &nodes, const SpatialVector<dim> &x,
                       const ClosestPoint<dim> &closest)
{
  const FacetFrame<dim> frame = evaluate_facet_frame(nodes, closest.xi);
  EXPECT_LT((frame.position - closest.position).norm(), 1e-14 * (1. + x.norm()));
  EXPECT_NEAR(closest.distance, (frame.position - x).norm(), 1e-14 * (1. + x.norm()));
  const LocalPoint<dim> xi = closest.xi;
  const bool is_triangle = nodes.type == FacetType::triangle;
  ASSERT_GE(xi.minCoeff(), 0.);
  ASSERT_LE(is_triangle ? xi.sum() : xi.maxCoeff(), 1.);

  // From sides it may fall outwards only; each is held exactly.
  std::vector<LocalPoint<dim>> outwards, ways;
  for (int a = 0; a < dim - 1; ++a)
  {
    const LocalPoint<dim> unit = LocalPoint<dim>::Unit(a);
    ways.insert(ways.end(), {unit, -unit});
    if (xi[a] == 0.)
      outwards.push_back(-unit);
    if (!is_triangle && xi[a] == 1.)
      outwards.push_back(unit);
  }
  if (is_triangle && xi.sum() == 1.)
    outwards.push_back(LocalPoint<dim>::Ones());
  if constexpr (dim == 3)
    if (is_triangle)
      ways.insert(ways.end(), {LocalPoint<3>(1., -1.), LocalPoint<3>(-1., 1.)});
  EXPECT_EQ(find_local_place(nodes, xi, 0.).n_free, dim - 1 - outwards.size());
  for (const LocalPoint<dim> &way : ways)
  {
    if (std::any_of(outwards.begin(), outwards.end(), [&](const auto &out) { return out.dot(way) > 0.; }))
      continue;
    SpatialVector<dim> tangent = SpatialVector<dim>::Zero();
    double size = 1.;
    for (int a = 0; a < dim - 1; ++a)
    {
      tangent += way[a] * frame.tangent[a];
      size += frame.tangent[a].norm();
    }
    EXPECT_GT((frame.position - x).dot(tangent), -1e-13 * (1. + closest.distance) * size);
  }
}

template <int dim>
void compare_with_sampling(const double warp, const double reach, const unsigned int n_cases)
{
  Dice dice(17);
  for (unsigned int n = 0; n < testing::count_cases(n_cases); ++n)
  {
    const auto elements = testing::all_elements<dim>();
    const FacetNodes<dim> nodes = testing::make_warped_facet(elements[n % elements.size()], warp, dice);
    const SpatialVector<dim> x = evaluate_facet_frame<dim>(nodes, dice.point<dim - 1>(-0.3, 1.3)).position +
                                 dice.point<dim>(-reach, reach);
    const ClosestPoint<dim> closest = find_closest_point(nodes, x);
    EXPECT_LT(closest.distance, find_distance_by_sampling(nodes, x) + 1e-12) << "case " << n;
    expect_stationary(nodes, x, closest);
  }
}

TEST(ClosestPoint, BeatsSamplingOnSlightlyWarpedFacets)
{
  compare_with_sampling<2>(0.05, 0.5, 1000);
  compare_with_sampling<3>(0.05, 0.5, 1000);
}

TEST(ClosestPoint, BeatsSamplingOnStronglyWarpedFacets)
{
  compare_with_sampling<2>(0.4, 1., 2000);
  compare_with_sampling<3>(0.3, 1., 2000);
}

TEST(ClosestPoint, BeatsSamplingOnTangledFacets)
{
  compare_with_sampling<2>(1.5, 3., 2000);
  compare_with_sampling<3>(1., 3., 1000);
}

template <int dim>
void recover_local_points(const double warp)
{
  Dice dice(3);
  for (unsigned int n = 0; n < 500; ++n)
  {
    const auto elements = testing::all_elements<dim>();
    const FacetNodes<dim> nodes = testing::make_warped_facet(elements[n % elements.size()], warp, dice);
    const LocalPoint<dim> xi = testing::make_local_point(nodes, 0.001, dice);
    const FacetFrame<dim> frame = evaluate_facet_frame<dim>(nodes, xi);
    const SpatialVector<dim> normal = frame.area_normal.normalized();
    for (const double height : {0., 1e-12, 1e-3, -0.05})
    {
      const ClosestPoint<dim> closest = find_closest_point<dim>(nodes, frame.position + height * normal);
      EXPECT_LT((closest.xi - xi).norm(), 1e-13);
      EXPECT_NEAR(closest.distance, std::abs(height), 1e-14);
      EXPECT_EQ(find_local_place(nodes, closest.xi, 0.).n_free, dim - 1u);
    }
  }
}

TEST(ClosestPoint, RecoversTheLocalPointsOfPointsAlongTheNormal)
{
  recover_local_points<2>(0.05);
  recover_local_points<3>(0.05);
}

TEST(ClosestPoint, HoldsSidesAndCornersExactly)
{
  const FacetNodes<3> nodes = testing::make_unit_facet<3>({2});
  for (const double u : {-0.5, 0.25, 1.5})
    for (const double v : {-0.5, 0.75, 1.5})
    {
      const ClosestPoint<3> closest = find_closest_point<3>(nodes, {u, v, 0.3});
      EXPECT_NEAR(closest.xi[0], std::clamp(u, 0., 1.), u == 0.25 ? 1e-15 : 0.);
      EXPECT_NEAR(closest.xi[1], std::clamp(v, 0., 1.), v == 0.75 ? 1e-15 : 0.);
      EXPECT_EQ(find_local_place(nodes, closest.xi, 0.).n_free, (u == 0.25) + (v == 0.75));
    }
}

TEST(ClosestPoint, HoldsSidesAndCornersOfTrianglesExactly)
{
  struct Known
  {
    LocalPoint<3> x, xi;
    unsigned int n_free;
  };
  const std::vector<Known> all{
      {{-0.5, 0.25}, {0., 0.25}, 1}, {{0.25, -0.5}, {0.25, 0.}, 1},  {{1., 1.}, {0.5, 0.5}, 1},
      {{0.9, 0.4}, {0.75, 0.25}, 1}, {{0.3, 1.2}, {0.05, 0.95}, 1},  {{-0.5, -0.5}, {0., 0.}, 0},
      {{1.5, -0.2}, {1., 0.}, 0},    {{1.5, 0.2}, {1., 0.}, 0},      {{-0.2, 1.5}, {0., 1.}, 0},
      {{0.2, 1.5}, {0., 1.}, 0},     {{0.25, 0.25}, {0.25, 0.25}, 2}};
  for (const unsigned int degree : {1u, 2u})
    for (const Known &known : all)
    {
      const FacetNodes<3> nodes = testing::make_unit_facet<3>({degree, FacetType::triangle});
      const ClosestPoint<3> closest = find_closest_point<3>(nodes, {known.x[0], known.x[1], 0.3});
      EXPECT_LT((closest.xi - known.xi).norm(), known.n_free == 0 ? 1e-300 : 1e-15);
      EXPECT_EQ(find_local_place(nodes, closest.xi, 0.).n_free, known.n_free) << known.x.transpose();
    }
}

TEST(ClosestPoint, FindsTheGlobalMinimumInsideAPipe)
{
  // A parabola bent tightly, seen from far beyond its centre of curvature: the middle is a maximum, both ends
  // minima.
  FacetNodes<2> arch = testing::make_unit_facet<2>({2});
  arch.position[1].y() = 1.;
  const ClosestPoint<2> left = find_closest_point<2>(arch, {0.499, -1.});
  EXPECT_EQ(left.xi[0], 0.);
  const ClosestPoint<2> right = find_closest_point<2>(arch, {0.501, -1.});
  EXPECT_EQ(right.xi[0], 1.);
}

TEST(ClosestPoint, ToleratesDegenerateFacets)
{
  for (const FacetElement<3> &element : testing::all_elements<3>())
  {
    FacetNodes<3> point = testing::make_unit_facet(element);
    for (unsigned int i = 0; i < point.n_nodes(); ++i)
      point.position[i].setOnes();
    EXPECT_NEAR(find_closest_point<3>(point, {1., 1., 3.}).distance, 2., 1e-14);
  }
  FacetNodes<3> triangle = testing::make_unit_facet<3>({1});
  triangle.position[2] = triangle.position[0];
  EXPECT_NEAR(find_closest_point<3>(triangle, {0.5, 0.25, 0.5}).distance, 0.5, 1e-12);
  EXPECT_NEAR(find_closest_point<3>(triangle, {-1., 0., 0.}).distance, 1., 1e-12);
  FacetNodes<3> needle = testing::make_unit_facet<3>({1, FacetType::triangle});
  needle.position[2] = {0.3, 0., 0.};
  EXPECT_NEAR(find_closest_point<3>(needle, {0.6, 0., 0.5}).distance, 0.5, 1e-12);
  EXPECT_NEAR(find_closest_point<3>(needle, {2., 0., 0.}).distance, 1., 1e-12);
}

TEST(ClosestPoint, DoesNotDependOnScale)
{
  Dice dice(5);
  for (unsigned int n = 0; n < testing::count_cases(300); ++n)
  {
    FacetNodes<3> nodes = testing::make_warped_facet<3>(testing::all_elements<3>()[n % 4], 0.1, dice);
    const SpatialVector<3> x = dice.point<3>(-2., 2.);
    const ClosestPoint<3> reference = find_closest_point(nodes, x);
    const double scale = std::ldexp(1., n % 3 == 0 ? 40 : -40);
    for (unsigned int i = 0; i < nodes.n_nodes(); ++i)
      nodes.position[i] *= scale;
    const ClosestPoint<3> scaled = find_closest_point<3>(nodes, scale * x);
    EXPECT_LT((scaled.xi - reference.xi).norm(), 1e-13);
    EXPECT_NEAR(scaled.distance / scale, reference.distance, 1e-14);
  }
}

TEST(ClosestPoint, BeatsSamplingOnLongFacets)
{
  Dice dice(5);
  for (unsigned int n = 0; n < testing::count_cases(300); ++n)
  {
    FacetNodes<3> nodes = testing::make_warped_facet<3>(testing::all_elements<3>()[n % 4], 0.05, dice);
    const SpatialVector<3> stretch(100., 1., 1.);
    for (unsigned int i = 0; i < nodes.n_nodes(); ++i)
      nodes.position[i] = nodes.position[i].cwiseProduct(stretch);
    const SpatialVector<3> x = dice.point<3>(-2., 2.).cwiseProduct(stretch);
    EXPECT_LT(find_closest_point(nodes, x).distance, find_distance_by_sampling(nodes, x) + 1e-11);
  }
}
} // namespace
} // namespace signorini::contact
