// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/geometry/line_rule.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace signorini::contact
{
namespace
{
/// Jacobi polynomial of degree n for the weight (1 − x)^a on [−1, 1], a = 0 or 1, and its derivative, by the
/// three-term recurrence.
std::array<double, 2> evaluate_jacobi(const unsigned int n, const LineWeight weight, const double x)
{
  const double a = (weight == LineWeight::constant ? 0. : 1.);
  double previous = 0., value = 1., first_previous = 0., first = 0.;
  for (unsigned int k = 0; k < n; ++k)
  {
    const double s = 2. * k + a;
    double slope = 0.5 * (a + 2.), offset = 0.5 * a, back = 0.;
    if (k > 0)
    {
      const double scale = 2. * (k + 1.) * (k + a + 1.) * s;
      slope = s * (s + 1.) * (s + 2.) / scale;
      offset = (s + 1.) * a * a / scale;
      back = 2. * (k + a) * k * (s + 2.) / scale;
    }
    const double next = (slope * x + offset) * value - back * previous;
    const double first_next = slope * value + (slope * x + offset) * first - back * first_previous;
    previous = value;
    value = next;
    first_previous = first;
    first = first_next;
  }
  return {value, first};
}

LineRule make_line_rule(const unsigned int n, const LineWeight weight)
{
  LineRule rule;
  rule.n_points = n;
  for (unsigned int i = 0; i < n; ++i)
  {
    // Newton's method with the roots found so far divided out cannot find one twice.
    double x = std::cos(3.14159265358979323846 * (i + 0.75) / (n + 0.5));
    for (unsigned int step = 0; step < 30; ++step)
    {
      const auto [value, first] = evaluate_jacobi(n, weight, x);
      double found = 0.;
      for (unsigned int j = 0; j < i; ++j)
        found += 1. / (x - (1. - 2. * rule.point[j]));
      x -= value / (first - value * found);
    }
    const double first = evaluate_jacobi(n, weight, x)[1];
    rule.point[i] = 0.5 * (1. - x);
    rule.weight[i] = 1. / ((1. - x * x) * first * first);
  }
  return rule;
}
} // namespace

const LineRule &get_line_rule(const unsigned int n_points, const LineWeight weight)
{
  static const auto rules = []
  {
    std::array<std::array<LineRule, LineRule::max_n_points>, 2> all;
    for (unsigned int i = 0; i < LineRule::max_n_points; ++i)
    {
      all[0][i] = make_line_rule(i + 1, LineWeight::constant);
      all[1][i] = make_line_rule(i + 1, LineWeight::linear);
    }
    return all;
  }();
  if (n_points < 1 || n_points > LineRule::max_n_points)
    throw std::invalid_argument(
        fmt::format("{} Gauss points a direction were asked for; there are rules of 1 to {}.", n_points,
                    LineRule::max_n_points));
  return rules[weight == LineWeight::constant ? 0 : 1][n_points - 1];
}
} // namespace signorini::contact
