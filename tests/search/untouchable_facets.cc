// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/search/untouchable_facets.h"

#include "../laws/voxel_surface.h"
#include "signorini/contact/search/coming_contact.h"
#include "signorini/contact/search/neighbour_list.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

using namespace signorini;
using namespace signorini::contact;
using namespace signorini::test;

namespace
{
constexpr double pi = 3.14159265358979323846;
constexpr double voxel_reach = 1., voxel_skin = .5; // of cells of size 1

bool any_pair(unsigned int, unsigned int)
{
  return true;
}

using FacetPairs = std::set<std::pair<unsigned int, unsigned int>>;

template <int dim>
FacetPairs find_pairs(const VoxelSurface<dim> &voxels, const Positions<dim> &x)
{
  NeighbourList<dim> list(voxels.surface, std::vector<double>(voxels.surface.facets.size(), voxel_reach),
                          voxel_skin, any_pair);
  list.rebuild(x);
  FacetPairs pairs;
  for (const FacetNeighbours &found : list.neighbours())
    for (const unsigned int candidate : found.candidates)
      EXPECT_TRUE(pairs.emplace(found.facet, candidate).second) << "listed twice";
  return pairs;
}

template <typename Dimension>
class UntouchableFacets : public testing::Test
{
};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(UntouchableFacets, Dimensions);

/// Bent to half a circle, and pressed together to six tenths.
TYPED_TEST(UntouchableFacets, HoldAllOfAWallThatBends)
{
  constexpr int dim = TypeParam::value;
  constexpr unsigned int length = 12;
  const VoxelSurface<dim> wall(make_wall<dim>(length));
  const auto &x = wall.surface.reference_positions;
  EXPECT_TRUE(find_pairs<dim>(wall, x).empty());
  auto squashed = x, bent = x;
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    squashed[i][dim - 1] *= .6;
    const double angle = pi * x[i][0] / length, radius = length / pi + x[i][dim - 1];
    bent[i][0] = radius * std::sin(angle);
    bent[i][dim - 1] = radius * std::cos(angle);
  }
  EXPECT_TRUE(find_pairs<dim>(wall, squashed).empty());
  EXPECT_TRUE(find_pairs<dim>(wall, bent).empty());
}

/// The two sides of a slit in a block, plain or bent, see each other all along, and nothing beyond each
/// other.
TYPED_TEST(UntouchableFacets, LeaveTheSidesOfASlit)
{
  constexpr int dim = TypeParam::value;
  for (const double gap : {1e-9, 1e-2})
    for (const double curvature : {0., .1, -.1})
    {
      VoxelBody<dim> block;
      block.n_cells.fill(5);
      block.n_cells[0] = 10;
      block.is_filled = [](const auto &cell) { return cell[0] < 2 || cell[dim - 1] != 2; };
      block.place = [=](const auto &lattice)
      {
        SpatialVector<dim> x = lattice_point<dim>(lattice);
        if (lattice[dim - 1] > 2)
          x[dim - 1] += gap - 1.;
        if (curvature != 0.)
        {
          const double angle = curvature * x[0], radius = 1. / curvature + x[dim - 1];
          x[0] = radius * std::sin(angle);
          x[dim - 1] = radius * std::cos(angle);
        }
        return x;
      };
      const VoxelSurface<dim> slit(block);
      const auto found = find_pairs<dim>(slit, slit.surface.reference_positions);
      unsigned int n_opposite = 0;
      for (unsigned int f = 0; f < slit.normals.size(); ++f)
        for (unsigned int t = 0; t < slit.normals.size(); ++t)
        {
          const bool is_listed = found.count({f, t}) == 1;
          const double height = slit.centres[f][dim - 1];
          SpatialVector<dim> apart = (slit.centres[f] - slit.centres[t]).cwiseAbs();
          apart[0] = std::max(apart[0], 1.); // opposite, or by one cell further along the bend
          if ((height == 2. || height == 3.) && apart.norm() == std::sqrt(2.) && apart[dim - 1] == 1. &&
              slit.normals[f] == -slit.normals[t] && slit.normals[f][dim - 1] == (height == 2. ? 1. : -1.))
          {
            ++n_opposite;
            EXPECT_TRUE(is_listed);
          }
          if (curvature == 0. && (height == 0. || height == 5.))
          {
            EXPECT_FALSE(is_listed);
          }
        }
      EXPECT_EQ(n_opposite, 2u * (8u + 2u * 7u) * (dim == 2 ? 1u : 5u));
    }
}

