// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/output/results.h"

#include <string>
#include <vector>

namespace signorini
{
/// All collisions of a moving scene, in the order of their ends. All is judged along the line on which
/// contact pushes those that move most, d maximising Σ v² (F·d)² over the rows and the two, F being all
/// contact force on one of them and v its largest speed: what a support takes up turns nothing. They have
/// *parted* in a row without a force in which their centres of mass move away from each other along it;
/// touches are one collision until they have parted and then come towards each other anew. The sides of the
/// centres are compared between the row before the first touch and the one after the last; exchanging them
/// takes a way of at least a quarter of what the two measure along the line, and a penetration of a quarter
/// of an element: without it they have rolled or slid around each other. What lies between two rows goes
/// unseen.
///
/// `largest_penetration`: of the whole history, over the size of an element; infinite where it tells nothing.
std::vector<Collision> find_collisions(const std::vector<HistoryRow> &history, double largest_penetration);

/// As in summaries: "passed through".
std::string name_of(Collision::Outcome outcome);

/// Name of one that collides.
const std::string &name_of_collider(const Parameters &parameters, unsigned int index);
} // namespace signorini
