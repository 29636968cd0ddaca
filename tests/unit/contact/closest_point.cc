// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/geometry/closest_point.h"

#include "facet_samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace signorini::contact
{
namespace
{
using testing::Dice;

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
      xi[0] = std::clamp(middle[0] + half_width * (2. * i / n - 1.), 0., 1.);
      if (dim == 3)
        xi[dim - 2] = std::clamp(middle[dim - 2] + half_width * (2. * j / n - 1.), 0., 1.);
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
  for (int a = 0; a < dim - 1; ++a)
  {
    ASSERT_GE(closest.xi[a], 0.);
    ASSERT_LE(closest.xi[a], 1.);
    EXPECT_EQ(closest.free[a], closest.xi[a] != 0. && closest.xi[a] != 1.);
    const double slope = (frame.position - x).dot(frame.tangent[a]);
    const double tolerance = 1e-13 * (1. + closest.distance) * (1. + frame.tangent[a].norm());
    EXPECT_TRUE(closest.xi[a] == 0. || slope < tolerance) << slope;
    EXPECT_TRUE(closest.xi[a] == 1. || slope > -tolerance) << slope;
  }
}

template <int dim>
void compare_with_sampling(const double warp, const double reach, const unsigned int n_cases)
{
  Dice dice(17);
  for (unsigned int n = 0; n < testing::count_cases(n_cases); ++n)
  {
    const FacetNodes<dim> nodes = testing::make_warped_facet<dim>(1 + n % 2, warp, dice);
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
    const FacetNodes<dim> nodes = testing::make_warped_facet<dim>(1 + n % 2, warp, dice);
    const LocalPoint<dim> xi = dice.point<dim - 1>(0.001, 0.999);
    const FacetFrame<dim> frame = evaluate_facet_frame<dim>(nodes, xi);
    const SpatialVector<dim> normal = frame.area_normal.normalized();
    for (const double height : {0., 1e-12, 1e-3, -0.05})
    {
      const ClosestPoint<dim> closest = find_closest_point<dim>(nodes, frame.position + height * normal);
      EXPECT_LT((closest.xi - xi).norm(), 1e-13);
      EXPECT_NEAR(closest.distance, std::abs(height), 1e-14);
      EXPECT_TRUE(std::all_of(closest.free.begin(), closest.free.end(), [](bool free) { return free; }));
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
  const FacetNodes<3> nodes = testing::make_unit_facet<3>(2);
  for (const double u : {-0.5, 0.25, 1.5})
    for (const double v : {-0.5, 0.75, 1.5})
    {
      const ClosestPoint<3> closest = find_closest_point<3>(nodes, {u, v, 0.3});
      EXPECT_NEAR(closest.xi[0], std::clamp(u, 0., 1.), u == 0.25 ? 1e-15 : 0.);
      EXPECT_NEAR(closest.xi[1], std::clamp(v, 0., 1.), v == 0.75 ? 1e-15 : 0.);
      EXPECT_EQ(closest.free[0], u == 0.25);
      EXPECT_EQ(closest.free[1], v == 0.75);
    }
}

TEST(ClosestPoint, FindsTheGlobalMinimumInsideAPipe)
{
  // A parabola bent tightly, seen from far beyond its centre of curvature: the middle is a maximum, both ends
  // minima.
  FacetNodes<2> arch = testing::make_unit_facet<2>(2);
  arch.position[1].y() = 1.;
  const ClosestPoint<2> left = find_closest_point<2>(arch, {0.499, -1.});
  EXPECT_EQ(left.xi[0], 0.);
  const ClosestPoint<2> right = find_closest_point<2>(arch, {0.501, -1.});
  EXPECT_EQ(right.xi[0], 1.);
}

TEST(ClosestPoint, ToleratesDegenerateFacets)
{
  FacetNodes<3> point = testing::make_unit_facet<3>(1), triangle = point;
  for (unsigned int i = 0; i < 4; ++i)
    point.position[i].setOnes();
  EXPECT_NEAR(find_closest_point<3>(point, {1., 1., 3.}).distance, 2., 1e-14);
  triangle.position[2] = triangle.position[0];
  EXPECT_NEAR(find_closest_point<3>(triangle, {0.5, 0.25, 0.5}).distance, 0.5, 1e-12);
  EXPECT_NEAR(find_closest_point<3>(triangle, {-1., 0., 0.}).distance, 1., 1e-12);
}

TEST(ClosestPoint, DoesNotDependOnScale)
{
  Dice dice(5);
  for (unsigned int n = 0; n < testing::count_cases(300); ++n)
  {
    FacetNodes<3> nodes = testing::make_warped_facet<3>(1 + n % 2, 0.1, dice);
    const SpatialVector<3> x = dice.point<3>(-2., 2.);
    const ClosestPoint<3> reference = find_closest_point(nodes, x);
    const double scale = std::ldexp(1., n % 3 == 0 ? 40 : -40);
    for (unsigned int i = 0; i < nodes.n_nodes; ++i)
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
    FacetNodes<3> nodes = testing::make_warped_facet<3>(1 + n % 2, 0.05, dice);
    const SpatialVector<3> stretch(100., 1., 1.);
    for (unsigned int i = 0; i < nodes.n_nodes; ++i)
      nodes.position[i] = nodes.position[i].cwiseProduct(stretch);
    const SpatialVector<3> x = dice.point<3>(-2., 2.).cwiseProduct(stretch);
    EXPECT_LT(find_closest_point(nodes, x).distance, find_distance_by_sampling(nodes, x) + 1e-11);
  }
}
} // namespace
} // namespace signorini::contact
