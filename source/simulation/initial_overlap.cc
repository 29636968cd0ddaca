// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/simulation/initial_overlap.h"

#include "signorini/base/to_eigen.h"
#include "signorini/contact/geometry/facet_shape.h"
#include "signorini/parameters/contact_parameters.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace signorini
{
namespace
{
template <int dim>
std::vector<SpatialVector<dim>> current_positions(const SurfaceMap<dim> &surface_map,
                                                  const Vector &displacement)
{
  std::vector<SpatialVector<dim>> positions = surface_map.positions(displacement);
  for (SpatialVector<dim> &x : positions)
    x += surface_map.surface().origin;
  return positions;
}

/// Whether a point lies deeper than another, beyond round-off, which must not choose among equals.
bool is_deeper(double depth, double other_depth)
{
  return depth > (1. + 1e-9) * other_depth;
}

/// Of overlaps found on several ranks the deepest one.
template <int dim>
std::optional<InitialOverlap<dim>> choose_deepest(const std::optional<InitialOverlap<dim>> &own,
                                                  const MPI_Comm &communicator)
{
  std::vector<double> packed;
  if (own)
  {
    packed = {static_cast<double>(own->body), static_cast<double>(own->other), own->depth, own->thickness};
    packed.insert(packed.end(), own->point.begin(), own->point.end());
  }
  std::optional<InitialOverlap<dim>> deepest;
  for (const std::vector<double> &of_rank : dealii::Utilities::MPI::all_gather(communicator, packed))
    if (!of_rank.empty() && (!deepest || is_deeper(of_rank[2], deepest->depth)))
      deepest = {static_cast<unsigned int>(of_rank[0]), static_cast<unsigned int>(of_rank[1]), of_rank[2],
                 of_rank[3], SpatialVector<dim>(&of_rank[4])};
  return deepest;
}
} // namespace

template <int dim>
OverlapSearch<dim>::OverlapSearch(const Parameters &the_parameters, const Scene<dim> &the_scene,
                                  const Discretization<dim> &the_discretization,
                                  const SurfaceMap<dim> &surface_map, const Vector &the_displacement)
    : parameters(the_parameters), scene(the_scene), discretization(the_discretization),
      surface(surface_map.surface()), displacement(the_displacement),
      positions(current_positions(surface_map, the_displacement)), interiors(surface, positions)
{
}

template <int dim>
std::string OverlapSearch<dim>::name(unsigned int body_or_obstacle) const
{
  return body_or_obstacle < scene.n_bodies()
             ? "body '" + scene.body_names[body_or_obstacle] + "'"
             : "obstacle '" + parameters.obstacles[body_or_obstacle - scene.n_bodies()].name + "'";
}

template <int dim>
bool OverlapSearch<dim>::is_excluded(unsigned int body, unsigned int body_or_obstacle) const
{
  const std::string &other = body_or_obstacle < scene.n_bodies()
                                 ? scene.body_names[body_or_obstacle]
                                 : parameters.obstacles[body_or_obstacle - scene.n_bodies()].name;
  return is_pair_excluded(*parameters.contact, scene.body_names[body], other);
}

template <int dim>
std::optional<InitialOverlap<dim>> OverlapSearch<dim>::find_in_bodies(unsigned int body,
                                                                      const SpatialVector<dim> &point) const
{
  const auto found = interiors.find_deepest(point, [&](unsigned int other)
                                            { return other != body && !is_excluded(body, other); });
  if (!found)
    return {};
  return InitialOverlap<dim>{body, found->body, found->depth, surface.facets[found->facet].layer_thickness,
                             point};
}

template <int dim>
InitialOverlap<dim> OverlapSearch<dim>::find_at(unsigned int body, const SpatialVector<dim> &point) const
{
  std::optional<InitialOverlap<dim>> deepest = find_in_bodies(body, point);
  for (unsigned int i = 0; i < scene.obstacles.size(); ++i)
    if (const double depth = scene.obstacles[i]->find_foot(point).depth;
        !is_excluded(body, scene.n_bodies() + i) && depth > (deepest ? deepest->depth : 0.))
      deepest = {body, scene.n_bodies() + i, depth, 0., point};
  return deepest.value_or(InitialOverlap<dim>{body, body, 0., 0., point});
}

template <int dim>
void OverlapSearch<dim>::for_each_point(
    const std::function<void(unsigned int, const SpatialVector<dim> &)> &visit) const
{
  for (const OwnedNode<dim> &node : discretization.owned_nodes)
  {
    SpatialVector<dim> x = to_eigen<dim>(node.position);
    for (unsigned int d = 0; d < dim; ++d)
      x[d] += displacement.local_element(node.dofs[d]);
    visit(node.body, x);
  }
  discretization.for_each_own_cell([&](const MeshPart<dim> &, const auto &cell, unsigned int)
                                   { visit(cell->material_id(), to_eigen<dim>(cell->center())); });
  for (const Facet<dim> &facet : surface.facets)
    if (facet.owned)
      // What lies across a long element may hold none of its nodes.
      for (const SpatialVector<dim> &x : contact::make_lattice(facet, positions, 0.5 * facet.layer_thickness))
        visit(facet.body, x);
}

template <int dim>
std::optional<InitialOverlap<dim>> OverlapSearch<dim>::find_on_this_rank(double allowed) const
{
  // A scene this wrong needs no exhaustive search: the deepest of so many points tells enough.
  constexpr unsigned int enough = 1000;
  unsigned int n_found = 0;
  std::optional<InitialOverlap<dim>> deepest;
  const auto look_at = [&](unsigned int body, const SpatialVector<dim> &point)
  {
    if (n_found >= enough)
      return;
    const auto overlap = find_in_bodies(body, point);
    if (!overlap || overlap->depth <= allowed * overlap->thickness)
      return;
    ++n_found;
    if (!deepest || is_deeper(overlap->depth, deepest->depth))
      deepest = overlap;
  };
  for_each_point(look_at);
  return deepest;
}

template <int dim>
std::optional<InitialOverlap<dim>> OverlapSearch<dim>::find_swallowed_obstacle() const
{
  for (unsigned int i = 0; i < scene.obstacles.size(); ++i)
  {
    const auto point = to_spatial_vector<dim>(parameters.obstacles[i].point);
    const double depth = scene.obstacles[i]->find_foot(point).depth;
    if (depth <= 0.)
      continue;
    const auto found = interiors.find_deepest(point, [&](unsigned int body)
                                              { return !is_excluded(body, scene.n_bodies() + i); });
    if (found)
      return InitialOverlap<dim>{found->body, scene.n_bodies() + i, found->depth + depth,
                                 surface.facets[found->facet].layer_thickness, point};
  }
  return {};
}

template <int dim>
std::optional<InitialOverlap<dim>> OverlapSearch<dim>::find_gross(double allowed) const
{
  const auto overlap = choose_deepest(find_on_this_rank(allowed), discretization.communicator());
  return overlap ? overlap : find_swallowed_obstacle();
}

/// The largest coordinate along a direction.
template <int dim>
double OverlapSearch<dim>::reach(unsigned int body_or_obstacle, const SpatialVector<dim> &direction) const
{
  if (body_or_obstacle >= scene.n_bodies())
    return scene.obstacles[body_or_obstacle - scene.n_bodies()]->reach(direction);
  double largest = -std::numeric_limits<double>::max();
  for (const Facet<dim> &facet : surface.facets)
    if (facet.body == body_or_obstacle)
      for (unsigned int i = 0; i < facet.n_nodes(); ++i)
        largest = std::max(largest, direction.dot(positions[facet.nodes[i]]));
  return largest;
}

template <int dim>
SpatialVector<dim> OverlapSearch<dim>::find_shift(const InitialOverlap<dim> &overlap) const
{
  std::vector<SpatialVector<dim>> directions;
  if (overlap.other >= scene.n_bodies())
    directions.push_back(scene.obstacles[overlap.other - scene.n_bodies()]->find_foot(overlap.point).normal);
  SpatialVector<dim> between;
  for (unsigned int d = 0; d < dim; ++d)
  {
    const SpatialVector<dim> axis = SpatialVector<dim>::Unit(d);
    directions.insert(directions.end(), {axis, -axis});
    between[d] = reach(overlap.body, axis) - reach(overlap.body, -axis) - reach(overlap.other, axis) +
                 reach(overlap.other, -axis);
  }
  // An obstacle without ends has no middle.
  if (const double distance = between.norm(); distance > 0. && std::isfinite(distance))
    directions.push_back(between / distance);
  SpatialVector<dim> shortest;
  double length = std::numeric_limits<double>::max();
  for (const SpatialVector<dim> &direction : directions)
    if (const double needed = reach(overlap.other, direction) + reach(overlap.body, -direction);
        needed < length)
    {
      length = needed;
      shortest = needed * direction;
    }
  return shortest;
}

template class OverlapSearch<2>;
template class OverlapSearch<3>;
} // namespace signorini
