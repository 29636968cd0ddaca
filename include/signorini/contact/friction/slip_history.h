// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/potential/pair_list.h"

#include <map>
#include <tuple>

namespace signorini::contact
{
/// The friction of a point at one moment.
template <int dim>
struct PointSlip
{
  SpatialVector<dim> elastic = SpatialVector<dim>::Zero(); ///< s, in the plane of the normal [m]
  SpatialVector<dim> normal = SpatialVector<dim>::Zero();  ///< of the target; zero without contact

  bool is_touching() const { return normal != SpatialVector<dim>::Zero(); }

  template <typename Archive>
  void serialize(Archive &archive, unsigned int /*version*/)
  {
    archive &elastic &normal;
  }
};

/// A point of a pair in the step under way.
template <int dim>
struct FrictionPoint
{
  PointSlip<dim> before;  ///< at the end of the last step
  PointSlip<dim> now;     ///< at the positions of the last evaluation
  double share = 1.;      ///< of the step, in which its slip counts
  double held_limit = 0.; ///< of the elastic slip, under the pressure that cones are held at [m]
  bool is_held = false;   ///< sticks whatever its limit, see Friction::hold()
  SpatialVector<dim> direction = SpatialVector<dim>::Zero(); ///< of sliding at the last hold(); zero: none
  SpatialVector<dim> slid = SpatialVector<dim>::Zero();      ///< from one to the other [m]
  SpatialVector<dim> traction = SpatialVector<dim>::Zero();  ///< that it slid under [Pa]

  template <typename Archive>
  void serialize(Archive &archive, unsigned int /*version*/)
  {
    archive &before &now &share &held_limit &is_held &direction &slid &traction;
  }
};

/// The friction of a point that is told by its place, so that points of another mesh can take it over.
template <int dim>
struct PlacedSlip
{
  /// What touches what: index of the body, index of the target, whether that is an obstacle.
  using Partners = std::tuple<unsigned int, unsigned int, bool>;

  Partners partners;
  SpatialVector<dim> position; ///< [m]
  PointSlip<dim> slip;
};

/// The points of all pairs of a pair list, and their memory: it stays with a point, whichever facet of its
/// target it faces and however often pairs are made anew, as long as it touches.
template <int dim>
class SlipHistory
{
public:
  using Pairs = typename PairList<dim>::Pairs;
  using Points = std::vector<FrictionPoint<dim>>;

  /// Brings the points into the order of the pairs. Does nothing unless these have been renewed.
  void follow(const PairList<dim> &pairs);

  /// Forgets the points that have no pair any more: until a step is accepted its attempts may lose pairs that
  /// the next one has again.
  void forget_parted();

  Points bodies;    ///< one a body pair
  Points obstacles; ///< one an obstacle pair

  template <typename Archive>
  void serialize(Archive &archive, unsigned int /*version*/)
  {
    archive &bodies &obstacles &body_keys &obstacle_keys &parted_bodies &parted_obstacles &n_renewals;
  }

private:
  using Keys = std::vector<PairKey<dim>>;
  using PointsByKey = std::map<PairKey<dim>, FrictionPoint<dim>>;

  static void reorder(const Pairs &pairs, Keys &keys, Points &points, PointsByKey &parted);

  Keys body_keys, obstacle_keys; ///< of the points, in their order
  PointsByKey parted_bodies,
      parted_obstacles; ///< that touched at the last accepted step and have no pair now
  unsigned int n_renewals = 0;
};
} // namespace signorini::contact
