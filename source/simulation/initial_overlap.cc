// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/simulation/initial_overlap.h"

#include "signorini/base/to_eigen.h"
#include "signorini/contact/coupling/facet_exchange.h"
#include "signorini/contact/geometry/facet_shape.h"
#include "signorini/parameters/contact_parameters.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

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

/// The boxes of the bodies of all ranks.
template <int dim>
std::vector<contact::BoundingBox<dim>> gather_body_boxes(const SurfaceMap<dim> &surface_map,
                                                         const std::vector<SpatialVector<dim>> &positions,
                                                         const MPI_Comm &communicator)
{
  const ContactSurface<dim> &surface = surface_map.surface();
  std::vector<contact::BoundingBox<dim>> boxes(surface.n_bodies);
  for (const Facet<dim> &facet : surface.facets)
    boxes[facet.body].extend(contact::make_facet_box(facet, positions));
  std::vector<SpatialVector<dim>> low, high;
  for (const contact::BoundingBox<dim> &box : boxes)
  {
    low.push_back(box.min());
    high.push_back(box.max());
  }
  const auto n = static_cast<int>(dim * boxes.size());
  MPI_Allreduce(MPI_IN_PLACE, low.data(), n, MPI_DOUBLE, MPI_MIN, communicator);
  MPI_Allreduce(MPI_IN_PLACE, high.data(), n, MPI_DOUBLE, MPI_MAX, communicator);
  for (unsigned int body = 0; body < boxes.size(); ++body)
    boxes[body] = {low[body], high[body]};
  return boxes;
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
                                  const SurfaceMap<dim> &the_surface_map, const Vector &the_displacement)
    : parameters(the_parameters), scene(the_scene), discretization(the_discretization),
      surface_map(the_surface_map), displacement(the_displacement),
      positions(current_positions(the_surface_map, the_displacement)),
      body_boxes(gather_body_boxes(the_surface_map, positions, the_discretization.communicator()))
{
}

template <int dim>
OverlapSearch<dim>::WholeBodies::WholeBodies(const OverlapSearch &search,
                                             const std::set<unsigned int> &bodies)
    : map(search.surface_map), positions(search.hold(bodies, map)), interiors(map.surface(), positions)
{
}

template <int dim>
std::vector<SpatialVector<dim>> OverlapSearch<dim>::hold(const std::set<unsigned int> &bodies,
                                                         SurfaceMap<dim> &map) const
{
  std::vector<contact::FacetQuery<dim>> queries;
  for (const unsigned int body : bodies)
    queries.push_back({body_boxes[body], body});
  hold_facets<dim>(
      queries, make_own_boxes(map, positions),
      [](unsigned int wanted, unsigned int body) { return wanted == body; }, discretization.communicator(),
      map);
  return current_positions(map, displacement);
}

template <int dim>
std::set<unsigned int> OverlapSearch<dim>::find_bodies(unsigned int body,
                                                       const contact::BoundingBox<dim> &box) const
{
  std::set<unsigned int> found;
  for (unsigned int other = 0; other < scene.n_bodies(); ++other)
    if (other != body && !body_boxes[other].isEmpty() && body_boxes[other].intersects(box))
      found.insert(other);
  return found;
}

