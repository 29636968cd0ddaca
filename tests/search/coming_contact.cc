// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/search/coming_contact.h"

#include "../laws/box_surface.h"
#include "signorini/contact/geometry/closest_point.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

using namespace signorini;
using namespace signorini::contact;
using namespace signorini::test;

namespace
{
constexpr double margin = .3;

/// Boxes that fly in all directions, each turning and trembling a little.
template <int dim>
struct FlyingBoxes
{
  FlyingBoxes(unsigned int n_boxes, unsigned int degree, unsigned int seed)
  {
    RandomVectors<dim> random(seed);
    BoxSurfaceBuilder<dim> builder;
    for (unsigned int i = 0; i < n_boxes; ++i)
    {
      BoxBody<dim> box;
      box.corner = random.vector(dim == 2 ? 3. : 1.5);
      box.size = SpatialVector<dim>::Constant(random.number(.4, 1.));
      box.degree = degree;
      if (dim == 3 && i % 2 == 1)
        box.type = FacetType::triangle;
      builder.add(box);
    }
    surface = builder.surface;
    motion.positions = surface.reference_positions;
    motion.velocities = random.field(surface.n_nodes(), .2);
    motion.duration = .1;
    std::vector<SpatialVector<dim>> flights = random.field(n_boxes, 8.);
    std::vector<unsigned int> body_of_node(surface.n_nodes());
    for (const Facet<dim> &facet : surface.facets)
      for (unsigned int a = 0; a < facet.n_nodes(); ++a)
        body_of_node[facet.nodes[a]] = facet.body;
    for (unsigned int node = 0; node < surface.n_nodes(); ++node)
      motion.velocities[node] += flights[body_of_node[node]];
  }

  Positions<dim> at(double time) const
  {
    Positions<dim> x = motion.positions;
    for (unsigned int node = 0; node < x.size(); ++node)
      x[node] += time * motion.velocities[node];
    return x;
  }

  /// Distance of the corners of a facet from another one.
  double distance(unsigned int f, unsigned int other, const Positions<dim> &x) const
  {
    double nearest = std::numeric_limits<double>::max();
    const FacetNodes<dim> nodes = gather_nodes(surface.facets[other], x);
    for (unsigned int a = 0; a < surface.facets[f].n_nodes(); ++a)
      nearest = std::min(nearest, find_closest_point(nodes, x[surface.facets[f].nodes[a]]).distance);
    return nearest;
  }

  /// Means over the facets of each body.
  std::vector<SpatialVector<dim>> body_velocities() const
  {
    std::vector<SpatialVector<dim>> velocities(surface.n_bodies, SpatialVector<dim>::Zero());
    std::vector<double> n_facets(surface.n_bodies, 0.);
    for (const Facet<dim> &facet : surface.facets)
    {
      velocities[facet.body] += motion.mean_velocity(facet);
      ++n_facets[facet.body];
    }
    for (unsigned int body = 0; body < velocities.size(); ++body)
      velocities[body] /= n_facets[body];
    return velocities;
  }

