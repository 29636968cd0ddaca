// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/base/spatial_vector.h"

#include <vector>

namespace signorini::contact
{
/// Where the nodes lay at the last search. Pairs found a skin beyond what may touch stay complete until two
/// nodes together have walked a skin (Verlet 1967).
template <int dim>
class SearchRecord
{
public:
  using Positions = std::vector<SpatialVector<dim>>;

  /// `skin_thickness` [m]
  explicit SearchRecord(double skin_thickness) : skin(skin_thickness) {}

  /// True before the first search, and as soon as any node moved more than skin/2 since.
  bool is_stale(const Positions &positions) const
  {
    if (n_searches_ == 0)
      return true;
    const double largest_square = .25 * skin * skin;
    for (std::size_t node = 0; node < positions.size(); ++node)
      if (!((positions[node] - positions_at_search[node]).squaredNorm() <= largest_square))
        return true;
    return false;
  }

  void note_search(const Positions &positions)
  {
    positions_at_search = positions;
    ++n_searches_;
  }

  unsigned int n_searches() const { return n_searches_; }

  const Positions &positions() const { return positions_at_search; }

  template <typename Archive>
  void serialize(Archive &archive, unsigned int /*version*/)
  {
    archive &positions_at_search &n_searches_;
  }

private:
  double skin;
  Positions positions_at_search;
  unsigned int n_searches_ = 0;
};
} // namespace signorini::contact
