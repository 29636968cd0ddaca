// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/geometry/simplex_overlap.h"

#include "facet_samples.h"

#include <gtest/gtest.h>

#include <cmath>

namespace signorini::contact::testing
{
template <int dim>
using Corners = std::array<SpatialVector<dim>, dim + 1>;

using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

/// The origin and the ends of the unit vectors.
template <int dim>
Corners<dim> make_unit_corner()
{
  Corners<dim> corners;
  corners[0].setZero();
  for (unsigned int i = 0; i < dim; ++i)
    corners[i + 1] = SpatialVector<dim>::Unit(i);
  return corners;
}

/// `map` x + `shift` of all corners.
template <int dim>
Corners<dim> moved(Corners<dim> corners, const SpatialTensor<dim> &map, const SpatialVector<dim> &shift)
{
  for (auto &x : corners)
    x = map * x + shift;
  return corners;
}

template <int dim>
Corners<dim> shifted(const Corners<dim> &corners, const SpatialVector<dim> &shift)
{
  return moved<dim>(corners, SpatialTensor<dim>::Identity(), shift);
}

/// Corners in a cube of side 1, in either order of turning; no slivers.
template <int dim>
Corners<dim> make_random_simplex(Dice &dice)
{
  Corners<dim> corners;
  double volume = 0.;
  while (volume < .02)
  {
    for (auto &x : corners)
      x = dice.point<dim>(0., 1.);
    volume = make_simplex_shape<dim>(corners).volume;
  }
  return corners;
}

template <int dim>
SpatialVector<dim> mean(const Corners<dim> &corners)
{
  SpatialVector<dim> sum = SpatialVector<dim>::Zero();
  for (const auto &x : corners)
    sum += x;
  return sum / (dim + 1);
}

template <int dim>
ConvexPolytope<dim> overlap_of(const Corners<dim> &first, const Corners<dim> &second)
{
  return make_overlap(make_simplex_shape<dim>(first), make_simplex_shape<dim>(second));
}

/// Volume of the overlap, measured in the coordinates of one of the two.
template <int dim>
double overlap_volume(const Corners<dim> &first, const Corners<dim> &second, unsigned int of = 0)
{
  const auto integral = integrate_coordinates(overlap_of<dim>(first, second), of);
  return make_simplex_shape<dim>(of == 0 ? first : second).volume *
         integral.template segment<dim + 1>(of * (dim + 1)).sum();
}
} // namespace signorini::contact::testing
