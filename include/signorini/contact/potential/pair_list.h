// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/geometry/segments.h"
#include "signorini/contact/potential/contact_pair.h"
#include "signorini/contact/potential/potential_settings.h"
#include "signorini/contact/search/neighbour_list.h"
#include "signorini/scene/obstacle.h"

#include <memory>
#include <optional>
#include <vector>

namespace signorini::contact
{
/// All pairs that may be in contact until some node or some obstacle has moved by half the skin.
///
/// A point sees another body's surface as deep as its own facet's layer thickness, and any depth of an
/// obstacle. Pairs too far from their target to touch it before the next renewal are left out.
template <int dim>
class PairList
{
public:
  using Positions = std::vector<SpatialVector<dim>>;
  using Obstacles = std::vector<std::shared_ptr<const Obstacle<dim>>>;
  using Pairs = std::vector<ContactPair<dim>>;
  using Feet = std::vector<SurfaceFoot<dim>>;

  /// `contact_surface` must outlive this object. Throws std::invalid_argument for settings or facets without
  /// sense.
  /// The surface's own facets must stay.
  PairList(const ContactSurface<dim> &contact_surface, Obstacles rigid_obstacles,
           PotentialSettings potential_settings);

  bool is_stale(const Positions &positions) const;

  /// Puts each obstacle at this shift from the place it was given at [m].
  void move_obstacles(const Positions &shifts);

  unsigned int n_searches() const { return neighbour_list.n_rebuilds(); }
  const std::vector<FacetNeighbours> &neighbours() const { return neighbour_list.neighbours(); }

  /// Searches neighbours anew; renew() must follow.
  void search(const Positions &positions);

  /// Makes all pairs anew. Returns the feet of those of bodies, one a pair.
  Feet renew(const Positions &positions);

  /// Of the nodes at the last search; empty before the first.
  const Positions &positions_at_search() const { return neighbour_list.positions_at_search(); }

  /// How often pairs were made: between two renewals each keeps its place in its list.
  unsigned int n_renewals() const { return n_renewals_; }

  const Pairs &body_pairs() const { return body_pairs_; }

  /// In the order of the obstacles.
  const Pairs &obstacle_pairs() const { return obstacle_pairs_; }

  /// Where they are now.
  const Obstacles &obstacles() const { return obstacles_; }
  const PotentialSettings &settings() const { return settings_; }
  double skin() const { return skin_; } ///< [m]

  /// By how much a point of a facet may move at most where no node moves by more than one.
  double largest_motion_factor() const { return largest_motion_factor_; }

  /// Of all pairs of bodies [m].
  double largest_offset() const;

  /// Of all pairs [Pa/m].
  double largest_stiffness() const { return largest_stiffness_; }

  /// Changes α, and with it k_A and the damping of all pairs.
  void set_penalty_factor(double penalty_factor);

  /// Pressures λ ≥ 0 that the points of each facet start from, [facet][node of the facet] [Pa], also for
  /// pairs still to be made. Empty: none.
  void set_multipliers(NodalPressures<dim> new_multipliers);

  /// How deep a point of that owned facet sees another body [m].
  double reach(unsigned int facet) const { return reach_[facet]; }

  /// How far from its box an owned facet's neighbours are looked for [m].
  double search_distance(unsigned int facet) const { return neighbour_list.search_distance(facet); }

  using IsAllowedPair = typename NeighbourList<dim>::IsAllowedPair;

  /// Which bodies may touch each other, or themselves.
  IsAllowedPair allowed_pairs() const;

  /// Whether there are any.
  bool may_bodies_touch() const;

  bool is_excluded_obstacle(unsigned int body, unsigned int obstacle) const;

  /// All that the list remembers but multipliers, for boost's archives.
  template <typename Archive>
  void serialize(Archive &archive, unsigned int /*version*/)
  {
    Positions shifts = shifts_of_obstacles;
    archive &settings_.penalty_factor &shifts &shifts_at_search &neighbour_list;
    archive &body_pairs_ &obstacle_pairs_ &n_renewals_ &largest_stiffness_;
    if (Archive::is_loading::value)
      move_obstacles(shifts);
  }

private:
  struct FacetPoint
  {
    FacetQuadraturePoint<dim> point;
    std::array<double, Facet<dim>::max_n_nodes> shape;
  };
  using FacetPoints = std::vector<FacetPoint>;

  static unsigned int index(const FacetElement<dim> &element)
  {
    return element.degree - 1 + (element.type == FacetType::triangle ? 2 : 0);
  }

  void check_input() const;
  double compute_skin() const;
  std::vector<double> compute_reach() const;
  /// Gives pairs that were there before the stiffness and damping they had: a point in contact keeps its law,
  /// whichever facet it has come nearest to, so that renewal brings no energy.
  void keep_coefficients(const Pairs &old_pairs);

  /// What the points of an entry of the neighbour list are made with, and the feet of those that were.
  struct Making
  {
    unsigned int neighbours;
    const Positions &positions;
    FootSearch<dim> search;
    Feet &feet;
  };

  void add_body_pairs(unsigned int neighbours, const Positions &positions, Feet &feet);
  void add_segment_pairs(unsigned int candidate, Making &making);

  /// `facing`: the target facet that a segment's point was made for.
  void add_body_pair(const FacetPoint &point, std::optional<unsigned int> facing, Making &making);
  void add_obstacle_pairs(unsigned int obstacle, const Positions &positions);

  /// Area, stiffness and damping; `target` is null for an obstacle.
  void set_coefficients(ContactPair<dim> &pair, const FacetPoint &point, const Facet<dim> *target) const;
  void set_offset(ContactPair<dim> &pair) const;

  const ContactSurface<dim> &surface;
  const Obstacles given_obstacles;
  Obstacles obstacles_;
  Positions shifts_of_obstacles, shifts_at_search; ///< one an obstacle
  PotentialSettings settings_;
  double skin_;
  std::vector<double> reach_;
  double largest_motion_factor_ = 1.;
  std::array<FacetPoints, 4> gauss_points; ///< of the kinds of facet that there are, at their index()
  NeighbourList<dim> neighbour_list;

  NodalPressures<dim> multipliers;
  Pairs body_pairs_;
  Pairs obstacle_pairs_;
  unsigned int n_renewals_ = 0;
  double largest_stiffness_ = 0.;
};

/// x(ξ) = Σ_a shape_a x_a on a facet.
template <int dim>
inline SpatialVector<dim> interpolate(const Facet<dim> &facet,
                                      const std::array<double, Facet<dim>::max_n_nodes> &shape,
                                      const std::vector<SpatialVector<dim>> &nodal_values)
{
  SpatialVector<dim> value = SpatialVector<dim>::Zero();
  const unsigned int n_nodes = facet.n_nodes();
  for (unsigned int a = 0; a < n_nodes; ++a)
    value += shape[a] * nodal_values[facet.nodes[a]];
  return value;
}
} // namespace signorini::contact
