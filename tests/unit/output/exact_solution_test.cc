// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/output/exact_solution.h"
#include "signorini/output/impact_solutions.h"

#include "signorini/base/exceptions.h"
#include "signorini/output/rough_plane.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

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
  const auto force = [&](double position, double velocity)
  { return -position - 2. * damping_ratio * velocity; };
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

/// The same way by fine time steps, with a friction that is only smooth.
Slide simulate_slide(double velocity, double acceleration, double braking, double T)
{
  const double step = 1e-5;
  Slide result;
  for (double t = 0.; t < T; t += step)
  {
    velocity += step * (acceleration - braking * std::tanh(velocity / 1e-4));
    result.way += step * velocity;
    result.distance += step * std::abs(velocity);
  }
  return result;
}

TEST(RoughPlane, MassSlidesAsItDoesInSmallSteps)
{
  for (const double velocity : {-1., 0., 1.})
    for (const double acceleration : {-3., 0., 3.})
      for (const double braking : {0., 2., 4.})
        for (const double T : {.1, .7})
        {
          const Slide exact = slide(velocity, acceleration, braking, T),
                      simulated = simulate_slide(velocity, acceleration, braking, T);
          EXPECT_NEAR(exact.way, simulated.way, 2e-4) << velocity << " " << acceleration << " " << braking;
          EXPECT_NEAR(exact.distance, simulated.distance, 2e-4);
        }
}

/// p₀ of a sphere or cylinder of radius 1 under a force of 1.
template <int dim>
double peak_pressure(const Parameters &parameters)
{
  Results<dim> results;
  results.parameters = &parameters;
  results.contact.resultants.push_back(Eigen::Matrix<double, dim, 1>::Unit(dim - 1));
  return exact_pressure(results, 0.);
}

TEST(Hertz, TakesTheBodiesThatTouch)
{
  Parameters parameters;
  parameters.bodies.resize(1);
  parameters.bodies[0].material.youngs_modulus = 2.;
  parameters.obstacles.resize(1);
  parameters.exact_solution =
      ExactSolutionParameters{"Hertz sphere", {{"Radius", 1.}, {"Fraction of the contact", 1.}}, {}};
  const double on_obstacle = peak_pressure<3>(parameters);
  EXPECT_NEAR(on_obstacle, std::cbrt(6. * 4.) / std::acos(-1.), 1e-14); // p₀³ = 6 P E*²/(π³R²)
  parameters.obstacles.clear();
  parameters.bodies.push_back(parameters.bodies[0]);
  EXPECT_NEAR(peak_pressure<3>(parameters), on_obstacle / std::cbrt(4.), 1e-14);
  parameters.exact_solution->name = "Hertz cylinder";
  EXPECT_NEAR(peak_pressure<2>(parameters), std::sqrt(1. / std::acos(-1.)), 1e-14); // p₀² = P E*/(πR)
}

TEST(ExactSolution, IsNotComparedWithWhereNothingTouches)
{
  Parameters parameters;
  parameters.exact_solution =
      ExactSolutionParameters{"Hertz sphere", {{"Radius", 1.}, {"Fraction of the contact", 1.}}, {}};
  Results<3> results;
  results.parameters = &parameters;
  results.contact.resultants.push_back({0., 0., 1.});
  try
  {
    compute_errors(results);
    FAIL() << "an error was computed of nothing";
  }
  catch (const NumericalError &error)
  {
    EXPECT_NE(std::string(error.what()).find("nothing touches at the end: nothing to compare with case"),
              std::string::npos)
        << error.what();
  }
  parameters.exact_solution->name = "Bounce";
  EXPECT_THROW(compute_errors(results), NumericalError);
}

/// A mass on a spring with the force K δ^(3/2), step by step.
BallImpact simulate_ball_impact(double modulus, double radius, double mass, double speed)
{
  const double K = 4. / 3. * modulus * std::sqrt(radius), step = 1e-5 * std::sqrt(mass / (modulus * radius));
  double depth = 0., velocity = speed, force = 0.;
  BallImpact impact;
  do
  {
    velocity -= 0.5 * step * force / mass;
    depth += step * velocity;
    force = K * std::pow(std::max(depth, 0.), 1.5);
    velocity -= 0.5 * step * force / mass;
    impact.duration += step;
    impact.approach = std::max(impact.approach, depth);
    impact.peak_force = std::max(impact.peak_force, force);
  } while (depth > 0.);
  return impact;
}

TEST(ExactSolution, BallImpactIsThatOfASpringOfHertz)
{
  const BallImpact exact = solve_ball_impact(3., 2., 5., 0.1),
                   simulated = simulate_ball_impact(3., 2., 5., 0.1);
  EXPECT_NEAR(exact.approach, simulated.approach, 1e-4 * exact.approach);
  EXPECT_NEAR(exact.peak_force, simulated.peak_force, 1e-4 * exact.peak_force);
  EXPECT_NEAR(exact.duration, simulated.duration, 1e-4 * exact.duration);
}
} // namespace
