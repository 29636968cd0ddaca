// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/discretization/placement.h"

#include <deal.II/base/numbers.h>
#include <deal.II/physics/transformations.h>

namespace signorini
{
namespace
{
dealii::Tensor<2, 2> make_rotation(double angle, const dealii::Tensor<1, 3> &, const std::integral_constant<int, 2> &)
{
  return dealii::Physics::Transformations::Rotations::rotation_matrix_2d(angle);
}

dealii::Tensor<2, 3> make_rotation(double angle, const dealii::Tensor<1, 3> &axis,
                                   const std::integral_constant<int, 3> &)
{
  // Rodrigues' formula, by hand because deal.II renames its own after 9.4.
  const dealii::Tensor<1, 3> unit = axis / axis.norm();
  dealii::Tensor<2, 3> rotation;
  for (unsigned int i = 0; i < 3; ++i)
  {
    rotation[i][i] = std::cos(angle);
    for (unsigned int j = 0; j < 3; ++j)
      rotation[i][j] += (1. - std::cos(angle)) * unit[i] * unit[j];
    const unsigned int j = (i + 1) % 3, k = (i + 2) % 3;
    rotation[j][i] += std::sin(angle) * unit[k];
    rotation[k][i] -= std::sin(angle) * unit[j];
  }
  return rotation;
}
} // namespace

template <int dim>
Placement<dim>::Placement(const PlacementParameters &parameters)
  : scale(parameters.scale)
{
  const dealii::Tensor<1, 3> axis({parameters.rotation_axis[0], parameters.rotation_axis[1],
                                   parameters.rotation_axis[2]});
  rotation = make_rotation(parameters.rotation_angle * dealii::numbers::PI / 180., axis,
                           std::integral_constant<int, dim>());
  for (unsigned int d = 0; d < dim; ++d)
    shift[d] = parameters.shift[d];
}

template <int dim>
dealii::Point<dim> Placement<dim>::place(const dealii::Point<dim> &own) const
{
  return dealii::Point<dim>(shift + scale * (rotation * own));
}

template <int dim>
dealii::Point<dim> Placement<dim>::own_coordinates(const dealii::Point<dim> &placed) const
{
  return dealii::Point<dim>(dealii::transpose(rotation) * (placed - dealii::Point<dim>(shift)) / scale);
}

template class Placement<2>;
template class Placement<3>;
} // namespace signorini
