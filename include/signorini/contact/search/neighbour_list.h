// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/search/facet_box.h"
#include "signorini/contact/search/search_record.h"

#include <functional>
#include <vector>

namespace signorini::contact
{
/// The facets of one body that may touch one owned facet, of another body or of the same.
struct FacetNeighbours
{
  unsigned int facet = 0;
  unsigned int target_body = 0;
  std::vector<unsigned int> candidates;
};

/// Pairs of near facets of different bodies, and of bodies that may touch themselves, valid until some node
/// has moved half the skin.
///
/// The order of neighbours() and of their candidates depends on the surface's numbering only.
template <int dim>
class NeighbourList
{
public:
  using Positions = std::vector<SpatialVector<dim>>;
  using IsAllowedPair = std::function<bool(unsigned int body, unsigned int other_body)>;

  /// `reach` [m], one an owned facet: how deep or far a point of that facet may see. `skin` > 0 [m].
  /// `is_allowed_pair` of a body and itself: whether it may touch itself; what of it is left out of that is
  /// settled here, on the undeformed surface (find_untouchable_facets). Without it nothing may touch.
  /// `surface` must outlive this object. Throws std::invalid_argument if these do not fit together.
  NeighbourList(const ContactSurface<dim> &contact_surface, std::vector<double> facet_reach,
                double skin_thickness, IsAllowedPair is_allowed_pair);

  /// True before the first build, and as soon as any node moved more than skin/2 since.
  bool is_stale(const Positions &positions) const { return record.is_stale(positions); }

  /// Finds, for every owned facet, all facets that it may touch whose bounding boxes come within reach + skin
  /// of its own (the skin a little wider for facets of degree 2, whose points may move farther than their
  /// nodes). Facets of other ranks may have changed since the last time.
  void rebuild(const Positions &positions);

  /// How far from its box an owned facet's neighbours are looked for [m].
  double search_distance(unsigned int facet) const;

  const std::vector<FacetNeighbours> &neighbours() const { return neighbours_; }
  unsigned int n_rebuilds() const { return record.n_searches(); }

  /// Of the last rebuild; empty before the first.
  const Positions &positions_at_search() const { return record.positions(); }

  /// The record of the last search, from which its neighbours are found again, for boost's archives.
  template <typename Archive>
  void serialize(Archive &archive, unsigned int /*version*/)
  {
    archive &record;
    if (Archive::is_loading::value && record.n_searches() > 0)
      find_neighbours(record.positions());
  }

private:
  struct Boxes;

  /// Takes the facets as they are now: those of other ranks come and go.
  void sort_facets();
  void find_neighbours(const Positions &positions);

  std::vector<unsigned int> find_near_bodies(unsigned int body, const Boxes &boxes) const;
  void add_neighbours_of_body(unsigned int body, Boxes &boxes);
  void add_neighbours_of_facet(unsigned int facet, unsigned int target_body, Boxes &boxes);

  const ContactSurface<dim> &surface;
  std::vector<double> reach;
  double skin;
  SearchRecord<dim> record;
  double largest_motion_factor = 1.;
  IsAllowedPair is_allowed;
  std::vector<std::vector<unsigned int>> facets_of_body;
  std::vector<std::vector<unsigned int>> untouchable; ///< of its own body, one a facet

  std::vector<FacetNeighbours> neighbours_;
};
} // namespace signorini::contact
