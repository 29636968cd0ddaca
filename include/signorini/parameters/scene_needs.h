// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/parameters/parameter_text.h"
#include "signorini/parameters/parameters.h"

#include <functional>
#include <optional>
#include <string>

namespace signorini
{
/// What contradicts a need, and where it stands.
struct SceneFault
{
  std::string where; ///< file and line
  std::string found;
};

/// A condition on a whole scene.
struct SceneNeed
{
  std::string text; ///< completes "it needs …"
  std::function<std::optional<SceneFault>(const ParameterText &, const Parameters &)> find_fault;
};

/// Needs by the names they are listed with.
SceneNeed dimension_equal_to(unsigned int dimension);
SceneNeed quasi_static_run();
SceneNeed run_in_motion();
SceneNeed contact();
/// Pressures of all contact are known.
SceneNeed surface_potential();
SceneNeed contact_damping();
SceneNeed contact_friction();
/// Of one body and one plane: a direction along the plane in which gravity pulls or the body starts.
SceneNeed sliding_on_a_line();
SceneNeed number_of_bodies(unsigned int number);
SceneNeed number_of_obstacles(unsigned int number);
/// One body and one obstacle, or two bodies and no obstacle: it is clear what touches what.
SceneNeed one_touching_pair();
/// Obstacles that do not move, of these shapes only; `needed` says so.
SceneNeed fixed_obstacles(const std::string &needed, const std::vector<ObstacleParameters::Shape> &shapes);
SceneNeed boxes_only();
/// Quadrilaterals in 2-D.
SceneNeed hexahedra_only();
SceneNeed linear_elastic_bodies();
SceneNeed no_transverse_contraction();
SceneNeed no_viscosity();
/// No body is rotated or scaled.
SceneNeed shifts_only();
SceneNeed no_grading();
/// All bodies are boxes of one material and one size.
SceneNeed equal_boxes();
SceneNeed a_load();
/// A ball or a sphere takes part, and the radius of the exact solution is the effective one.
SceneNeed matching_radius();
/// The pressure of the exact solution is that of every load that is uniform, at the end time.
SceneNeed matching_pressure();
} // namespace signorini
