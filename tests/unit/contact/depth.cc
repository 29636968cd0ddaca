// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/geometry/depth.h"

#include "facet_samples.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

namespace signorini::contact
{
namespace
{
using testing::Dice;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A surface put together from loose patches: facets share no node index, only places.
template <int dim>
struct Surface
{
  std::vector<Facet<dim>> facets;
  std::vector<SpatialVector<dim>> positions;
  FacetType type = FacetType::tensor_product;

  /// Adds the patch y(ξ) = origin + Σ ξ_α side_α, cut into n pieces a direction, each of one quadrilateral or
  /// two triangles.
  void add_patch(const SpatialVector<dim> &origin, const std::array<SpatialVector<dim>, dim - 1> &side,
                 const unsigned int n = 1, const unsigned int degree = 1)
  {
    const unsigned int n_parts = (type == FacetType::triangle ? 2 : 1);
    for (unsigned int part = 0; part < n_parts * (dim == 2 ? n : n * n); ++part)
    {
      const unsigned int piece = part / n_parts;
      Facet<dim> facet;
      facet.degree = degree;
      facet.type = type;
      for (unsigned int i = 0; i < facet.n_nodes(); ++i)
      {
        LocalPoint<dim> xi = node_coordinates(facet, i);
        if (part % n_parts == 1)
          xi = LocalPoint<dim>::Ones() - xi;
        SpatialVector<dim> position = origin + (piece % n + xi[0]) / n * side[0];
        if constexpr (dim == 3)
          position += (piece / n + xi[1]) / n * side[1];
        facet.nodes[i] = static_cast<unsigned int>(positions.size());
        positions.push_back(position);
      }
      facets.push_back(facet);
    }
  }

  void add_triangle(const SpatialVector<dim> &a, const SpatialVector<dim> &b, const SpatialVector<dim> &c,
                    const unsigned int degree)
  {
    Facet<dim> facet;
    facet.degree = degree;
    facet.type = FacetType::triangle;
    for (unsigned int i = 0; i < facet.n_nodes(); ++i)
    {
      const LocalPoint<dim> xi = node_coordinates(facet, i);
      facet.nodes[i] = static_cast<unsigned int>(positions.size());
      positions.push_back((1. - xi.sum()) * a + xi[0] * b + xi[dim - 2] * c);
    }
    facets.push_back(facet);
  }

  void move(const std::function<SpatialVector<dim>(const SpatialVector<dim> &)> &map)
  {
    for (auto &position : positions)
      position = map(position);
  }

