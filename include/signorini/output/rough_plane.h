// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/output/results.h"

namespace signorini
{
/// How far a mass slides on a line with Coulomb friction.
struct Slide
{
  double way = 0.;      ///< from the start, with its sign [m]
  double distance = 0.; ///< travelled, to and fro [m]
};

/// In the time T [s] from the velocity `velocity` [m/s] on, driven by `acceleration` and braked by `braking`
/// ≥ 0 [m/s²]. A mass that comes to rest stays there unless it is driven by more than it is braked.
Slide slide(double velocity, double acceleration, double braking, double T);

/// Errors of a block on a rigid plane with friction against a point of its mass.
template <int dim>
std::vector<ErrorRow> compare_with_rough_plane(const Results<dim> &results);
} // namespace signorini
