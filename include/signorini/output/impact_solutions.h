// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/output/results.h"

namespace signorini
{
/// Hertz's impact of a sphere (1881; K. L. Johnson, Contact Mechanics, section 11.4): elastic, and slow
/// beside the waves in the bodies, which it takes for rigid but for the contact.
struct BallImpact
{
  double approach = 0.;   ///< largest [m]
  double peak_force = 0.; ///< [N]
  double duration = 0.;   ///< [s]
};

/// `modulus` E* [Pa], `radius` R [m], `mass` m with 1/m = Σ 1/m_i [kg], `speed` at which the two approach
/// [m/s].
BallImpact solve_ball_impact(double modulus, double radius, double mass, double speed);

/// Restitution of a linear spring–dashpot that is released when its force vanishes.
double restitution(double damping_ratio);

/// Errors of runs against the impact of two equal bars, of a sphere, and of a block on a floor with damping.
template <int dim>
std::vector<ErrorRow> compare_with_bar_impact(const Results<dim> &results);
template <int dim>
std::vector<ErrorRow> compare_with_ball_impact(const Results<dim> &results);
template <int dim>
std::vector<ErrorRow> compare_with_bounce(const Results<dim> &results);
} // namespace signorini
