// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/output/collisions.h"

#include <algorithm>
#include <array>
#include <map>

namespace signorini
{
namespace
{
using Velocity = std::array<double, 3>;

Velocity relative_velocity(const HistoryRow &row, const Collision &collision)
{
  Velocity velocity;
  for (unsigned int d = 0; d < 3; ++d)
    velocity[d] = row.bodies[collision.one].velocity[d] - row.bodies[collision.other].velocity[d];
  return velocity;
}

/// Whether the impulse between them has not turned around the motion along it.
bool goes_on(const HistoryRow &before, const HistoryRow &after, const Collision &collision)
{
  const Velocity v = relative_velocity(before, collision), w = relative_velocity(after, collision);
  double along_before = 0., along_after = 0.;
  for (unsigned int d = 0; d < 3; ++d)
  {
    along_before += v[d] * (w[d] - v[d]);
    along_after += w[d] * (w[d] - v[d]);
  }
  return !(along_before < 0. && along_after > 0.);
}

/// Whether what follows the row `i` within the time that the contact has lasted, or two rows, is a part of
/// it.
bool touches_again(const std::vector<HistoryRow> &history, std::size_t i, std::size_t first,
                   const std::pair<unsigned int, unsigned int> &pair)
{
  const double until = 2. * history[i - 1].time - history[first].time;
  for (std::size_t next = i + 1; next < history.size() && (next <= i + 1 || history[next].time <= until);
       ++next)
    if (std::binary_search(history[next].touching.begin(), history[next].touching.end(), pair))
      return true;
  return false;
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
      const bool is_over = !std::binary_search(touching.begin(), touching.end(), pair->first) &&
                           !touches_again(history, i, pair->second, pair->first);
      if (!is_over && i + 1 < history.size())
      {
        ++pair;
        continue;
      }
      const std::size_t first = pair->second, last = is_over ? i - 1 : i;
      Collision collision{
          pair->first.first, pair->first.second, history[first].time, history[last].time, is_over, false};
      collision.is_through = is_over && first > 0 && goes_on(history[first - 1], history[i], collision);
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
