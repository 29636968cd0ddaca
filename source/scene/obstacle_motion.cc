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

template class ObstacleMotion<2>;
template class ObstacleMotion<3>;
} // namespace signorini
