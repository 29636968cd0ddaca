// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/parameters/parameters.h"

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

namespace signorini
{
/// Where a body stands: x = shift + scale·R·X, with X its own coordinates.
template <int dim>
class Placement
{
public:
  /// In 2-D bodies rotate in the plane, whatever the axis.
  explicit Placement(const PlacementParameters &parameters);

  dealii::Point<dim> place(const dealii::Point<dim> &own) const;
  dealii::Point<dim> own_coordinates(const dealii::Point<dim> &placed) const;
  dealii::Tensor<1, dim> rotate(const dealii::Tensor<1, dim> &direction) const { return rotation * direction; }

private:
  dealii::Tensor<2, dim> rotation;
  dealii::Tensor<1, dim> shift;
  double scale;
};
} // namespace signorini
