// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/output/collisions.h"

#include <algorithm>
#include <map>

namespace signorini
{
namespace
{
/// Relative velocities before and after, multiplied: positive for bodies that go on as they did.
double compare_velocities(const HistoryRow &before, const HistoryRow &after, const Collision &collision)
{
  double product = 0.;
  for (unsigned int d = 0; d < 3; ++d)
    product += (before.bodies[collision.one].velocity[d] - before.bodies[collision.other].velocity[d]) *
               (after.bodies[collision.one].velocity[d] - after.bodies[collision.other].velocity[d]);
  return product;
}
} // namespace

std::vector<Collision> find_collisions(const std::vector<HistoryRow> &history)
{
  std::vector<Collision> collisions;
  std::map<std::pair<unsigned int, unsigned int>, std::size_t> first_rows; // of the pairs that touch
  for (std::size_t i = 0; i < history.size(); ++i)
  {
    const auto &touching = history[i].touching;
    for (auto pair = first_rows.begin(); pair != first_rows.end();)
    {
      const bool is_over = !std::binary_search(touching.begin(), touching.end(), pair->first);
      if (!is_over && i + 1 < history.size())
      {
        ++pair;
        continue;
      }
      const std::size_t first = pair->second, last = is_over ? i - 1 : i;
      Collision collision{
          pair->first.first, pair->first.second, history[first].time, history[last].time, is_over, false};
      collision.is_through =
          is_over && first > 0 && compare_velocities(history[first - 1], history[i], collision) > 0.;
      collisions.push_back(collision);
      pair = first_rows.erase(pair);
    }
    for (const auto &pair : touching)
      if (i + 1 < history.size())
        first_rows.emplace(pair, i);
  }
  return collisions;
}

std::string outcome(const Collision &collision)
{
  if (!collision.is_over)
    return "touching";
  return collision.is_through ? "passed through" : "bounced";
}
} // namespace signorini