template <int dim>
std::set<unsigned int> OverlapSearch<dim>::find_bodies_around() const
{
  std::map<unsigned int, contact::BoundingBox<dim>> own_points;
  for_each_point([&own_points](unsigned int body, const SpatialVector<dim> &x)
                 { own_points[body].extend(x); });
  std::set<unsigned int> bodies;
  for (const auto &[body, box] : own_points)
    bodies.merge(find_bodies(body, box));
  return bodies;
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
std::optional<InitialOverlap<dim>> OverlapSearch<dim>::find_in_bodies(const WholeBodies &bodies,
                                                                      unsigned int body,
                                                                      const SpatialVector<dim> &point) const
{
  const auto found = bodies.interiors.find_deepest(point, [&](unsigned int other)
                                                   { return other != body && !is_excluded(body, other); });
  if (!found)
    return {};
  return InitialOverlap<dim>{body, found->body, found->depth,
                             bodies.map.surface().facets[found->facet].layer_thickness, point};
}

template <int dim>
InitialOverlap<dim> OverlapSearch<dim>::find_at(unsigned int body, const SpatialVector<dim> &point) const
{
  const bool is_first = dealii::Utilities::MPI::this_mpi_process(discretization.communicator()) == 0;
  // The first rank looks for all.
  const WholeBodies bodies(*this, is_first ? find_bodies(body, contact::BoundingBox<dim>(point))
                                           : std::set<unsigned int>());
  std::optional<InitialOverlap<dim>> deepest = choose_deepest(
      is_first ? find_in_bodies(bodies, body, point) : std::nullopt, discretization.communicator());
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
  for (const Facet<dim> &facet : surface_map.surface().facets)
    // What lies across a long element may hold none of its nodes.
    for (const SpatialVector<dim> &x : contact::make_lattice(facet, positions, 0.5 * facet.layer_thickness))
      visit(facet.body, x);
}

template <int dim>
std::optional<InitialOverlap<dim>> OverlapSearch<dim>::find_on_this_rank(double allowed) const
{
  // A scene this wrong needs no exhaustive search: the deepest of so many points tells enough.
  constexpr unsigned int enough = 1000;
  const WholeBodies bodies(*this, find_bodies_around());
  unsigned int n_found = 0;
  std::optional<InitialOverlap<dim>> deepest;
  const auto look_at = [&](unsigned int body, const SpatialVector<dim> &point)
  {
    if (n_found >= enough)
      return;
    const auto overlap = find_in_bodies(bodies, body, point);
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
  const bool is_first = dealii::Utilities::MPI::this_mpi_process(discretization.communicator()) == 0;
  std::set<unsigned int> around;
  for (const ObstacleParameters &obstacle : parameters.obstacles)
    around.merge(
        find_bodies(scene.n_bodies(), contact::BoundingBox<dim>(to_spatial_vector<dim>(obstacle.point))));
  const WholeBodies bodies(*this, is_first ? around : std::set<unsigned int>());
  for (unsigned int i = 0; i < scene.obstacles.size() && is_first; ++i)
  {
    const auto point = to_spatial_vector<dim>(parameters.obstacles[i].point);
    const double depth = scene.obstacles[i]->find_foot(point).depth;
    if (depth <= 0.)
      continue;
    const auto found = bodies.interiors.find_deepest(point, [&](unsigned int body)
                                                     { return !is_excluded(body, scene.n_bodies() + i); });
    if (found)
      return InitialOverlap<dim>{found->body, scene.n_bodies() + i, found->depth + depth,
                                 bodies.map.surface().facets[found->facet].layer_thickness, point};
  }
  return {};
}

template <int dim>
std::optional<InitialOverlap<dim>> OverlapSearch<dim>::find_gross(double allowed) const
{
  const auto overlap = choose_deepest(find_on_this_rank(allowed), discretization.communicator());
  return overlap ? overlap : choose_deepest(find_swallowed_obstacle(), discretization.communicator());
}

/// The largest coordinate along a direction.
template <int dim>
double OverlapSearch<dim>::reach(unsigned int body_or_obstacle, const SpatialVector<dim> &direction) const
{
  if (body_or_obstacle >= scene.n_bodies())
    return scene.obstacles[body_or_obstacle - scene.n_bodies()]->reach(direction);
  double largest = -std::numeric_limits<double>::max();
  for (const Facet<dim> &facet : surface_map.surface().facets)
    if (facet.body == body_or_obstacle)
      for (unsigned int i = 0; i < facet.n_nodes(); ++i)
        largest = std::max(largest, direction.dot(positions[facet.nodes[i]]));
  return dealii::Utilities::MPI::max(largest, discretization.communicator());
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
