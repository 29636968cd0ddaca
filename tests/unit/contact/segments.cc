// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/geometry/segments.h"

#include "signorini/contact/geometry/closest_point.h"

#include "facet_samples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <utility>

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
  for (unsigned int i = 0; i < nodes.n_nodes(); ++i)
    nodes.position[i] = map * nodes.position[i] + shift;
  return nodes;
}

/// The same facet with its normal turned round (a tensor product's first direction runs backwards).
template <int dim>
FacetNodes<dim> turn_round(const FacetNodes<dim> &nodes)
{
  FacetNodes<dim> turned = nodes;
  if (nodes.type == FacetType::triangle)
  {
    std::swap(turned.position[1], turned.position[2]);
    if (nodes.degree == 2)
      std::swap(turned.position[3 % turned.position.size()], turned.position[5 % turned.position.size()]);
    return turned;
  }
  const unsigned int n = nodes.degree + 1;
  for (unsigned int i = 0; i < nodes.n_nodes(); ++i)
    turned.position[i] = nodes.position[i - i % n + (n - 1 - i % n)];
  return turned;
}

/// ∫ ξ_0^p ξ_1^q over the points' share of the local domain.
template <int dim>
double compute_moment(const Points<dim> &points, const int p, const int q)
{
  double sum = 0.;
  for (const auto &point : points)
    sum += point.weight * std::pow(point.xi[0], p) * (dim == 3 ? std::pow(point.xi[dim - 2], q) : 1.);
  return sum;
}

/// The same over all of the domain.
double compute_exact_moment(const FacetType type, const int p, const int q)
{
  if (type == FacetType::triangle)
    return std::tgamma(p + 1.) * std::tgamma(q + 1.) / std::tgamma(p + q + 3.);
  return 1. / ((p + 1.) * (q + 1.));
}

/// All moments up to the total degree that the rule integrates exactly over the whole domain.
template <int dim>
void expect_exact_moments(const FacetType type, const Points<dim> &points, const unsigned int n_points,
                          const double tolerance = 1e-13)
{
  const int order = static_cast<int>(2 * n_points - 1);
  for (int p = 0; p <= order; ++p)
    for (int q = 0; q <= (dim == 3 ? order - p : 0); ++q)
      EXPECT_NEAR(compute_moment<dim>(points, p, q), compute_exact_moment(type, p, q), tolerance)
          << p << " " << q;
  for (const auto &point : points)
  {
    EXPECT_GT(point.weight, 0.);
    EXPECT_GE(point.xi.minCoeff(), 0.);
    EXPECT_LE(type == FacetType::triangle ? point.xi.sum() : point.xi.maxCoeff(), 1. + 1e-15);
  }
}

template <int dim>
void append(Points<dim> &all, const Points<dim> &more)
{
  all.insert(all.end(), more.begin(), more.end());
}

template <int dim>
void expect_exact_gauss_points(const FacetType type)
{
  for (unsigned int n = 1; n <= 8; ++n)
  {
    const Points<dim> points = make_gauss_points<dim>(type, n);
    EXPECT_EQ(points.size(), dim == 2 ? n : n * n);
    expect_exact_moments<dim>(type, points, n, 1e-14);
    const int beyond = static_cast<int>(2 * n);
    EXPECT_GT(std::abs(compute_moment<dim>(points, beyond, 0) - compute_exact_moment(type, beyond, 0)),
              1e-11);
  }
  EXPECT_THROW(make_gauss_points<dim>(type, 0), std::invalid_argument);
  EXPECT_THROW(make_gauss_points<dim>(type, 9), std::invalid_argument);
}

TEST(GaussPoints, IntegratePolynomialsExactly)
{
  expect_exact_gauss_points<2>(FacetType::tensor_product);
  expect_exact_gauss_points<3>(FacetType::tensor_product);
  expect_exact_gauss_points<3>(FacetType::triangle);
}

/// A grid of n squares a direction, moved by a map, or of their two triangles each.
template <int dim>
struct Grid
{
  FacetElement<dim> element;
  unsigned int n;

  unsigned int n_squares() const { return dim == 2 ? n : n * n; }
  unsigned int n_facets() const { return (element.type == FacetType::triangle ? 2 : 1) * n_squares(); }

