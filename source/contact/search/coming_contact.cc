// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/search/coming_contact.h"

#include "signorini/contact/geometry/closest_point.h"
#include "signorini/contact/search/box_tree.h"
#include "signorini/contact/search/untouchable_facets.h"

#include <algorithm>

namespace signorini::contact
{
namespace
{
template <int dim>
class ComingContactSearch
{
public:
  ComingContactSearch(const ContactSurface<dim> &contact_surface, const StraightMotion<dim> &straight_motion,
                      const std::vector<SpatialVector<dim>> &velocities_of_bodies,
                      std::vector<std::vector<unsigned int>> untouchable_facets)
      : surface(contact_surface), motion(straight_motion), untouchable(std::move(untouchable_facets)),
        body_velocities(velocities_of_bodies), facets_of_body(contact_surface.n_bodies)
  {
    std::vector<BoundingBox<dim>> bodies(surface.n_bodies);
    std::vector<unsigned int> all_bodies;
    for (unsigned int f = 0; f < surface.facets.size(); ++f)
      facets_of_body[surface.facets[f].body].push_back(f);
    for (unsigned int body = 0; body < surface.n_bodies; ++body)
    {
      for (const unsigned int f : facets_of_body[body])
        bodies[body].extend(motion.swept_box(surface.facets[f], SpatialVector<dim>::Zero()));
      all_bodies.push_back(body);
    }
    body_boxes = bodies;
    body_tree = make_tree<dim>(bodies, all_bodies);
  }

  /// Bodies that come as near to `body` as `margin`, itself among them.
  std::vector<unsigned int> find_near_bodies(unsigned int body, double margin) const
  {
    std::vector<TreeEntry<dim>> found;
    body_tree.query(boost::geometry::index::intersects(make_tree_box<dim>(body_boxes[body], margin)),
                    std::back_inserter(found));
    std::vector<unsigned int> bodies;
    for (const TreeEntry<dim> &entry : found)
      bodies.push_back(entry.second);
    return bodies;
  }

  /// Marks the owned facets of `body` that may meet `target`, seen by one who moves along with it.
  void mark(unsigned int body, unsigned int target, const std::vector<double> &margins,
            std::vector<bool> &is_coming) const
  {
    std::vector<BoundingBox<dim>> boxes(surface.facets.size());
    for (const unsigned int f : facets_of_body[target])
      boxes[f] = motion.swept_box(surface.facets[f], body_velocities[target]);
    const BoxTree<dim> tree = make_tree<dim>(boxes, facets_of_body[target]);
    std::vector<TreeEntry<dim>> near;
    for (const unsigned int f : facets_of_body[body])
    {
      if (!surface.facets[f].owned || is_coming[f])
        continue;
      near.clear();
      tree.query(boost::geometry::index::intersects(make_tree_box<dim>(
                     motion.swept_box(surface.facets[f], body_velocities[target]), margins[f])),
                 std::back_inserter(near));
      is_coming[f] = !near.empty() && is_any_near(f, near, margins[f]);
    }
  }

  const std::vector<unsigned int> &facets_of(unsigned int body) const { return facets_of_body[body]; }

private:
  bool is_any_near(unsigned int f, const std::vector<TreeEntry<dim>> &near, double margin) const
  {
    const Facet<dim> &facet = surface.facets[f];
    const std::vector<SpatialVector<dim>> lattice = make_lattice(facet, motion.positions, margin);
    for (const TreeEntry<dim> &entry : near)
    {
      const Facet<dim> &other = surface.facets[entry.second];
      if (share_a_node(facet, other) ||
          std::binary_search(untouchable[f].begin(), untouchable[f].end(), entry.second))
        continue;
      const SpatialVector<dim> reference = motion.mean_velocity(other);
      const double reach = margin + motion.duration * (motion.largest_speed(facet, reference) +
                                                       motion.largest_speed(other, reference));
      const BoundingBox<dim> box = make_facet_box(other, motion.positions);
      const FacetNodes<dim> nodes = gather_nodes(other, motion.positions);
      for (const SpatialVector<dim> &x : lattice)
        if (box.exteriorDistance(x) <= reach && find_closest_point(nodes, x).distance <= reach)
          return true;
    }
    return false;
  }

