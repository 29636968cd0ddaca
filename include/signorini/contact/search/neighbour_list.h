// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/discretization/contact_surface.h"

#include <functional>
#include <vector>

namespace signorini::contact
{
/// The facets of one body that may touch one owned facet of another.
struct FacetNeighbours
{
  unsigned int facet = 0;
  unsigned int target_body = 0;
  std::vector<unsigned int> candidates;
};

/// Pairs of near facets of different bodies, valid until some node has moved half the skin.
template <int dim>
class NeighbourList
{
public:
  using Positions = std::vector<SpatialVector<dim>>;
  using IsAllowedPair = std::function<bool(unsigned int body, unsigned int other_body)>;

  /// `reach` [m], one a facet: how deep or far a point of that facet may see. `skin` > 0 [m].
  NeighbourList(const ContactSurface<dim> &surface, std::vector<double> reach, double skin, IsAllowedPair is_allowed);

  /// True before the first build, and as soon as any node moved more than skin/2 since.
  bool is_stale(const Positions &positions) const;

  /// Finds, for every owned facet, all facets of other bodies whose bounding boxes come within reach + skin of its own.
  void rebuild(const Positions &positions);

  const std::vector<FacetNeighbours> &neighbours() const;
  unsigned int n_rebuilds() const;
};
} // namespace signorini::contact