  SurfaceFoot<dim> find(const SpatialVector<dim> &x, const double cutoff = infinity) const
  {
    std::vector<unsigned int> candidates(facets.size());
    std::iota(candidates.begin(), candidates.end(), 0u);
    return FootSearch<dim>(facets, positions, candidates).find(x, cutoff);
  }
};

/// Closed surface of the box [low, high]; side number k is cut into n[k] pieces a direction.
/// Sides: 2-D −x, +x, −y, +y; 3-D the same and −z, +z.
template <int dim>
void add_box(Surface<dim> &surface, const SpatialVector<dim> &low, const SpatialVector<dim> &high,
             const std::array<unsigned int, 2 * dim> &n, const unsigned int degree = 1)
{
  const SpatialVector<dim> size = high - low;
  for (int axis = 0; axis < dim; ++axis)
    for (int end = 0; end < 2; ++end)
    {
      SpatialVector<dim> origin = low;
      origin[axis] = (end == 1 ? high : low)[axis];
      std::array<SpatialVector<dim>, dim - 1> side;
      if constexpr (dim == 2)
      {
        // (t_y, −t_x) points to +x for t along +y and to −y for t along +x.
        const bool forwards = (axis == 0) == (end == 1);
        side[0] = size[1 - axis] * SpatialVector<2>::Unit(1 - axis);
        if (!forwards)
        {
          origin += side[0];
          side[0] = -side[0];
        }
      }
      else
      {
        const int first = (axis + (end == 1 ? 1 : 2)) % 3, second = (axis + (end == 1 ? 2 : 1)) % 3;
        side = {SpatialVector<dim>(size[first] * SpatialVector<dim>::Unit(first)),
                SpatialVector<dim>(size[second] * SpatialVector<dim>::Unit(second))};
      }
      surface.add_patch(origin, side, n[2 * axis + end], degree);
    }
}

/// Depth below the surface of the box [low, high].
template <int dim>
double find_box_depth(const SpatialVector<dim> &low, const SpatialVector<dim> &high,
                      const SpatialVector<dim> &x)
{
  const SpatialVector<dim> beyond = (low - x).cwiseMax(x - high);
  return beyond.maxCoeff() <= 0. ? -beyond.maxCoeff() : -beyond.cwiseMax(0.).norm();
}

template <int dim>
void compare_with_box(const std::array<unsigned int, 2 * dim> &n, const unsigned int degree,
                      const FacetType type = FacetType::tensor_product)
{
  Dice dice(7);
  const SpatialVector<dim> low = SpatialVector<dim>::Constant(-1.), high = 2. * SpatialVector<dim>::Ones();
  Surface<dim> surface;
  surface.type = type;
  add_box<dim>(surface, low, high, n, degree);
  const SpatialTensor<dim> rotation = dice.rotation<dim>();
  surface.move([&](const SpatialVector<dim> &x) { return SpatialVector<dim>(rotation * x); });
  for (unsigned int i = 0; i < testing::count_cases(10000); ++i)
  {
    const SpatialVector<dim> x = dice.point<dim>(-2.5, 3.5);
    const SurfaceFoot<dim> foot = surface.find(rotation * x);
    ASSERT_NEAR(foot.depth, find_box_depth(low, high, x), 1e-13) << x.transpose();
    ASSERT_NEAR(std::abs(foot.depth), (foot.closest.position - rotation * x).norm(), 1e-13);
  }
}

TEST(Depth, MatchesTheBox)
{
  compare_with_box<2>({1, 1, 1, 1}, 1);
  compare_with_box<2>({2, 3, 1, 4}, 2);
  compare_with_box<3>({1, 1, 1, 1, 1, 1}, 1);
  compare_with_box<3>({1, 1, 1, 1, 1, 1}, 2);
  compare_with_box<3>({1, 1, 1, 1, 1, 1}, 1, FacetType::triangle);
  compare_with_box<3>({2, 1, 1, 2, 1, 1}, 2, FacetType::triangle);
}

TEST(Depth, MatchesTheBoxWithHangingNodes)
{
  compare_with_box<3>({1, 2, 1, 1, 1, 1}, 1);
  compare_with_box<3>({1, 2, 1, 2, 4, 1}, 1);
  compare_with_box<3>({1, 1, 1, 1, 1, 2}, 2);
}

/// Points right at, above and below every kind of place of the box: sides, edges, corners, hanging nodes.
TEST(Depth, IsRightAndNeverNotANumberOnTheSurfaceItself)
{
  Surface<3> quadrilaterals, triangles;
  add_box<3>(quadrilaterals, {0., 0., 0.}, {1., 1., 1.}, {1, 2, 1, 1, 1, 1});
  triangles.type = FacetType::triangle;
  add_box<3>(triangles, {0., 0., 0.}, {1., 1., 1.}, {1, 2, 1, 1, 1, 1});
  const std::array<double, 5> grid = {0., 0.25, 0.5, 0.75, 1.};
  for (const double a : grid)
    for (const double b : grid)
      for (const double c : grid)
        for (const double shift : {0., 1e-14, 1e-9, 1e-6, 1e-3, -1e-9, -1e-3})
        {
          const SpatialVector<3> x =
              SpatialVector<3>(a, b, c) * (1. + shift) - SpatialVector<3>::Constant(0.5 * shift);
          const double exact = find_box_depth<3>({0., 0., 0.}, {1., 1., 1.}, x);
          EXPECT_NEAR(quadrilaterals.find(x).depth, exact, 1e-15) << x.transpose();
          // A foot that is nearer by less than 1e-12 beside a diagonal counts as one on it.
          EXPECT_NEAR(triangles.find(x).depth, exact, 1e-15 + 1e-12 * std::abs(exact)) << x.transpose();
        }
}

template <int dim>
void compare_with_bent_body(const FacetType type)
{
  // [0, 2]² without (1, 2]²: two boxes, their common part left out.
  Surface<dim> surface;
  surface.type = type;
  const auto add = [&](const std::array<double, 4> &ends, const unsigned int n)
  {
    if constexpr (dim == 2)
      surface.add_patch({ends[0], ends[1]}, {SpatialVector<2>(ends[2] - ends[0], ends[3] - ends[1])}, n);
    else
      surface.add_patch(
          {ends[0], ends[1], 0.},
          {SpatialVector<3>(ends[2] - ends[0], ends[3] - ends[1], 0.), SpatialVector<3>(0., 0., 1.)}, n);
  };
  add({0., 0., 2., 0.}, 2);
  add({2., 0., 2., 1.}, 1);
  add({2., 1., 1., 1.}, 2);
  add({1., 1., 1., 2.}, 1);
  add({1., 2., 0., 2.}, 3);
  add({0., 2., 0., 0.}, 2);
  if constexpr (dim == 3)
    for (const auto &[u, v] : {std::pair(0., 0.), std::pair(1., 0.), std::pair(0., 1.)})
    {
      surface.add_patch({u, v, 1.}, {SpatialVector<3>(1., 0., 0.), SpatialVector<3>(0., 1., 0.)},
                        u == 0. ? 1 : 2);
      surface.add_patch({u, v, 0.}, {SpatialVector<3>(0., 1., 0.), SpatialVector<3>(1., 0., 0.)});
    }

  Dice dice(11);
  const auto box_depth =
      [](const SpatialVector<2> &low, const SpatialVector<2> &high, const SpatialVector<dim> &x)
  {
    SpatialVector<dim> l = SpatialVector<dim>::Zero(), h = SpatialVector<dim>::Ones();
    l.template head<2>() = low;
    h.template head<2>() = high;
    return find_box_depth<dim>(l, h, x);
  };
  for (unsigned int i = 0; i < testing::count_cases(10000); ++i)
  {
    SpatialVector<dim> x = dice.point<dim>(-0.5, 2.5);
    if (dim == 3)
      x[2] -= 0.5;
    // Outside: the closer of the two boxes. Inside: the side walls or the re-entrant edge, and the flat ends.
    const double lying = box_depth({0., 0.}, {2., 1.}, x), standing = box_depth({0., 0.}, {1., 2.}, x);
    double exact = std::max(lying, standing);
    if (exact > 0.)
    {
      const double to_edge = (SpatialVector<2>(1., 1.) - x.template head<2>()).cwiseMax(0.).norm();
      exact = std::min({x[0], x[1], 2. - x[0], 2. - x[1], to_edge});
      if (dim == 3)
        exact = std::min({exact, x[dim - 1], 1. - x[dim - 1]});
    }
    ASSERT_NEAR(surface.find(x).depth, exact, 1e-13) << x.transpose();
  }
}

TEST(Depth, MatchesTheBentBody)
{
  compare_with_bent_body<2>(FacetType::tensor_product);
  compare_with_bent_body<3>(FacetType::tensor_product);
  compare_with_bent_body<3>(FacetType::triangle);
}

/// A blade's tip and a steep cone: here the sum of plain normals, or one facet's alone, gives the wrong sign.
void expect_sharp_tip(const FacetType type)
{
  Surface<3> blade;
  blade.type = type;
  add_box<3>(blade, {-1., -1., 0.}, {1., 1., 1.}, {3, 1, 1, 1, 1, 2});
  blade.move(
      [](const SpatialVector<3> &x)
      {
        const double width = 1. - 0.999 * x.z();
        return SpatialVector<3>(width * x.x() + 3. * x.z(), width * x.y(), x.z());
      });
  // Inside iff the map's inverse is inside the box.
  Dice dice(13);
  unsigned int n_outside_near_tip = 0;
  for (unsigned int i = 0; i < testing::count_cases(5000); ++i)
  {
    const SpatialVector<3> x = SpatialVector<3>(3., 0., 1.) + dice.point<3>(-0.5, 0.5);
    const double width = 1. - 0.999 * x.z();
    const bool inside =
        x.z() < 1. && width > 0. && std::abs(x.x() - 3. * x.z()) < width && std::abs(x.y()) < width;
    ASSERT_EQ(blade.find(x).depth > 0., inside) << x.transpose();
    n_outside_near_tip += !inside;
  }
  EXPECT_GT(n_outside_near_tip, testing::count_cases(1000));
  EXPECT_LT(n_outside_near_tip, testing::count_cases(5000));
}

TEST(Depth, HoldsAtASharpTip)
{
  expect_sharp_tip(FacetType::tensor_product);
  expect_sharp_tip(FacetType::triangle);
}

/// Slivers too: depth is the least distance from a face's plane inside, and negative outside.
TEST(Depth, MatchesTetrahedra)
{
  Dice dice(37);
  unsigned int n_inside = 0;
  for (unsigned int i = 0; i < testing::count_cases(300); ++i)
  {
    Surface<3> surface;
    surface.type = FacetType::triangle;
    const double height = std::pow(10., dice.number(-2., 0.));
    Eigen::Matrix<double, 3, 4> corner;
    corner << 0., 1., 0., 0.3, 0., 0., 1., 0.2, 0., 0., 0., 1.;
    corner.row(2) *= height;
    corner += Eigen::Matrix<double, 3, 4>(dice.point<12>(-0.1 * height, 0.1 * height).reshaped(3, 4));
    for (const std::array<int, 3> &face :
         std::vector<std::array<int, 3>>{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}})
      surface.add_triangle(corner.col(face[0]), corner.col(face[1]), corner.col(face[2]), 1 + i % 2);
    Eigen::Matrix4d affine;
    affine << corner, Eigen::RowVector4d::Ones();
    const Eigen::Matrix4d inverse = affine.inverse();
    for (unsigned int n = 0; n < 40; ++n)
    {
      // Half of the points near an edge or a corner.
      Eigen::Vector4d weight = dice.point<4>(-0.3, 1.).array().pow(n % 2 == 0 ? 1. : 5.);
      weight /= weight.sum();
      if (weight.cwiseAbs().maxCoeff() > 3.)
        continue;
      const SpatialVector<3> x = corner * weight;
      const SurfaceFoot<3> foot = surface.find(x);
      double least = infinity;
      for (int k = 0; k < 4; ++k)
        least = std::min(least, weight[k] / inverse.row(k).head<3>().norm());
      if (least > 0.)
        EXPECT_NEAR(foot.depth, least, 1e-13);
      else
        EXPECT_LE(foot.depth, least + 1e-13) << weight.transpose();
      n_inside += least > 0.;
    }
  }
  EXPECT_GT(n_inside, testing::count_cases(1000));
}

/// A closed body of degree 2 with hanging nodes, bent by a quadratic map: its curved sides are exact.
void expect_right_sign_on_curved_body(const FacetType type)
{
  Surface<3> body;
  body.type = type;
  add_box<3>(body, {-1., -1., -1.}, {1., 1., 1.}, {1, 2, 1, 2, 1, 1}, 2);
  const auto bend = [](const SpatialVector<3> &x)
  { return SpatialVector<3>(x.x() + 0.3 * x.y() * x.y(), x.y(), x.z() + 0.2 * x.y() * x.y()); };
  body.move(bend);
  Dice dice(19);
  unsigned int n_inside = 0;
  for (unsigned int i = 0; i < testing::count_cases(4000); ++i)
  {
    const SpatialVector<3> reference = dice.point<3>(-1.5, 1.5);
    const bool inside = reference.cwiseAbs().maxCoeff() < 1.;
    ASSERT_EQ(body.find(bend(reference)).depth > 0., inside) << reference.transpose();
    n_inside += inside;
  }
  EXPECT_GT(n_inside, testing::count_cases(500));
}

TEST(Depth, HasTheRightSignOnACurvedBody)
{
  expect_right_sign_on_curved_body(FacetType::tensor_product);
  expect_right_sign_on_curved_body(FacetType::triangle);
}

TEST(Depth, IsMinusInfinityWhereAllFacetsAreBeyondTheCutoff)
{
  Surface<3> surface;
  add_box<3>(surface, {0., 0., 0.}, {1., 1., 1.}, {1, 1, 1, 1, 1, 1});
  EXPECT_EQ(surface.find({0.5, 0.5, 1.5}, 0.4).depth, -infinity);
  EXPECT_EQ(surface.find({1.3, 1.3, 1.3}, 0.4).depth, -infinity); // inside the cutoff's box, outside its ball
  EXPECT_NEAR(surface.find({0.5, 0.5, 1.5}, 0.6).depth, -0.5, 1e-15);
  EXPECT_NEAR(surface.find({0.5, 0.5, 0.9}, 0.2).depth, 0.1, 1e-15);
  Surface<3> slope; // its box holds the point, its plane is farther than the cutoff
  slope.add_patch({0., 0., 0.}, {SpatialVector<3>(1., 0., 1.), SpatialVector<3>(0., 1., 0.)});
  EXPECT_EQ(slope.find({0.9, 0.5, 0.1}, 0.5).depth, -infinity);
  EXPECT_NEAR(slope.find({0.9, 0.5, 0.1}, 0.6).depth, 0.8 * std::sqrt(0.5), 1e-15);
  EXPECT_EQ(FootSearch<3>(surface.facets, surface.positions, {}).find({0.5, 0.5, 0.5}, 1.).depth, -infinity);
}

TEST(Depth, HasNoInsideBesideTheRimOfAnOpenSurface)
{
  for (const FacetType type : {FacetType::tensor_product, FacetType::triangle})
  {
    Surface<3> surface;
    surface.type = type;
    surface.add_patch({0., 0., 0.}, {SpatialVector<3>(1., 0., 0.), SpatialVector<3>(0., 1., 0.)}, 2);
    EXPECT_NEAR(surface.find({0.5, 0.5, -0.1}).depth, 0.1, 1e-15); // below the middle, where four facets meet
    EXPECT_NEAR(surface.find({1., 0.3, -0.1}).depth, 0.1, 1e-15);  // right below the rim
    EXPECT_NEAR(surface.find({1., 0.3, 0.1}).depth, -0.1, 1e-15);  // right above it
    EXPECT_NEAR(surface.find({1.3, 0.3, -0.1}).depth, -std::hypot(0.3, 0.1), 1e-15);
    EXPECT_NEAR(surface.find({1.3, 1.4, -0.1}).depth, -std::hypot(0.5, 0.1), 1e-15);
  }
  Surface<2> line;
  line.add_patch({0., 0.}, {SpatialVector<2>(-1., 0.)}, 2);
  EXPECT_NEAR(line.find({-0.5, -0.1}).depth, 0.1, 1e-15);
  EXPECT_NEAR(line.find({0., -0.1}).depth, 0.1, 1e-15);
  EXPECT_NEAR(line.find({0.3, -0.1}).depth, -std::hypot(0.3, 0.1), 1e-15);
}
} // namespace
} // namespace signorini::contact
