// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/physics/batch_order.h"

#include <algorithm>

namespace signorini
{
namespace
{
/// Larger than the number of cells at a node of most meshes, small enough to stay within the caches.
constexpr std::size_t n_open_batches = 24;
} // namespace

std::vector<unsigned int> make_batch_order(const std::vector<unsigned int> &cell_nodes, unsigned int n_nodes,
                                           unsigned int n_lanes)
{
  const unsigned int n_cells = static_cast<unsigned int>(cell_nodes.size() / n_nodes);
  std::vector<std::vector<unsigned int>> open;
  std::vector<unsigned int> order;
  order.reserve(n_cells);
  const auto have_common_place = [&](unsigned int one, unsigned int other)
  {
    for (unsigned int a = 0; a < n_nodes; ++a)
      if (cell_nodes[one * n_nodes + a] == cell_nodes[other * n_nodes + a])
        return true;
    return false;
  };
  for (unsigned int cell = 0; cell < n_cells; ++cell)
  {
    auto batch = std::find_if(open.begin(), open.end(),
                              [&](const std::vector<unsigned int> &others)
                              {
                                return std::none_of(others.begin(), others.end(),
                                                    [&](unsigned int other)
                                                    { return have_common_place(cell, other); });
                              });
    if (batch == open.end() && open.size() < n_open_batches)
      batch = open.insert(open.end(), std::vector<unsigned int>());
    else if (batch == open.end())
      batch = open.begin();
    batch->push_back(cell);
    if (batch->size() < n_lanes)
      continue;
    order.insert(order.end(), batch->begin(), batch->end());
    open.erase(batch);
  }
  for (const std::vector<unsigned int> &rest : open)
    order.insert(order.end(), rest.begin(), rest.end());
  return order;
}
} // namespace signorini
