// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/friction/slip_history.h"

namespace signorini::contact
{
template <int dim>
void SlipHistory<dim>::follow(const PairList<dim> &pairs)
{
  if (pairs.n_renewals() == n_renewals)
    return;
  n_renewals = pairs.n_renewals();
  reorder(pairs.body_pairs(), body_keys, bodies, parted_bodies);
  reorder(pairs.obstacle_pairs(), obstacle_keys, obstacles, parted_obstacles);
}

template <int dim>
void SlipHistory<dim>::forget_parted()
{
  parted_bodies.clear();
  parted_obstacles.clear();
}

template <int dim>
void SlipHistory<dim>::reorder(const Pairs &pairs, Keys &keys, Points &points, PointsByKey &parted)
{
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].before.is_touching())
      parted.emplace(keys[i], points[i]);
  keys.clear();
  points.assign(pairs.size(), FrictionPoint<dim>());
  for (std::size_t i = 0; i < pairs.size(); ++i)
  {
    keys.push_back(key_of(pairs[i]));
    if (const auto old = parted.find(keys[i]); old != parted.end())
    {
      points[i] = old->second;
      parted.erase(old);
    }
  }
}

template class SlipHistory<2>;
template class SlipHistory<3>;
} // namespace signorini::contact
