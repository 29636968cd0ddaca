// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/search/neighbour_list.h"

#include "signorini/contact/geometry/facet_shape.h"
#include "signorini/contact/search/box_tree.h"
#include "signorini/contact/search/untouchable_facets.h"

#include <boost/iterator/function_output_iterator.hpp>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

namespace signorini::contact
{
namespace
{
/// Appends, in rising order, the indices of the boxes of `tree` no farther than `distance` from `box`.
template <int dim>
void append_near_boxes(const BoxTree<dim> &tree, const std::vector<BoundingBox<dim>> &boxes,
                       const BoundingBox<dim> &box, double distance, std::vector<unsigned int> &near)
{
  const auto first_new = static_cast<std::ptrdiff_t>(near.size());
  const auto append = boost::make_function_output_iterator(
      [&](const TreeEntry<dim> &entry)
      {
        if (boxes[entry.second].squaredExteriorDistance(box) <= distance * distance)
          near.push_back(entry.second);
      });
  tree.query(boost::geometry::index::intersects(make_tree_box<dim>(box, distance)), append);
  std::sort(near.begin() + first_new, near.end());
}
} // namespace

/// The boxes of one configuration. A body's tree over its facets is grown only when something comes near.
template <int dim>
struct NeighbourList<dim>::Boxes
{
  std::vector<BoundingBox<dim>> facets;
  std::vector<BoundingBox<dim>> bodies;
  BoxTree<dim> body_tree;
  std::vector<std::optional<BoxTree<dim>>> facet_trees;

  Boxes(const ContactSurface<dim> &surface, const Positions &positions)
      : bodies(surface.n_bodies), facet_trees(surface.n_bodies)
  {
    facets.reserve(surface.facets.size());
    for (const Facet<dim> &facet : surface.facets)
    {
      facets.push_back(make_facet_box(facet, positions));
      bodies[facet.body].extend(facets.back());
    }
    std::vector<unsigned int> all_bodies(surface.n_bodies);
    for (unsigned int body = 0; body < surface.n_bodies; ++body)
      all_bodies[body] = body;
    body_tree = make_tree<dim>(bodies, all_bodies);
  }
};

template <int dim>
NeighbourList<dim>::NeighbourList(const ContactSurface<dim> &contact_surface, std::vector<double> facet_reach,
                                  double skin_thickness, IsAllowedPair is_allowed_pair)
    : surface(contact_surface), reach(std::move(facet_reach)), skin(skin_thickness), record(skin),
      is_allowed(std::move(is_allowed_pair)), facets_of_body(contact_surface.n_bodies)
{
  if (reach.size() != surface.facets.size())
    throw std::invalid_argument("A neighbour list needs one reach a facet.");
  if (!(skin > 0.))
    throw std::invalid_argument("The skin of a neighbour list must be positive.");
  for (const Facet<dim> &facet : surface.facets)
    largest_motion_factor = std::max(largest_motion_factor, lebesgue_constant(facet));
  for (const FacetElement<dim> &element : surface.elsewhere.elements)
    largest_motion_factor = std::max(largest_motion_factor, lebesgue_constant(element));
}

template <int dim>
void NeighbourList<dim>::sort_facets()
{
  const bool is_first = untouchable.empty();
  for (std::vector<unsigned int> &facets : facets_of_body)
    facets.clear();
  for (unsigned int f = 0; f < surface.facets.size(); ++f)
    facets_of_body.at(surface.facets[f].body).push_back(f);
  if (!is_allowed || (!is_first && std::all_of(surface.facets.begin(), surface.facets.end(),
                                               [](const Facet<dim> &facet) { return facet.owned; })))
    return;
  // A wall must be squashed to less than half of its thickness before a point of one side sees the other.
  std::vector<double> distances;
  for (const double distance : reach)
    distances.push_back(2. * distance + skin);
  untouchable = find_untouchable_facets<dim>(surface, distances,
                                             [this](unsigned int body) { return is_allowed(body, body); });
}

template <int dim>
void NeighbourList<dim>::rebuild(const Positions &positions)
{
  find_neighbours(positions);
  record.note_search(positions);
}

template <int dim>
void NeighbourList<dim>::find_neighbours(const Positions &positions)
{
  neighbours_.clear();
  if (!is_allowed)
    return;
  sort_facets();
  Boxes boxes(surface, positions);
  for (unsigned int body = 0; body < surface.n_bodies; ++body)
    add_neighbours_of_body(body, boxes);
}

template <int dim>
double NeighbourList<dim>::search_distance(unsigned int facet) const
{
  return reach[facet] + largest_motion_factor * skin;
}

template <int dim>
std::vector<unsigned int> NeighbourList<dim>::find_near_bodies(unsigned int body, const Boxes &boxes) const
{
  double distance = 0.;
  bool owns_any = false;
  for (const unsigned int f : facets_of_body[body])
    if (surface.facets[f].owned)
    {
      distance = std::max(distance, search_distance(f));
      owns_any = true;
    }

  std::vector<unsigned int> near;
  if (owns_any)
    append_near_boxes<dim>(boxes.body_tree, boxes.bodies, boxes.bodies[body], distance, near);
  near.erase(
      std::remove_if(near.begin(), near.end(), [&](unsigned int other) { return !is_allowed(body, other); }),
      near.end());
  return near;
}

template <int dim>
void NeighbourList<dim>::add_neighbours_of_body(unsigned int body, Boxes &boxes)
{
  const std::vector<unsigned int> targets = find_near_bodies(body, boxes);
  if (targets.empty())
    return;
  for (const unsigned int f : facets_of_body[body])
    if (surface.facets[f].owned)
      for (const unsigned int target : targets)
        add_neighbours_of_facet(f, target, boxes);
}

template <int dim>
void NeighbourList<dim>::add_neighbours_of_facet(unsigned int facet, unsigned int target_body, Boxes &boxes)
{
  const double distance = search_distance(facet);
  if (boxes.bodies[target_body].squaredExteriorDistance(boxes.facets[facet]) > distance * distance)
    return;

  std::optional<BoxTree<dim>> &tree = boxes.facet_trees[target_body];
  if (!tree)
    tree = make_tree<dim>(boxes.facets, facets_of_body[target_body]);
  FacetNeighbours found{facet, target_body, {}};
  append_near_boxes<dim>(*tree, boxes.facets, boxes.facets[facet], distance, found.candidates);
  if (surface.facets[facet].body == target_body)
    found.candidates.erase(std::remove_if(found.candidates.begin(), found.candidates.end(),
                                          [&](unsigned int candidate) {
                                            return std::binary_search(untouchable[facet].begin(),
                                                                      untouchable[facet].end(), candidate);
                                          }),
                           found.candidates.end());
  // Of facets that are equally near the first one counts.
  std::stable_sort(found.candidates.begin(), found.candidates.end(),
                   [this](unsigned int one, unsigned int other)
                   { return surface.facets[one].number < surface.facets[other].number; });
  if (!found.candidates.empty())
    neighbours_.push_back(std::move(found));
}

template class NeighbourList<2>;
template class NeighbourList<3>;
} // namespace signorini::contact
