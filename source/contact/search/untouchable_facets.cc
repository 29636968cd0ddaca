// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/search/untouchable_facets.h"

#include "signorini/contact/geometry/closest_point.h"
#include "signorini/contact/search/box_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace signorini::contact
{
namespace
{
template <int dim>
class UndeformedSurface
{
public:
  UndeformedSurface(const ContactSurface<dim> &contact_surface, const std::vector<double> &all_distances)
      : surface(contact_surface), distances(all_distances)
  {
    for (const Facet<dim> &facet : surface.facets)
    {
      nodes.push_back(gather_nodes(facet, surface.reference_positions));
      boxes.push_back(make_facet_box(facet, surface.reference_positions));
      const LocalPoint<dim> middle =
          LocalPoint<dim>::Constant(facet.type == FacetType::triangle ? 1. / 3. : .5);
      const FacetFrame<dim> frame = evaluate_facet_frame(nodes.back(), middle);
      const double area = frame.area_normal.norm();
      centres.push_back({frame.position, frame.area_normal / area,
                         std::min(facet.layer_thickness, std::pow(area, 1. / (dim - 1)))});
    }
  }

  /// Facets out of `tree` that `facet` never touches.
  std::vector<unsigned int> find_untouchable(unsigned int facet, const BoxTree<dim> &tree) const
  {
    std::vector<TreeEntry<dim>> near;
    tree.query(boost::geometry::index::intersects(make_tree_box<dim>(boxes[facet], distances[facet])),
               std::back_inserter(near));
    std::vector<unsigned int> untouchable;
    for (const TreeEntry<dim> &entry : near)
      if (!is_any_above(facet, entry.second) &&
          (share_a_node(surface.facets[facet], surface.facets[entry.second]) ||
           (!are_sides_of_slit(facet, entry.second) && are_near(facet, entry.second))))
        untouchable.push_back(entry.second);
    std::sort(untouchable.begin(), untouchable.end());
    return untouchable;
  }

  BoxTree<dim> make_tree_of(const std::vector<unsigned int> &facets) const
  {
    return make_tree<dim>(boxes, facets);
  }

private:
  struct Centre
  {
    SpatialVector<dim> position, normal;
    double size; ///< of the facet or of the element behind it, whichever is less [m]
  };

  double margin(unsigned int one, unsigned int other) const
  {
    // Flat facets of the two sides of a closed, curved gap may lie in each other by so much of their size.
    // A wall is thicker than that.
    constexpr double closed = .05;
    return closed * std::min(centres[one].size, centres[other].size);
  }

  double cosine(unsigned int one, unsigned int other) const
  {
    return centres[one].normal.dot(centres[other].normal);
  }

  /// Whether `one` lies above `other`, or that above it.
  bool is_any_above(unsigned int one, unsigned int other) const
  {
    const double sign = cosine(one, other) > std::sqrt(.5) ? 1. : -1.;
    return height(one, other) > sign * margin(one, other) || height(other, one) > margin(one, other);
  }

  /// Of two sides of a bent slit the convex one curves away below the plane of the other.
  bool are_sides_of_slit(unsigned int one, unsigned int other) const
  {
    const Centre &a = centres[one], &b = centres[other];
    return cosine(one, other) < -std::sqrt(.5) &&
           (b.position - a.position).dot((a.normal - b.normal).normalized()) > -margin(one, other);
  }

  /// Of the lowest node of `one` above the plane of `other`.
  double height(unsigned int one, unsigned int other) const
  {
    const Centre &plane = centres[other];
    double lowest = std::numeric_limits<double>::max();
    for (unsigned int a = 0; a < nodes[one].n_nodes(); ++a)
      lowest = std::min(lowest, (nodes[one].position[a] - plane.position).dot(plane.normal));
    return lowest;
  }

  bool are_near(unsigned int one, unsigned int other) const
  {
    const double limit = distances[one];
    return (centres[one].position - centres[other].position).norm() <= limit ||
           is_any_node_near(nodes[one], nodes[other], limit) ||
           is_any_node_near(nodes[other], nodes[one], limit);
  }

  static bool is_any_node_near(const FacetNodes<dim> &one, const FacetNodes<dim> &other, double limit)
  {
    return std::any_of(one.position.begin(), one.position.begin() + one.n_nodes(),
                       [&](const SpatialVector<dim> &x)
                       { return find_closest_point(other, x).distance <= limit; });
  }

  const ContactSurface<dim> &surface;
  const std::vector<double> &distances;
  std::vector<FacetNodes<dim>> nodes;
  std::vector<BoundingBox<dim>> boxes;
  std::vector<Centre> centres;
};
} // namespace

template <int dim>
bool share_a_node(const Facet<dim> &one, const Facet<dim> &other)
{
  const auto end = one.nodes.begin() + one.n_nodes();
  return std::find_first_of(one.nodes.begin(), end, other.nodes.begin(),
                            other.nodes.begin() + other.n_nodes()) != end;
}

template <int dim>
std::vector<std::vector<unsigned int>>
find_untouchable_facets(const ContactSurface<dim> &surface, const std::vector<double> &distances,
                        const std::function<bool(unsigned int)> &is_considered)
{
  std::vector<std::vector<unsigned int>> facets_of_body(surface.n_bodies);
  for (unsigned int f = 0; f < surface.facets.size(); ++f)
    if (is_considered(surface.facets[f].body))
      facets_of_body[surface.facets[f].body].push_back(f);
  std::vector<std::vector<unsigned int>> untouchable(surface.facets.size());
  if (std::all_of(facets_of_body.begin(), facets_of_body.end(),
                  [](const auto &list) { return list.empty(); }))
    return untouchable;
  const UndeformedSurface<dim> undeformed(surface, distances);
  for (const std::vector<unsigned int> &facets : facets_of_body)
  {
    const BoxTree<dim> tree = undeformed.make_tree_of(facets);
    for (const unsigned int f : facets)
      if (surface.facets[f].owned)
        untouchable[f] = undeformed.find_untouchable(f, tree);
  }
  return untouchable;
}

template bool share_a_node(const Facet<2> &, const Facet<2> &);
template bool share_a_node(const Facet<3> &, const Facet<3> &);
template std::vector<std::vector<unsigned int>>
find_untouchable_facets(const ContactSurface<2> &, const std::vector<double> &,
                        const std::function<bool(unsigned int)> &);
template std::vector<std::vector<unsigned int>>
find_untouchable_facets(const ContactSurface<3> &, const std::vector<double> &,
                        const std::function<bool(unsigned int)> &);
} // namespace signorini::contact