/// Whether a facet of a C of unit cells may touch another one, told from its lattice.
template <int dim>
bool may_touch(const VoxelSurface<dim> &c, unsigned int f, unsigned int t)
{
  const auto &facet = c.surface.facets[f], &other = c.surface.facets[t];
  const auto height = [&c](unsigned int one, unsigned int of_plane)
  {
    double lowest = 1e9;
    for (unsigned int a = 0; a < c.surface.facets[one].n_nodes(); ++a)
      lowest = std::min(lowest,
                        (c.surface.reference_positions[c.surface.facets[one].nodes[a]] - c.centres[of_plane])
                            .dot(c.normals[of_plane]));
    return lowest;
  };
  if (height(t, f) > 0. || height(f, t) > 0. || (c.normals[f] != c.normals[t] && height(f, t) >= 0.))
    return true;
  for (unsigned int a = 0; a < facet.n_nodes(); ++a)
    if (std::count(other.nodes.begin(), other.nodes.begin() + other.n_nodes(), facet.nodes[a]) > 0)
      return false;
  SpatialVector<dim> apart = (c.centres[t] - c.centres[f]).cwiseAbs();
  for (const auto &normal : {c.normals[f], c.normals[t]})
    apart -= .5 * (SpatialVector<dim>::Ones() - normal.cwiseAbs());
  return apart.cwiseMax(0.).norm() > 2. * voxel_reach + voxel_skin;
}

TYPED_TEST(UntouchableFacets, AreTakenFromAllNearOnes)
{
  constexpr int dim = TypeParam::value;
  VoxelSurface<dim> c(make_c<dim>(9));
  for (unsigned int f = 0; f < c.surface.facets.size(); f += 3)
    c.surface.facets[f].owned = false;
  // Rolled up until the back meets the ends of the arms, and pushed together.
  const auto x = c.positions(
      [](const auto &lattice)
      {
        SpatialVector<dim> position = .7 * lattice_point<dim>(lattice);
        const double angle = 2. * pi / 10. * lattice[0], radius = 1.5 + position[dim - 1];
        position[0] = radius * std::sin(angle);
        position[dim - 1] = radius * std::cos(angle);
        return position;
      });
  FacetPairs expected;
  for (unsigned int f = 0; f < c.surface.facets.size(); ++f)
    for (unsigned int t = 0; t < c.surface.facets.size(); ++t)
      if (c.surface.facets[f].owned && may_touch(c, f, t) &&
          make_facet_box(c.surface.facets[f], x).exteriorDistance(make_facet_box(c.surface.facets[t], x)) <=
              voxel_reach + voxel_skin)
        expected.emplace(f, t);
  EXPECT_GT(expected.size(), 50u);
  EXPECT_EQ(find_pairs<dim>(c, x), expected);
}

TYPED_TEST(UntouchableFacets, AreNoneOfBodiesThatDoNotTouchThemselves)
{
  constexpr int dim = TypeParam::value;
  const VoxelSurface<dim> c(make_c<dim>(4));
  const std::vector<double> distances(c.surface.facets.size(), 1.);
  for (const auto &list : find_untouchable_facets<dim>(c.surface, distances, [](auto) { return false; }))
    EXPECT_TRUE(list.empty());
  for (const auto &list : find_untouchable_facets<dim>(c.surface, distances, [](auto) { return true; }))
    EXPECT_FALSE(list.empty());
}

/// The arms of a C that fly together are about to meet, and nothing else of it is.
TYPED_TEST(UntouchableFacets, AreNotComing)
{
  constexpr int dim = TypeParam::value;
  auto c = make_c<dim>(8);
  c.place = [](const auto &lattice)
  {
    SpatialVector<dim> x = lattice_point<dim>(lattice);
    x[dim - 1] += lattice[dim - 1] > 1 ? 3. : 0.;
    return x;
  };
  const VoxelSurface<dim> voxels(c);
  StraightMotion<dim> motion;
  motion.positions = voxels.surface.reference_positions;
  motion.velocities.assign(motion.positions.size(), SpatialVector<dim>::Zero());
  motion.duration = 1.;
  const std::vector<double> margins(voxels.surface.facets.size(), .6);
  const auto find = [&](const auto &is_allowed)
  {
    return find_coming_contact<dim>(voxels.surface, motion, margins, {SpatialVector<dim>::Zero()},
                                    is_allowed);
  };
  EXPECT_TRUE(find(any_pair).empty());
  for (std::size_t i = 0; i < motion.positions.size(); ++i)
    if (motion.positions[i][dim - 1] > 2. && motion.positions[i][0] > 4.5)
      motion.velocities[i][dim - 1] = -3.5;
  const std::vector<unsigned int> found = find(any_pair);
  for (const unsigned int f : found)
    EXPECT_GT(voxels.centres[f][0], 3.);
  unsigned int n_inner = 0;
  for (unsigned int f = 0; f < voxels.normals.size(); ++f)
    if (const double height = voxels.centres[f][dim - 1];
        voxels.centres[f][0] > 5. && (height == 1. || height == 2.))
    {
      EXPECT_TRUE(std::binary_search(found.begin(), found.end(), f));
      ++n_inner;
    }
  EXPECT_GT(n_inner, 5u);
  EXPECT_TRUE(find([](auto one, auto other) { return one != other; }).empty());
}
} // namespace
