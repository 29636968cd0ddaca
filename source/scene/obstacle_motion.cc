// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/scene/obstacle_motion.h"

#include "signorini/scene/scene.h"

#include <algorithm>

namespace signorini
{
template <int dim>
ObstacleMotion<dim>::ObstacleMotion(const std::vector<std::string> &the_formulas, std::string the_description,
                                    double end_time)
    : formulas(the_formulas.begin(), the_formulas.end()), description(std::move(the_description)),
      interval(1e-6 * end_time)
{
}

template <int dim>
SpatialVector<dim> ObstacleMotion<dim>::displacement(double t) const
{
  SpatialVector<dim> shift = SpatialVector<dim>::Zero();
  for (unsigned int d = 0; d < formulas.size(); ++d)
    shift[d] = evaluate(formulas[d], description, dealii::Point<dim>(), t);
  return shift;
}

template <int dim>
SpatialVector<dim> ObstacleMotion<dim>::velocity(double t) const
{
  // Formulas need have no values before the start.
  const double before = std::max(t - interval, 0.);
  return (displacement(before + interval) - displacement(before)) / interval;
}

template <int dim>
std::optional<ObstacleJump> ObstacleMotion<dim>::find_jump(double start, double end) const
{
  constexpr unsigned int n_halvings = 20;
  constexpr double jump = 0.01; // of the way; that of a motion would be a millionth by then
  const auto way = [this](double from, double to) { return (displacement(to) - displacement(from)).norm(); };
  const double whole = way(start, end);
  for (unsigned int i = 0; i < n_halvings; ++i)
  {
    const double middle = 0.5 * (start + end);
    (way(start, middle) > way(middle, end) ? end : start) = middle;
  }
  const double size = way(start, end);
  if (!(size > jump * whole))
    return {};
  return ObstacleJump{end, size};
}

template class ObstacleMotion<2>;
template class ObstacleMotion<3>;
} // namespace signorini
