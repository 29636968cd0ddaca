// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/output/results.h"

#include <string>
#include <vector>

namespace signorini
{
/// One impact of two bodies, or of a body and an obstacle, as the rows of the history show it.
struct Collision
{
  enum class Outcome
  {
    bounced,                 ///< they have parted, their centres on the same sides as before
    passed_through,          ///< they have parted, their centres have exchanged sides
    touching,                ///< not parted at the end of the history
    touching_from_the_start, ///< they have parted like `bounced`, but no row shows them before
  };

  unsigned int one = 0, other = 0; ///< see HistoryRow::bodies
  double begin = 0., end = 0.;     ///< first and last row with a force between them [s]
  Outcome outcome = Outcome::touching;
};

/// All collisions of a moving scene, in the order of their ends. All is judged along the line on which
/// contact pushes those that move most, d maximising Σ v² (F·d)² over the rows and the two, F being all
/// contact force on one of them and v its largest speed: what a support takes up turns nothing. They have
/// *parted* in a row without a force in which their centres of mass move away from each other along it;
/// touches are one collision until they have parted and then come towards each other anew. The sides of the
/// centres are compared between the row before the first touch and the one after the last; exchanging them
/// takes a way of at least a quarter of what the two measure along the line. What lies between
/// two rows goes unseen.
std::vector<Collision> find_collisions(const std::vector<HistoryRow> &history);

/// As in summaries: "passed through".
std::string name_of(Collision::Outcome outcome);

/// Name of one that collides.
const std::string &name_of_collider(const Parameters &parameters, unsigned int index);
} // namespace signorini
