// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/search/neighbour_list.h"

#include "../laws/box_surface.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

using namespace signorini;
using namespace signorini::contact;
using namespace signorini::test;

namespace
{
constexpr double skin = .1;
constexpr double reach = .15;

/// Boxes of random places and sizes, some overlapping, some far; in 3-D every other one of triangles.
template <int dim>
ContactSurface<dim> make_scene(unsigned int n_boxes, unsigned int degree, unsigned int seed)
{
  BoxSurfaceBuilder<dim> builder;
  RandomVectors<dim> random(seed);
  for (unsigned int i = 0; i < n_boxes; ++i)
  {
    BoxBody<dim> box;
    box.corner = random.vector(3.);
    box.size = SpatialVector<dim>::Constant(random.number(.3, 1.5));
    box.degree = degree;
    box.n_faces = 1 + i % 3;
    if (dim == 3 && i % 2 == 1)
      box.type = FacetType::triangle;
    builder.add(box);
  }
  return builder.surface;
}

/// Points all over a facet.
template <int dim>
std::vector<SpatialVector<dim>> sprinkle(const Facet<dim> &facet, const Positions<dim> &x)
{
  constexpr unsigned int n = (dim == 2 ? 24 : 5);
  const FacetNodes<dim> nodes = gather_nodes(facet, x);
  std::vector<SpatialVector<dim>> points;
  for (unsigned int row = 0; row <= (dim == 2 ? 0 : n); ++row)
    for (unsigned int column = 0; column + (facet.type == FacetType::triangle ? row : 0) <= n; ++column)
    {
      LocalPoint<dim> xi = LocalPoint<dim>::Constant(static_cast<double>(row) / n);
      xi[0] = static_cast<double>(column) / n;
      points.push_back(evaluate_facet_frame(nodes, xi).position);
    }
  return points;
}

using FacetPairs = std::set<std::pair<unsigned int, unsigned int>>;

/// Pairs with two sprinkled points within reach: every one of them must be in a valid list.
template <int dim>
FacetPairs find_touching_pairs(const ContactSurface<dim> &surface, const Positions<dim> &x)
{
  std::vector<std::vector<SpatialVector<dim>>> points;
  std::vector<BoundingBox<dim>> boxes(surface.facets.size());
  for (unsigned int f = 0; f < surface.facets.size(); ++f)
  {
    points.push_back(sprinkle(surface.facets[f], x));
    for (const auto &point : points.back())
      boxes[f].extend(point);
  }
  FacetPairs pairs;
  for (unsigned int f = 0; f < surface.facets.size(); ++f)
    for (unsigned int t = 0; t < surface.facets.size(); ++t)
      if (surface.facets[f].body != surface.facets[t].body && boxes[f].exteriorDistance(boxes[t]) <= reach)
      {
        double smallest = std::numeric_limits<double>::infinity();
        for (const auto &p : points[f])
          for (const auto &q : points[t])
            smallest = std::min(smallest, (p - q).squaredNorm());
        if (smallest <= reach * reach)
          pairs.emplace(f, t);
      }
  return pairs;
}

template <int dim>
FacetPairs collect_pairs(const NeighbourList<dim> &list)
{
  FacetPairs pairs;
  for (const auto &neighbours : list.neighbours())
    for (const unsigned int candidate : neighbours.candidates)
      EXPECT_TRUE(pairs.emplace(neighbours.facet, candidate).second) << "listed twice";
  return pairs;
}

unsigned int count_missing(const FacetPairs &needed, const FacetPairs &found)
{
  unsigned int n = 0;
  for (const auto &pair : needed)
    n += 1 - static_cast<unsigned int>(found.count(pair));
  return n;
}

/// Nodes bent out of place, so that faces of degree 2 bulge.
template <int dim>
Positions<dim> deform(const ContactSurface<dim> &surface, unsigned int seed)
{
  RandomVectors<dim> random(seed);
  return shifted<dim>(surface.reference_positions, random.field(surface.n_nodes(), .1), 1.);
}

/// Moves every node by exactly `length` in a random direction.
template <int dim>
Positions<dim> shake(const Positions<dim> &x, double length, unsigned int seed)
{
  RandomVectors<dim> random(seed);
  Positions<dim> moved(x);
  for (auto &position : moved)
    position += length * random.vector(1.).normalized();
  return moved;
}

template <typename Dimension>
class NeighbourListTest : public testing::Test
{
};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(NeighbourListTest, Dimensions);

TYPED_TEST(NeighbourListTest, HoldsAllTouchingPairsWithinTheSkin)
{
  constexpr int dim = TypeParam::value;
  for (unsigned int degree : {1u, 2u})
    for (unsigned int seed = 0; seed < 3; ++seed)
    {
      const auto surface = make_scene<dim>(7, degree, seed);
      const auto built_at = deform(surface, seed);
      NeighbourList<dim> list(surface, std::vector<double>(surface.facets.size(), reach), skin,
                              different_bodies);
      list.rebuild(built_at);
      const FacetPairs found = collect_pairs(list);
      const FacetPairs needed = find_touching_pairs(surface, built_at);
      EXPECT_GT(needed.size(), 4u) << "an empty scene proves nothing";
      EXPECT_EQ(count_missing(needed, found), 0u);

      const auto moved = shake<dim>(built_at, .49 * skin, seed + 10);
      EXPECT_FALSE(list.is_stale(moved));
      EXPECT_EQ(count_missing(find_touching_pairs(surface, moved), found), 0u);
    }
}

/// The boxes of the facets of all bodies, compared one by one: the list must hold these pairs and no others.
TYPED_TEST(NeighbourListTest, AgreesWithBruteForceOverBoxes)
{
  constexpr int dim = TypeParam::value;
  for (unsigned int degree : {1u, 2u})
  {
    auto surface = make_scene<dim>(20, degree, 77);
    for (unsigned int f = 0; f < surface.facets.size(); f += 3)
      surface.facets[f].owned = false;
    const auto x = deform(surface, 5);
    const auto is_allowed = [](unsigned int a, unsigned int b) { return a != b && (a + b) % 5 != 0; };
    NeighbourList<dim> list(surface, std::vector<double>(surface.facets.size(), reach), skin, is_allowed);
    list.rebuild(x);

    FacetPairs expected;
    double factor = 0.;
    for (const auto &facet : surface.facets)
      factor = std::max(factor, lebesgue_constant(facet));
    const double distance = reach + factor * skin;
    for (unsigned int f = 0; f < surface.facets.size(); ++f)
      for (unsigned int t = 0; t < surface.facets.size(); ++t)
      {
        const auto &facet = surface.facets[f];
        const auto &target = surface.facets[t];
        if (facet.owned && facet.body != target.body && is_allowed(facet.body, target.body) &&
            make_facet_box(facet, x).exteriorDistance(make_facet_box(target, x)) <= distance)
          expected.emplace(f, t);
      }
    EXPECT_GT(expected.size(), 50u);
    EXPECT_EQ(collect_pairs(list), expected);
  }
}

TYPED_TEST(NeighbourListTest, FacetBoxHoldsTheWholeFacet)
{
  constexpr int dim = TypeParam::value;
  for (unsigned int degree : {1u, 2u})
  {
    const auto surface = make_scene<dim>(3, degree, 3);
    const auto x = shake<dim>(surface.reference_positions, .3, 9);
    for (const auto &facet : surface.facets)
      for (const auto &point : sprinkle(facet, x))
        EXPECT_LT(make_facet_box(facet, x).exteriorDistance(point), 1e-12);
  }
}

TYPED_TEST(NeighbourListTest, IsStaleBeyondHalfTheSkinOnly)
{
  constexpr int dim = TypeParam::value;
  const auto surface = make_scene<dim>(4, 1, 1);
  NeighbourList<dim> list(surface, std::vector<double>(surface.facets.size(), reach), skin, different_bodies);
  EXPECT_TRUE(list.is_stale(surface.reference_positions));
  list.rebuild(surface.reference_positions);
  EXPECT_EQ(list.n_rebuilds(), 1u);
  auto moved = surface.reference_positions;
  moved.back() += .499 * skin * SpatialVector<dim>::Ones().normalized();
  EXPECT_FALSE(list.is_stale(moved));
  moved.back() = surface.reference_positions.back() + .501 * skin * SpatialVector<dim>::Ones().normalized();
  EXPECT_TRUE(list.is_stale(moved));
  list.rebuild(moved);
  EXPECT_FALSE(list.is_stale(moved));
  EXPECT_EQ(list.n_rebuilds(), 2u);
}

/// A floor of n × n touching boxes: pairs a box must not depend on n (edges of the floor aside).
TYPED_TEST(NeighbourListTest, PairsGrowWithTheNumberOfFacetsOnly)
{
  constexpr int dim = TypeParam::value;
  const auto pairs_a_body = [](unsigned int n)
  {
    BoxSurfaceBuilder<dim> builder;
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
      {
        BoxBody<dim> box;
        box.corner[0] = 1.01 * i;
        box.corner[1] = 1.01 * j;
        builder.add(box);
      }
    const auto &surface = builder.surface;
    NeighbourList<dim> list(surface, std::vector<double>(surface.facets.size(), reach), skin,
                            different_bodies);
    list.rebuild(surface.reference_positions);
    return static_cast<double>(collect_pairs(list).size()) / surface.n_bodies;
  };
  const double few = pairs_a_body(4);
  const double many = pairs_a_body(16);
  EXPECT_GT(few, 1.);
  EXPECT_LT(many, 1.6 * few); // a body inside has 8 neighbours, one of the smaller floor 5.25 on average
}

TEST(NeighbourList, RejectsWhatDoesNotFit)
{
  const auto surface = make_scene<2>(2, 1, 1);
  EXPECT_THROW(NeighbourList<2>(surface, {1.}, skin, different_bodies), std::invalid_argument);
  const std::vector<double> all_reach(surface.facets.size(), reach);
  EXPECT_THROW(NeighbourList<2>(surface, all_reach, 0., different_bodies), std::invalid_argument);
}
} // namespace
