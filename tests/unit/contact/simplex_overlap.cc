// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/geometry/simplex_overlap.h"

#include "simplex_samples.h"

namespace signorini::contact
{
namespace
{
using namespace testing;

template <typename Dimension>
class SimplexOverlap : public ::testing::Test
{
};
TYPED_TEST_SUITE(SimplexOverlap, Dimensions);

template <int dim>
SpatialVector<dim> position(const Corners<dim> &first,
                            const typename ConvexPolytope<dim>::Coordinates &lambda)
{
  SpatialVector<dim> x = SpatialVector<dim>::Zero();
  for (unsigned int a = 0; a <= dim; ++a)
    x += lambda[a] * first[a];
  return x;
}

/// Sum of the area vectors by the positions of the corners; that of the simplex may be turned inside out.
template <int dim>
SpatialVector<dim> sum_area_vectors(const ConvexPolytope<dim> &part, const Corners<dim> &first)
{
  SpatialVector<dim> sum = SpatialVector<dim>::Zero();
  for (const auto &face : part.faces())
    part.for_each_part(face,
                       [&](const auto &corners)
                       {
                         const SpatialVector<dim> x = position<dim>(first, *corners[0]),
                                                  u = position<dim>(first, *corners[1]) - x;
                         if constexpr (dim == 2)
                           sum += SpatialVector<dim>(u[1], -u[0]);
                         else
                           sum += .5 * u.cross(position<dim>(first, *corners[2]) - x);
                       });
  return sum;
}

template <int dim>
constexpr double factorial = dim == 2 ? 2. : 6.;

/// A corner shifted along (t_x, t_y, …) ≥ 0 leaves a corner of size 1 − Σt.
TYPED_TEST(SimplexOverlap, OfShiftedCorners)
{
  constexpr int dim = TypeParam::value;
  const auto corner = make_unit_corner<dim>();
  Dice dice(1);
  for (unsigned int trial = 0; trial < 50; ++trial)
  {
    const SpatialVector<dim> t = dice.point<dim>(0., .6);
    const double exact = std::pow(std::max(0., 1. - t.sum()), dim) / factorial<dim>;
    for (unsigned int of : {0, 1})
      EXPECT_NEAR(overlap_volume<dim>(corner, shifted<dim>(corner, t), of), exact, 1e-15);
  }
}

/// A simplex and its image in its own centre meet in a hexagon of 2/3 of the area (2-D), or in an octahedron
/// of half the volume.
TYPED_TEST(SimplexOverlap, OfMirrorImages)
{
  constexpr int dim = TypeParam::value;
  Dice dice(2);
  for (unsigned int trial = 0; trial < 20; ++trial)
  {
    const auto simplex = make_random_simplex<dim>(dice);
    const auto image = moved<dim>(simplex, -SpatialTensor<dim>::Identity(), 2. * mean<dim>(simplex));
    const double volume = make_simplex_shape<dim>(simplex).volume;
    EXPECT_NEAR(overlap_volume<dim>(simplex, image), volume * (dim == 2 ? 2. / 3. : .5), 1e-14);
    EXPECT_EQ(overlap_of<dim>(simplex, image).faces().size(), dim == 2 ? 6u : 8u);
  }
}

TYPED_TEST(SimplexOverlap, OfRandomPairsIsClosedAndTheSameFromBothSides)
{
  constexpr int dim = TypeParam::value;
  Dice dice(3);
  unsigned int n_overlaps = 0;
  for (unsigned int trial = 0; trial < count_cases(2000); ++trial)
  {
    const auto first = make_random_simplex<dim>(dice), second = make_random_simplex<dim>(dice);
    const double volume = overlap_volume<dim>(first, second);
    EXPECT_NEAR(volume, overlap_volume<dim>(first, second, 1), 1e-14);
    EXPECT_NEAR(volume, overlap_volume<dim>(second, first), 1e-14);
    const auto overlap = overlap_of<dim>(first, second);
    n_overlaps += overlap.is_empty() ? 0 : 1;
    EXPECT_LT((sum_area_vectors<dim>(overlap, first).norm()), 1e-14);
    double sum = 0.;
    for (unsigned int of : {0, 1})
    {
      sum = 0.;
      for (unsigned int m = 0; m <= dim; ++m)
      {
        const auto sector = restrict_to_sector(overlap, of, m);
        EXPECT_LT((sum_area_vectors<dim>(sector, first).norm()), 1e-14);
        sum += integrate_coordinates(sector, 0).template head<dim + 1>().sum();
      }
      EXPECT_NEAR(sum * make_simplex_shape<dim>(first).volume, volume, 1e-14);
    }
  }
  EXPECT_GT(n_overlaps, count_cases(2000) / 4);
}

/// Share of a lattice of points in one simplex that lie in the other one as well.
TYPED_TEST(SimplexOverlap, AgreesWithCountedPoints)
{
  constexpr int dim = TypeParam::value;
  constexpr unsigned int n = dim == 2 ? 400 : 80;
  Dice dice(4);
  for (unsigned int trial = 0; trial < count_cases(10); ++trial)
  {
    const auto first = make_random_simplex<dim>(dice), second = make_random_simplex<dim>(dice);
    const auto shape = make_simplex_shape<dim>(first), other = make_simplex_shape<dim>(second);
    unsigned int n_inside = 0;
    for (unsigned int i = 0; i < static_cast<unsigned int>(std::pow(n, dim)); ++i)
    {
      SpatialVector<dim> x;
      for (unsigned int axis = 0, rest = i; axis < dim; ++axis, rest /= n)
        x[axis] = (rest % n + .5) / n;
      n_inside += shape.coordinates(x).minCoeff() > 0. && other.coordinates(x).minCoeff() > 0.;
    }
    EXPECT_NEAR((overlap_volume<dim>(first, second)), n_inside / std::pow(n, dim), dim == 2 ? 5e-4 : 1e-3);
  }
}

TYPED_TEST(SimplexOverlap, IsEmptyWhereSimplicesOnlyTouch)
{
  constexpr int dim = TypeParam::value;
  Dice dice(5);
  for (unsigned int trial = 0; trial < 200; ++trial)
  {
    const auto first = make_random_simplex<dim>(dice);
    // Mirrored in one of its own corners, edges' middles or faces' middles: common corner, edge, face.
    for (unsigned int n_common = 1; n_common <= dim; ++n_common)
    {
      SpatialVector<dim> middle = SpatialVector<dim>::Zero();
      for (unsigned int a = 0; a < n_common; ++a)
        middle += first[a] / n_common;
      const auto second = moved<dim>(first, -SpatialTensor<dim>::Identity(), 2. * middle);
      EXPECT_TRUE(overlap_of<dim>(first, second).is_empty()) << n_common;
    }
    // Neighbours by a face, with three corners in common, and with a corner on the face.
    auto neighbour = first;
    SpatialVector<dim> on_face = SpatialVector<dim>::Zero();
    for (unsigned int a = 1; a <= dim; ++a)
      on_face += first[a] / dim;
    neighbour[0] = 2. * on_face - first[0];
    EXPECT_TRUE(overlap_of<dim>(first, neighbour).is_empty());
    EXPECT_TRUE((overlap_of<dim>(first, shifted<dim>(neighbour, on_face - first[1])).is_empty()));
  }
}

TYPED_TEST(SimplexOverlap, OfIdenticalAndCoveredSimplicesIsTheSmallerOne)
{
  constexpr int dim = TypeParam::value;
  Dice dice(6);
  for (unsigned int trial = 0; trial < 50; ++trial)
  {
    const auto large = make_random_simplex<dim>(dice);
    const double volume = make_simplex_shape<dim>(large).volume;
    EXPECT_NEAR(overlap_volume<dim>(large, large), volume, 1e-15);
    EXPECT_EQ(overlap_of<dim>(large, large).faces().size(), dim + 1u);
    auto turned = large;
    std::swap(turned[0], turned[1]);
    EXPECT_NEAR(overlap_volume<dim>(large, turned), volume, 1e-15);
    for (const double size : {.5, 1e-3, 1e-6})
      for (const SpatialVector<dim> &fixed : {large[0], mean<dim>(large)})
      {
        const SpatialVector<dim> shift = (1. - size) * fixed;
        const auto small = moved<dim>(large, size * SpatialTensor<dim>::Identity(), shift);
        const double exact = std::pow(size, dim) * volume;
        EXPECT_NEAR(overlap_volume<dim>(large, small, 1), exact, 1e-14 / size * exact);
        EXPECT_NEAR(overlap_volume<dim>(small, large, 0), exact, 1e-14 / size * exact);
      }
  }
}

/// Thin and distorted simplices, exactly and nearly touching: numbers stay numbers, overlaps stay closed.
TYPED_TEST(SimplexOverlap, SurvivesSlivers)
{
  constexpr int dim = TypeParam::value;
  Dice dice(7);
  for (unsigned int trial = 0; trial < count_cases(3000); ++trial)
  {
    auto first = make_random_simplex<dim>(dice), second = first;
    const double flatness = std::pow(10., dice.number(-9., -1.)), gap = std::pow(10., dice.number(-18., -1.));
    for (auto &x : first)
      x[dim - 1] *= flatness;
    for (auto &x : second)
      x += gap * dice.point<dim>(-1., 1.);
    second[0] = first[trial % (dim + 1)];
    if (trial % 2 == 0)
      second[1] = .5 * (first[0] + first[1]);
    const auto overlap = overlap_of<dim>(first, second);
    const double volume = overlap_volume<dim>(first, second);
    EXPECT_TRUE(std::isfinite(volume));
    EXPECT_GE(volume, 0.);
    EXPECT_LE(volume, make_simplex_shape<dim>(first).volume * (1. + 1e-12));
    EXPECT_LT((sum_area_vectors<dim>(overlap, first).norm()), 1e-14);
  }
  auto flat = make_unit_corner<dim>();
  flat[0] = .5 * (flat[1] + flat[2]);
  EXPECT_TRUE(overlap_of<dim>(flat, make_unit_corner<dim>()).is_empty());
  EXPECT_TRUE(overlap_of<dim>(make_unit_corner<dim>(), flat).is_empty());
}

/// Moments of whole simplices and their faces are known: ∫λ_aλ_b = (1 + δ_ab)/((k+1)(k+2)) on a k-simplex.
TYPED_TEST(SimplexOverlap, IntegralsOfWholeSimplices)
{
  constexpr int dim = TypeParam::value;
  const auto simplex = make_unit_corner<dim>();
  const auto overlap = overlap_of<dim>(simplex, simplex);
  const auto volume_integral = integrate_coordinates(overlap, 1);
  for (unsigned int a = 0; a < 2 * (dim + 1); ++a)
    EXPECT_NEAR(volume_integral[a], 1. / (dim + 1), 1e-15);
  for (const auto &face : overlap.faces())
  {
    const auto moments = integrate_products(overlap, face);
    for (unsigned int a = 0; a <= dim; ++a)
    {
      EXPECT_LT((moments.col(a) - integrate_products_with(overlap, face, a)).norm(), 1e-15);
      for (unsigned int b = 0; b <= dim; ++b)
      {
        const bool is_on_face = a != face.label && b != face.label;
        const double exact = is_on_face ? (a == b ? 2. : 1.) / (dim * (dim + 1)) : 0.;
        EXPECT_NEAR(moments(a, b), exact, 1e-15);
        EXPECT_NEAR(moments(a, dim + 1 + b), exact, 1e-15);
      }
    }
  }
}

TYPED_TEST(SimplexOverlap, MarginMovesAllFacesOutwards)
{
  constexpr int dim = TypeParam::value;
  const auto corner = make_simplex_shape<dim>(make_unit_corner<dim>());
  const SpatialVector<dim> far = SpatialVector<dim>::Constant(-10.);
  const auto all = make_simplex_shape<dim>(
      moved<dim>(make_unit_corner<dim>(), 100. * SpatialTensor<dim>::Identity(), far));
  const double margin = .1;
  const auto overlap = make_overlap(corner, all, margin);
  const double size = 1. + (dim + std::sqrt(dim)) * margin;
  const double volume = integrate_coordinates(overlap, 0).template head<dim + 1>().sum();
  EXPECT_NEAR(volume, std::pow(size, dim), 1e-13);
}
} // namespace
} // namespace signorini::contact