  ContactSurface<dim> surface;
  StraightMotion<dim> motion;
};

/// Facets that any of some moments brings within the margin are found; none is that no speed could bring
/// near.
/// Returns how many come near that are far now.
template <int dim>
unsigned int compare_with_all_pairs(unsigned int degree, unsigned int seed)
{
  const FlyingBoxes<dim> boxes(dim == 2 ? 8 : 5, degree, seed);
  const auto &facets = boxes.surface.facets;
  const std::vector<double> margins(facets.size(), margin);
  const std::vector<unsigned int> found = find_coming_contact<dim>(boxes.surface, boxes.motion, margins,
                                                                   boxes.body_velocities(), different_bodies);
  EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
  constexpr double largest_relative_speed = 2. * (8. * 1.8 + .4) * 1.6;
  unsigned int n_coming = 0;
  for (unsigned int f = 0; f < facets.size(); ++f)
  {
    double nearest_ever = std::numeric_limits<double>::max(), nearest_now = nearest_ever;
    for (unsigned int other = 0; other < facets.size(); ++other)
      if (facets[other].body != facets[f].body)
      {
        nearest_now = std::min(nearest_now, boxes.distance(f, other, boxes.motion.positions));
        for (const double share : {0., .25, .5, .75, 1.})
          nearest_ever =
              std::min(nearest_ever, boxes.distance(f, other, boxes.at(share * boxes.motion.duration)));
      }
    const bool is_found = std::binary_search(found.begin(), found.end(), f);
    if (nearest_ever <= margin)
    {
      EXPECT_TRUE(is_found) << "facet " << f << " comes as near as " << nearest_ever;
      n_coming += nearest_now > margin;
    }
    if (nearest_now > margin + 1. + boxes.motion.duration * largest_relative_speed)
    {
      EXPECT_FALSE(is_found) << "facet " << f << " is as far as " << nearest_now;
    }
  }
  EXPECT_LT(found.size(), facets.size());
  return n_coming;
}

TEST(ComingContact, AgreesWithAllPairs)
{
  unsigned int n_coming = 0;
  for (unsigned int seed = 1; seed <= 6; ++seed)
    for (const unsigned int degree : {1u, 2u})
      n_coming += compare_with_all_pairs<2>(degree, seed);
  EXPECT_GT(n_coming, 5u);
  n_coming = 0;
  for (unsigned int seed = 1; seed <= 4; ++seed)
    n_coming += compare_with_all_pairs<3>(1, seed);
  n_coming += compare_with_all_pairs<3>(2, 5);
  EXPECT_GT(n_coming, 5u);
}

/// Two unit boxes, one above the other by `gap`.
template <int dim>
FlyingBoxes<dim> make_two_boxes(double gap)
{
  FlyingBoxes<dim> boxes(0, 1, 1);
  BoxSurfaceBuilder<dim> builder;
  BoxBody<dim> box;
  builder.add(box);
  box.corner[dim - 1] = 1. + gap;
  builder.add(box);
  boxes.surface = builder.surface;
  boxes.motion.positions = boxes.surface.reference_positions;
  boxes.motion.velocities.assign(boxes.surface.n_nodes(), SpatialVector<dim>::Zero());
  boxes.motion.duration = 1.;
  return boxes;
}

TEST(ComingContact, SeesOnlyTheFacesThatMeet)
{
  FlyingBoxes<3> boxes = make_two_boxes<3>(1.);
  const std::vector<double> margins(boxes.surface.facets.size(), .1);
  const auto find = [&]()
  {
    return find_coming_contact<3>(boxes.surface, boxes.motion, margins, boxes.body_velocities(),
                                  different_bodies);
  };
  EXPECT_TRUE(find().empty());
  for (unsigned int node = 0; node < boxes.surface.n_nodes(); ++node)
    boxes.motion.velocities[node][2] = boxes.motion.positions[node][2] > 1.5 ? -.95 : 0.;
  const std::vector<unsigned int> found = find();
  EXPECT_EQ(found.size(), 8u + 16u) << "the faces that look at each other and half of those beside them";
  for (auto &v : boxes.motion.velocities)
    v[2] = -100.;
  EXPECT_TRUE(find().empty()) << "bodies that fly together do not meet";
  EXPECT_TRUE(find_coming_contact<3>(boxes.surface, boxes.motion, margins, boxes.body_velocities(),
                                     [](auto, auto) { return false; })
                  .empty());
}

TEST(ComingContact, SeesObstacles)
{
  FlyingBoxes<2> boxes = make_two_boxes<2>(5.);
  const std::vector<double> margins(boxes.surface.facets.size(), .1);
  const RigidPlane<2> floor("floor", {0., -1.}, {0., 1.});
  const auto find = [&]()
  {
    return find_coming_contact<2>(boxes.surface, boxes.motion, margins, floor,
                                  [](unsigned int body) { return body == 0; });
  };
  EXPECT_TRUE(find().empty());
  for (auto &v : boxes.motion.velocities)
    v[1] = -.95;
  for (const unsigned int f : find())
    EXPECT_EQ(boxes.surface.facets[f].body, 0u);
  EXPECT_EQ(find().size(), 4u) << "two below, and one beside each";
  boxes.surface.facets[find().front()].owned = false;
  EXPECT_EQ(find().size(), 3u);
}
} // namespace
