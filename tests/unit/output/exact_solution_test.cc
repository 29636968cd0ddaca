// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/output/exact_solution.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace signorini;

namespace
{
TEST(Restitution, FollowsTheTable)
{
  const std::vector<std::pair<double, double>> table{{.03, .912}, {.1, .744}, {.2, .572}, {.3, .451},
                                                     {.5, .298},  {.7, .210}, {1., .135}};
  for (const auto &[damping_ratio, expected] : table)
    EXPECT_NEAR(restitution(damping_ratio), expected, 6e-4) << damping_ratio;
  EXPECT_DOUBLE_EQ(restitution(0.), 1.);
}

/// e of m ẍ + c ẋ + k x = 0 (m = k = 1), released when the force vanishes: by fine time steps.
double simulate_bounce(double damping_ratio)
{
  const double step = 1e-4;
  double x = 0., v = 1.;
  const auto force = [&](double position, double velocity) { return -position - 2. * damping_ratio * velocity; };
  for (bool has_begun = false;; has_begun = true)
  {
    if (has_begun && force(x, v) >= 0.)
      return -v;
    const double half_v = v + .5 * step * force(x, v), half_x = x + .5 * step * v;
    x += step * half_v;
    v += step * force(half_x, half_v);
  }
}

TEST(Restitution, FollowsASimulatedSpringAndDashpot)
{
  for (const double damping_ratio : {.05, .4, .7071, .9, .999, 1., 1.5, 3.})
    EXPECT_NEAR(restitution(damping_ratio), simulate_bounce(damping_ratio), 2e-4) << damping_ratio;
}
} // namespace