  FacetNodes<dim> facet(unsigned int index, const SpatialTensor<dim> &map,
                        const SpatialVector<dim> &shift) const
  {
    FacetNodes<dim> nodes = testing::make_unit_facet(element);
    if (element.type == FacetType::triangle)
    {
      SpatialVector<dim> corner = SpatialVector<dim>::Ones();
      corner[dim - 1] = 0.;
      if (index % 2 == 1)
        nodes = map_nodes<dim>(nodes, -SpatialTensor<dim>::Identity(), corner);
      index /= 2;
    }
    SpatialVector<dim> corner = SpatialVector<dim>::Zero();
    corner[0] = static_cast<double>(index % n) / n;
    if (dim == 3)
      corner[1] = static_cast<double>(index / n) / n;
    return map_nodes<dim>(map_nodes<dim>(nodes, SpatialTensor<dim>::Identity() / n, corner), map, shift);
  }
};

/// Facets of one grid against those of another over the same parallelogram: nothing lost or counted twice,
/// polynomials of the contactor and shape functions of the target integrated exactly.
template <int dim>
void compare_tilings(const Grid<dim> &contactors, const Grid<dim> &targets, const unsigned int n_points,
                     Dice &dice)
{
  SpatialTensor<dim> map = dice.rotation<dim>();
  if (dim == 3)
    map.col(1) += dice.number(-0.5, 0.5) * map.col(0);
  const SpatialVector<dim> shift = dice.point<dim>(-3., 3.);

  // ∫ N_i of each target, in parts of its own measure.
  std::vector<std::array<double, Facet<dim>::max_n_nodes>> of_target(targets.n_facets());
  for (unsigned int c = 0; c < contactors.n_facets(); ++c)
  {
    Points<dim> all;
    const FacetNodes<dim> contactor = contactors.facet(c, map, shift);
    for (unsigned int t = 0; t < targets.n_facets(); ++t)
    {
      const FacetNodes<dim> target = turn_round(targets.facet(t, map, shift));
      const Points<dim> points = make_segment_points(contactor, target, n_points);
      append(all, points);
      for (const auto &point : points)
      {
        const auto foot = find_closest_point(target, evaluate_facet_frame(contactor, point.xi).position);
        const auto shape = evaluate_facet_shape(targets.element, foot.xi);
        for (unsigned int i = 0; i < shape.n_nodes; ++i)
          of_target[t][i] += shape.value[i] * point.weight * targets.n_squares() / contactors.n_squares();
      }
    }
    expect_exact_moments<dim>(contactors.element.type, all, n_points);
  }

  for (const auto &integrals : of_target)
  {
    std::array<double, Facet<dim>::max_n_nodes> exact{};
    for (const auto &point : make_gauss_points<dim>(targets.element.type, 3))
      for (unsigned int i = 0; i < exact.size(); ++i)
        exact[i] += point.weight * evaluate_facet_shape(targets.element, point.xi).value[i];
    for (unsigned int i = 0; i < exact.size(); ++i)
      EXPECT_NEAR(integrals[i], exact[i], 1e-13);
  }
}

TEST(SegmentPoints, TileAParallelogramExactlyWhateverItsPlacement)
{
  Dice dice(23);
  for (unsigned int turn = 0; turn < testing::count_cases(8); ++turn)
  {
    compare_tilings<2>({{1}, 3}, {{1}, 4}, 2, dice);
    compare_tilings<2>({{2}, 3}, {{2}, 5}, 2, dice);
    compare_tilings<3>({{1}, 4}, {{1}, 3}, 4, dice);
    for (const FacetElement<3> &contactor : testing::all_elements<3>())
      for (const FacetElement<3> &target : testing::all_elements<3>())
      {
        compare_tilings<3>({contactor, 2}, {target, 3}, target.degree + 1, dice);
        compare_tilings<3>({contactor, 2}, {target, 2}, target.degree + 1, dice); // edges on edges
      }
  }
}

