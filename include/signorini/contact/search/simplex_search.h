// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/search/facet_box.h"
#include "signorini/contact/search/search_record.h"
#include "signorini/discretization/contact_volume.h"

#include <functional>
#include <utility>
#include <vector>

namespace signorini::contact
{
/// Pairs of near simplices of different bodies, valid until some node has moved half the skin.
///
/// A pair {first, second} is listed by the rank that owns its first simplex, that of the body with the lower
/// index. The order depends on the numbering only: pairs of the same first simplex and the same other body
/// stand together.
template <int dim>
class SimplexSearch
{
public:
  using Positions = std::vector<SpatialVector<dim>>;
  using Pairs = std::vector<std::pair<unsigned int, unsigned int>>;
  using IsAllowedPair = std::function<bool(unsigned int body, unsigned int other_body)>;

  /// `volume` must outlive this object. Throws std::invalid_argument unless `skin` > 0 [m].
  SimplexSearch(const ContactVolume<dim> &contact_volume, double skin_thickness,
                IsAllowedPair is_allowed_pair);

  /// True before the first build, and as soon as any node moved more than skin/2 since.
  bool is_stale(const Positions &positions) const { return record.is_stale(positions); }

  /// Finds all pairs of simplices less than the skin apart, and some more: those that neither their boxes nor
  /// one of their faces separate.
  void rebuild(const Positions &positions);

  const Pairs &pairs() const { return pairs_; }
  unsigned int n_rebuilds() const { return record.n_searches(); }

private:
  struct Configuration;

  void add_pairs(unsigned int first_body, unsigned int second_body, const Configuration &configuration);

  const ContactVolume<dim> &volume;
  double skin;
  SearchRecord<dim> record;
  IsAllowedPair is_allowed;
  std::vector<std::vector<unsigned int>> simplices_of_body;

  Pairs pairs_;
};
} // namespace signorini::contact
