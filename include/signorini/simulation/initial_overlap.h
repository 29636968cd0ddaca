// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/search/interior_search.h"
#include "signorini/discretization/surface_map.h"

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace signorini
{
/// A point of a body in something else.
template <int dim>
struct InitialOverlap
{
  unsigned int body = 0;
  unsigned int other = 0; ///< index of a body; of an obstacle, counted on after the bodies
  double depth = 0.;      ///< of the point, below the surface of the other [m]
  double thickness = 0.;  ///< of the element below that surface; obstacles: of that below the body's [m]
  SpatialVector<dim> point = SpatialVector<dim>::Zero();

  bool is_of_itself() const { return body == other; }
};

/// Looks for bodies in other bodies at any depth, where contact sees only as deep as one element. Collective.
template <int dim>
class OverlapSearch
{
public:
  /// All must outlive this object.
  OverlapSearch(const Parameters &parameters, const Scene<dim> &scene,
                const Discretization<dim> &discretization, const SurfaceMap<dim> &surface_map,
                const Vector &displacement);

  /// A node, a centre of a cell or a point of the surface that lies deeper in another body than `allowed`
  /// elements, or the point of an obstacle in a body; on every rank the same.
  std::optional<InitialOverlap<dim>> find_gross(double allowed) const;

  /// What other body or obstacle a point of a body, the same on every rank, lies deepest in; if in none, the
  /// body itself, with depth 0.
  InitialOverlap<dim> find_at(unsigned int body, const SpatialVector<dim> &point) const;

  /// body 'NAME' or obstacle 'NAME'.
  std::string name(unsigned int body_or_obstacle) const;

  /// Shortest of some shifts of the overlap's body after which a plane lies between the two.
  SpatialVector<dim> find_shift(const InitialOverlap<dim> &overlap) const;

private:
  /// The surfaces of some bodies, whole.
  struct WholeBodies
  {
    SurfaceMap<dim> map;
    std::vector<SpatialVector<dim>> positions; ///< of its nodes, from the origin of the coordinates [m]
    contact::InteriorSearch<dim> interiors;

    WholeBodies(const OverlapSearch &search, const std::set<unsigned int> &bodies);
  };

  /// Lets `map` hold these bodies, whole; returns the positions of its nodes (collective).
  std::vector<SpatialVector<dim>> hold(const std::set<unsigned int> &bodies, SurfaceMap<dim> &map) const;
  /// The bodies but one whose boxes overlap this one.
  std::set<unsigned int> find_bodies(unsigned int body, const contact::BoundingBox<dim> &box) const;
  /// The bodies that points of this rank may lie in.
  std::set<unsigned int> find_bodies_around() const;

  /// All points of this rank that are looked at, with their bodies.
  void for_each_point(const std::function<void(unsigned int, const SpatialVector<dim> &)> &visit) const;
  std::optional<InitialOverlap<dim>> find_on_this_rank(double allowed) const;
  std::optional<InitialOverlap<dim>> find_in_bodies(const WholeBodies &bodies, unsigned int body,
                                                    const SpatialVector<dim> &point) const;
  /// On the first rank, which looks for all.
  std::optional<InitialOverlap<dim>> find_swallowed_obstacle() const;
  double reach(unsigned int body_or_obstacle, const SpatialVector<dim> &direction) const;
  bool is_excluded(unsigned int body, unsigned int body_or_obstacle) const;

  const Parameters &parameters;
  const Scene<dim> &scene;
  const Discretization<dim> &discretization;
  const SurfaceMap<dim> &surface_map;
  const Vector &displacement;
  std::vector<SpatialVector<dim>> positions; ///< of the own nodes, from the origin of the coordinates [m]
  std::vector<contact::BoundingBox<dim>> body_boxes; ///< whole ones
};
} // namespace signorini