/// One contactor under a turned grid of targets that reaches beyond it, from a distance.
TEST(SegmentPoints, CoverAFacetUnderATurnedGrid)
{
  Dice dice(29);
  for (const FacetElement<3> &element : testing::all_elements<3>())
    for (const FacetElement<3> &target : testing::all_elements<3>())
      for (unsigned int turn = 0; turn < testing::count_cases(10); ++turn)
      {
        const FacetNodes<3> contactor = testing::make_unit_facet(element);
        const Grid<3> grid{target, 8};
        const double angle = dice.number(0., 6.3);
        const SpatialTensor<3> map =
            4.8 * Eigen::AngleAxisd(angle, SpatialVector<3>::UnitZ()).toRotationMatrix();
        const SpatialVector<3> shift = SpatialVector<3>(0.5, 0.5, 0.3) - 0.5 * map.col(0) - 0.5 * map.col(1);
        Points<3> all;
        for (unsigned int t = 0; t < grid.n_facets(); ++t)
          append<3>(all, make_segment_points<3>(contactor, turn_round(grid.facet(t, map, shift)), 3));
        expect_exact_moments<3>(element.type, all, 3);
      }
}

/// Triangles, quadrilaterals that are no parallelograms, also with a corner bent inwards, and warped ones,
/// covered by one target of the same outline, by a larger one, and by grids of targets.
TEST(SegmentPoints, CoverAnyFacet)
{
  Dice dice(31);
  for (unsigned int n = 0; n < testing::count_cases(400); ++n)
  {
    const FacetElement<3> element = testing::all_elements<3>()[n % 4];
    FacetNodes<3> contactor = testing::make_unit_facet(element);
    const double warp = (element.type == FacetType::triangle ? 0.2 : 0.3) / element.degree;
    for (unsigned int i = 0; i < contactor.n_nodes(); ++i)
      contactor.position[i] += warp * dice.point<3>(-1., 1.).cwiseProduct(SpatialVector<3>(1., 1., 0.3));
    expect_exact_moments<3>(element.type, make_segment_points<3>(contactor, turn_round(contactor), 3), 3);
    const SpatialTensor<3> map = 5. * SpatialTensor<3>::Identity();
    for (const FacetElement<3> &target : {FacetElement<3>{1}, FacetElement<3>{1, FacetType::triangle}})
    {
      const FacetNodes<3> large = Grid<3>{target, 1}.facet(0, 2. * map, {-2., -2., 0.1});
      expect_exact_moments<3>(element.type, make_segment_points<3>(contactor, turn_round(large), 3), 3);

      Points<3> all;
      const Grid<3> grid{target, 10};
      for (unsigned int t = 0; t < grid.n_facets(); ++t)
        append<3>(all,
                  make_segment_points<3>(contactor, turn_round(grid.facet(t, map, {-2.07, -2.03, 0.})), 3));
      expect_exact_moments<3>(element.type, all, 3, 1e-12);
    }
  }
  FacetNodes<3> dart = testing::make_unit_facet<3>({1});
  dart.position[3] = {0.3, 0.3, 0.};
  expect_exact_moments<3>(dart.type, make_segment_points<3>(dart, turn_round(dart), 2), 2);
}

TEST(SegmentPoints, AreWhereTheTargetIs)
{
  const FacetNodes<3> contactor = testing::make_unit_facet<3>({1});
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
  const FacetNodes<dim> contactor = testing::make_unit_facet<dim>({1});
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
  const FacetNodes<3> facet = testing::make_unit_facet<3>({1});
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
  FacetNodes<3> target = testing::make_unit_facet<3>({2});
  target.position[5].x() = 0.8; // the side at ξ_0 = 1 bends inwards: two triangles of 0.2 · 0.5 / 2 are lost
  const Points<3> points = make_segment_points<3>(testing::make_unit_facet<3>({1}), turn_round(target), 2);
  EXPECT_NEAR(compute_moment<3>(points, 0, 0), 0.9, 1e-14);
  FacetNodes<3> triangle = testing::make_unit_facet<3>({2, FacetType::triangle});
  triangle.position[4].setConstant(0.4); // a triangle with a base of √2 and a height of 0.1 √2 is lost
  triangle.position[4].z() = 0.;
  const Points<3> rest = make_segment_points<3>(testing::make_unit_facet<3>({1}), turn_round(triangle), 2);
  EXPECT_NEAR(compute_moment<3>(rest, 0, 0), 0.4, 1e-14);
  FacetNodes<2> contactor = testing::make_unit_facet<2>({2}),
                straight = turn_round(testing::make_unit_facet<2>({1}));
  contactor.position[1].x() = 0.4;
  straight.position[0].x() = 0.7; // covers the first sub-facet and half of the second
  EXPECT_NEAR(compute_moment<2>(make_segment_points<2>(contactor, straight, 2), 0, 0), 0.75, 1e-15);
}
} // namespace
} // namespace signorini::contact
