// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <utility>
#include <vector>

namespace signorini::contact
{
/// Where the contact potential is sampled.
enum class Integration
{
  face_quadrature, ///< fixed Gauss points of every face: cheap, a fixed potential
  face_segments    ///< Gauss points on the parts where a face meets the other body's faces: passes the patch
                   ///< test
};

struct PotentialSettings
{
  double penalty_factor = 10.; ///< α > 0
  Integration integration = Integration::face_quadrature;
  unsigned int n_quadrature_points = 3; ///< a direction, on a face or a segment
  double skin_over_thickness = 0.5;     ///< skin of the neighbour list over the smallest layer thickness, > 0
  bool meets_bodies = true;             ///< false: obstacles only
  std::vector<std::pair<unsigned int, unsigned int>> excluded_body_pairs;     ///< in either order
  std::vector<std::pair<unsigned int, unsigned int>> excluded_obstacle_pairs; ///< (body, obstacle)
  std::vector<unsigned int> self_contact; ///< bodies that may touch themselves
  std::optional<double> damping_ratio;    ///< ξ ≥ 0
};
} // namespace signorini::contact
