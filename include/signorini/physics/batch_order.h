// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

namespace signorini
{
/// The cells in the order in which `n_lanes` after another make a batch, each with `n_nodes` entries of
/// `cell_nodes`. Neighbours stay near each other, but where the order given allows it no two cells of a batch
/// have the same node at the same place: their forces would have to wait for each other.
std::vector<unsigned int> make_batch_order(const std::vector<unsigned int> &cell_nodes, unsigned int n_nodes,
                                           unsigned int n_lanes);
} // namespace signorini
