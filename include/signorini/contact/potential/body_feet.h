// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/geometry/inner_feet.h"
#include "signorini/contact/potential/pair_list.h"

#include <limits>
#include <vector>

namespace signorini::contact
{
/// The feet of the points of a PairList on other bodies, kept from one set of positions to the next and only
/// found anew where they may matter.
///
/// A point that was found a distance g outside of its target is not within a distance g' before the nodes
/// have gone a way of g − g' between them: until then it sleeps. (Surfaces are closed: no point comes inside
/// but through them.) Where a foot lies inside the facet that it was on, and all others are farther away, it
/// is found on that facet alone, many at a time; everywhere else as FootSearch does. Both agree to round-off.
/// If others are farther away by c they need not be looked at before the nodes have gone a way of c/2.
template <int dim>
class BodyFeet
{
public:
  using Positions = std::vector<SpatialVector<dim>>;

  /// Wakes all points: their feet are not those of the positions.
  void forget(const PairList<dim> &pair_list);

  /// Takes pairs that were made anew, with their feet at the positions that there are.
  void restart(const PairList<dim> &pair_list, const std::vector<SurfaceFoot<dim>> &found);

  /// No point of a facet has moved by more than `distance` [m], as seen by an observer who moves as he likes.
  void note_motion(double distance);

  /// Offsets of pairs have changed.
  void note_offsets() { found_within = -1.; }

  /// Finds all feet of points at `positions` that are less than `gap` ≥ 0 outside of their targets, the
  /// offset of the pair subtracted [m]. Of the others depths may be of earlier positions, but never above
  /// −gap − offset. Depths below −skin are −∞.
  void find_within(double gap, const Positions &positions, const ContactSurface<dim> &contact_surface,
                   const PairList<dim> &pair_list);

  std::vector<PairFoot<dim>> &all() { return feet; } ///< one a pair
  const std::vector<PairFoot<dim>> &all() const { return feet; }

  /// Pairs that overlap, with their offset, after find_within().
  const std::vector<unsigned int> &touching() const { return touching_; }

  template <typename Archive>
  void serialize(Archive &archive, unsigned int /*version*/)
  {
    archive &feet &sleeps_until &alone_until &way &found_within &touching_;
    if (Archive::is_loading::value)
      all_near.clear();
  }

private:
  static constexpr unsigned int chunk_size = 64;

  /// Of the pairs of a chunk.
  using Selection = std::array<bool, chunk_size>;

  /// A box and for which positions it was made.
  struct DatedBox
  {
    SpatialVector<dim> low, high;
    unsigned int date = 0;
  };

  /// The feet of some pairs on the insides of the facets where they were last.
  struct Chunk
  {
    std::array<unsigned int, chunk_size> pair;
    Selection is_found;
    unsigned int n = 0;
  };

  /// Candidates of an entry of the neighbour list that may be as near as a distance to points of its facet.
  struct Near
  {
    double covers = -std::numeric_limits<double>::infinity(); ///< way and distance together [m]
    std::vector<unsigned int> candidates;
  };

  void find_awake(double gap);
  void find_chunk(const Positions &positions);
  /// Of the pairs in the chunk that are asked for, on the facets of their feet so far; returns which have
  /// one.
  Selection find_inner_feet_of_chunk(const Selection &is_asked, const Positions &positions);
  void put_into_batch(unsigned int pair, unsigned int i, const Positions &positions, InnerFeetBatch &batch);
  void take_from_batch(unsigned int i, const InnerFeetBatch &batch, PairFoot<dim> &foot);
  bool faces_target(unsigned int pair, const Positions &positions) const;
  /// At least the distance of a point from a facet [m].
  double bound_distance(unsigned int facet, const SpatialVector<dim> &x, const Positions &positions);
  void reject_where_others_are_near(unsigned int begin, unsigned int end, const Positions &positions);
  void find_by_search(unsigned int pair, const Positions &positions);
  void note_found(unsigned int pair);
  const DatedBox &box_of(unsigned int facet, const Positions &positions);
  const std::vector<unsigned int> &find_near(unsigned int neighbours, double distance,
                                             const Positions &positions);

  const ContactSurface<dim> *surface = nullptr; ///< of a call
  const PairList<dim> *pairs = nullptr;         ///< of a call
  std::vector<PairFoot<dim>> feet;
  std::vector<double> sleeps_until; ///< way at which the point may be at its target, one a pair [m]
  std::vector<double> alone_until;  ///< way at which another facet may be as near, one a pair [m]
  double way = 0.; ///< that any point and any facet have gone, together, at most; only ever grows [m]
  double found_within = -1.;           ///< what was asked for at these positions, none if negative [m]
  std::vector<unsigned int> touching_; ///< in rising order

  // Reused from call to call.
  std::vector<unsigned int> awake;
  std::vector<DatedBox> boxes; ///< one a facet
  std::vector<Near> all_near;  ///< one an entry of the neighbour list
  unsigned int date = 0;
  Chunk chunk;
};

/// The foot of a pair on those `candidates` of its target body, no farther than `cutoff` [m], where the nodes
/// are `at` these positions; depth −∞ if there is none.
template <int dim>
PairFoot<dim> find_pair_foot(const ContactSurface<dim> &surface, const std::vector<unsigned int> &candidates,
                             const ContactPair<dim> &pair, const std::vector<SpatialVector<dim>> &at,
                             double cutoff);
} // namespace signorini::contact
