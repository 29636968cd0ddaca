// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "built_scene.h"

namespace signorini::test
{
/// A box on a cube whose upper face has hanging nodes, `overlap` deep in it; the meshes do not match.
template <int dim>
std::vector<BodyParameters> make_overlapping_bodies(double overlap = .05)
{
  BodyParameters lower = make_graded_cube({1., 1., 1.});
  BodyParameters upper = make_box("upper", {.7, .7, .7}, {2, 2, 2});
  upper.material.youngs_modulus = 3000.;
  upper.material.density = 4.;
  upper.placement.shift = {.237, .119, 0.};
  upper.placement.shift[dim - 1] = 1. - overlap;
  return {lower, upper};
}

inline contact::PotentialSettings make_settings(contact::Integration integration)
{
  contact::PotentialSettings settings;
  settings.integration = integration;
  settings.n_quadrature_points = 2;
  return settings;
}

/// A floor that reaches up to a height of the last coordinate.
template <int dim>
ObstacleParameters make_floor(double height)
{
  ObstacleParameters floor;
  floor.name = "floor";
  floor.point[dim - 1] = height;
  floor.normal = {};
  floor.normal[dim - 1] = 1.;
  return floor;
}
} // namespace signorini::test
