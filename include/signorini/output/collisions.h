// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/output/results.h"

#include <string>
#include <vector>

namespace signorini
{
/// One contact of two bodies from touch to parting, as the rows of the history show it.
struct Collision
{
  unsigned int one = 0, other = 0; ///< bodies
  double begin = 0., end = 0.;     ///< first and last row with a force between them [s]
  bool is_over = false;            ///< whether a row without a force follows
  bool is_through = false;         ///< whether the impulse between them has not turned their motion around
};

/// All collisions of a moving scene, in the order of their ends; contacts of a pair that follow each other
/// within the time that they last are one. What lies between two rows goes unseen.
std::vector<Collision> find_collisions(const std::vector<HistoryRow> &history);

/// "bounced", "passed through" or "touching".
std::string outcome(const Collision &collision);
} // namespace signorini
