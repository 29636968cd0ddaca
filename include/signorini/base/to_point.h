// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/base/triple.h"

#include <deal.II/base/point.h>

namespace signorini
{
/// A triple as a point of deal.II.
template <int dim>
dealii::Point<dim> to_point(const Triple &triple)
{
  dealii::Point<dim> point;
  for (unsigned int d = 0; d < dim; ++d)
    point[d] = triple[d];
  return point;
}

/// A point of deal.II as a triple.
template <int dim>
Triple to_triple(const dealii::Point<dim> &point)
{
  Triple triple{};
  for (unsigned int d = 0; d < dim; ++d)
    triple[d] = point[d];
  return triple;
}
} // namespace signorini