  const ContactSurface<dim> &surface;
  const StraightMotion<dim> &motion;
  std::vector<std::vector<unsigned int>> untouchable; ///< of its own body, one a facet
  const std::vector<SpatialVector<dim>> &body_velocities;
  std::vector<std::vector<unsigned int>> facets_of_body;
  std::vector<BoundingBox<dim>> body_boxes; ///< swept, for one at rest
  BoxTree<dim> body_tree;
};

std::vector<unsigned int> indices_of(const std::vector<bool> &flags)
{
  std::vector<unsigned int> indices;
  for (unsigned int i = 0; i < flags.size(); ++i)
    if (flags[i])
      indices.push_back(i);
  return indices;
}
} // namespace

template <int dim>
SpatialVector<dim> StraightMotion<dim>::mean_velocity(const Facet<dim> &facet) const
{
  SpatialVector<dim> sum = SpatialVector<dim>::Zero();
  for (unsigned int a = 0; a < facet.n_nodes(); ++a)
    sum += velocities[facet.nodes[a]];
  return sum / facet.n_nodes();
}

template <int dim>
double StraightMotion<dim>::largest_speed(const Facet<dim> &facet,
                                          const SpatialVector<dim> &of_observer) const
{
  double largest = 0.;
  for (unsigned int a = 0; a < facet.n_nodes(); ++a)
    largest = std::max(largest, (velocities[facet.nodes[a]] - of_observer).norm());
  return lebesgue_constant(facet) * largest;
}

template <int dim>
BoundingBox<dim> StraightMotion<dim>::swept_box(const Facet<dim> &facet,
                                                const SpatialVector<dim> &of_observer) const
{
  std::vector<SpatialVector<dim>> ends(facet.n_nodes());
  Facet<dim> moved = facet;
  for (unsigned int a = 0; a < facet.n_nodes(); ++a)
  {
    moved.nodes[a] = a;
    ends[a] = positions[facet.nodes[a]] + duration * (velocities[facet.nodes[a]] - of_observer);
  }
  BoundingBox<dim> box = make_facet_box(facet, positions);
  box.extend(make_facet_box(moved, ends));
  return box;
}

template <int dim>
std::vector<unsigned int>
find_coming_contact(const ContactSurface<dim> &surface, const StraightMotion<dim> &motion,
                    const std::vector<double> &margins,
                    const std::vector<SpatialVector<dim>> &body_velocities,
                    const std::function<bool(unsigned int, unsigned int)> &is_allowed_pair)
{
  // As wide as for facets of the file's mesh: those of a refined one are near each other along the surface.
  std::vector<double> distances;
  for (const double margin : margins)
    distances.push_back(4. * margin);
  const ComingContactSearch<dim> search(
      surface, motion, body_velocities,
      find_untouchable_facets<dim>(surface, distances,
                                   [&](unsigned int body) { return is_allowed_pair(body, body); }));
  std::vector<bool> is_coming(surface.facets.size(), false);
  for (unsigned int body = 0; body < surface.n_bodies; ++body)
  {
    double margin = 0.;
    for (const unsigned int f : search.facets_of(body))
      margin = std::max(margin, surface.facets[f].owned ? margins[f] : 0.);
    for (const unsigned int target : search.find_near_bodies(body, margin))
      if (is_allowed_pair(body, target))
        search.mark(body, target, margins, is_coming);
  }
  return indices_of(is_coming);
}

template <int dim>
std::vector<unsigned int>
find_coming_contact(const ContactSurface<dim> &surface, const StraightMotion<dim> &motion,
                    const std::vector<double> &margins, const Obstacle<dim> &obstacle,
                    const std::function<bool(unsigned int)> &is_allowed_body)
{
  std::vector<bool> is_coming(surface.facets.size(), false);
  std::vector<typename Obstacle<dim>::Foot> feet;
  for (unsigned int f = 0; f < surface.facets.size(); ++f)
  {
    const Facet<dim> &facet = surface.facets[f];
    if (!facet.owned || !is_allowed_body(facet.body))
      continue;
    obstacle.find_feet(make_lattice(facet, motion.positions, margins[f]), feet);
    const double reach =
        margins[f] + motion.duration * motion.largest_speed(facet, SpatialVector<dim>::Zero());
    is_coming[f] =
        std::any_of(feet.begin(), feet.end(), [&](const auto &foot) { return foot.depth >= -reach; });
  }
  return indices_of(is_coming);
}

template struct StraightMotion<2>;
template struct StraightMotion<3>;
template std::vector<unsigned int>
find_coming_contact(const ContactSurface<2> &, const StraightMotion<2> &, const std::vector<double> &,
                    const std::vector<SpatialVector<2>> &,
                    const std::function<bool(unsigned int, unsigned int)> &);
template std::vector<unsigned int>
find_coming_contact(const ContactSurface<3> &, const StraightMotion<3> &, const std::vector<double> &,
                    const std::vector<SpatialVector<3>> &,
                    const std::function<bool(unsigned int, unsigned int)> &);
template std::vector<unsigned int> find_coming_contact(const ContactSurface<2> &, const StraightMotion<2> &,
                                                       const std::vector<double> &, const Obstacle<2> &,
                                                       const std::function<bool(unsigned int)> &);
template std::vector<unsigned int> find_coming_contact(const ContactSurface<3> &, const StraightMotion<3> &,
                                                       const std::vector<double> &, const Obstacle<3> &,
                                                       const std::function<bool(unsigned int)> &);
} // namespace signorini::contact
