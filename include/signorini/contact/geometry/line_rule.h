// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>

namespace signorini::contact
{
/// A Gauss rule on [0, 1].
struct LineRule
{
  static constexpr unsigned int max_n_points = 8;

  unsigned int n_points = 0;
  std::array<double, max_n_points> point{}, weight{};
};

/// What the integrand is multiplied with: 1, or r for the radius of a triangle collapsed to a square.
enum class LineWeight
{
  constant,
  linear
};

/// The rule with `n_points` (1 to 8) points for ∫_0^1 w(r) f(r) dr, exact for f of degree 2 n_points − 1.
/// Throws std::invalid_argument for any other number of points.
const LineRule &get_line_rule(unsigned int n_points, LineWeight weight);
} // namespace signorini::contact
