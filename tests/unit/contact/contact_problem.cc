// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/potential/contact_problem.h"

#include "../../laws/box_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace signorini;
using namespace signorini::contact;

namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Points on random nodes, with random normals and depths, and the masses of the nodes.
template <int dim>
struct RandomPoints
{
  using Weights = typename ContactProblem<dim>::Weights;
  static constexpr double time_step = 2e-3;

  std::vector<SpatialVector<dim>> masses;
  std::vector<Weights> weights;
  std::vector<SpatialVector<dim>> normals;
  std::vector<double> depths, start_depths;
  double stiffness;
  double damping;
  PairStencil<dim> unused;

  RandomPoints(unsigned int n_nodes, unsigned int n_points, double the_stiffness, double the_damping)
      : stiffness(the_stiffness), damping(the_damping)
  {
    test::RandomVectors<dim> random(3);
    for (unsigned int node = 0; node < n_nodes; ++node)
      masses.push_back(SpatialVector<dim>::Constant(random.number(0.5, 1.5)));
    for (unsigned int q = 0; q < n_points; ++q)
    {
      // Neighbouring points are on the same nodes, as those of a face.
      const unsigned int first = q / 3 % (n_nodes - 3);
      const double share = random.number(0.1, 0.9);
      weights.push_back({{first, share}, {first + 1, 1. - share}, {first + 3, -1.}});
      normals.push_back(random.vector(1.).normalized());
      depths.push_back(random.number(-1e-3, 1e-3));
      start_depths.push_back(depths.back() + random.number(-5e-4, 5e-4));
    }
  }

  double area(std::size_t q) const { return 1. + 0.1 * static_cast<double>(q % 5); }

  void add_to(ContactProblem<dim> &problem, std::size_t first, std::size_t end) const
  {
    for (std::size_t q = first; q < end; ++q)
      problem.add({unused, normals[q], depths[q], area(q), stiffness, damping, start_depths[q], {}},
                  weights[q]);
  }

  double depth(std::size_t q, const std::vector<SpatialVector<dim>> &increments) const
  {
    double depth = depths[q];
    for (const auto &weight : weights[q])
      depth -= weight.share * normals[q].dot(increments[weight.node]);
    return depth;
  }

  /// Spring and dashpot, which press only.
  double pressure(std::size_t q, const std::vector<SpatialVector<dim>> &increments) const
  {
    const double d = depth(q, increments);
    return std::max(0., stiffness * d + damping * (d - std::max(start_depths[q], 0.)) / time_step);
  }
};

template <int dim>
void check_equilibrium(const RandomPoints<dim> &points, double tolerance)
{
  ContactProblem<dim> problem(points.masses, points.time_step);
  points.add_to(problem, 0, points.weights.size());
  const auto increments = problem.solve();
  ASSERT_TRUE(increments);
  std::vector<SpatialVector<dim>> forces(points.masses.size(), SpatialVector<dim>::Zero());
  double scale = 0.;
  unsigned int n_pressing = 0;
  for (std::size_t q = 0; q < points.weights.size(); ++q)
  {
    const double force = points.area(q) * points.pressure(q, *increments);
    n_pressing += force > 0.;
    scale = std::max(scale, force);
    for (const auto &weight : points.weights[q])
      forces[weight.node] += weight.share * force * points.normals[q];
  }
  EXPECT_GT(n_pressing, points.weights.size() / 8);
  EXPECT_LT(n_pressing, points.weights.size());
  for (std::size_t node = 0; node < forces.size(); ++node)
    for (unsigned int d = 0; d < dim; ++d)
      if (std::isfinite(points.masses[node][d]))
        EXPECT_NEAR(points.masses[node][d] * (*increments)[node][d] / std::pow(points.time_step, 2),
                    forces[node][d], tolerance * scale);
      else
        EXPECT_EQ((*increments)[node][d], 0.);
}

TEST(ContactProblem, OnePointByHand)
{
  const std::vector<SpatialVector<2>> masses{SpatialVector<2>(3., 3.), SpatialVector<2>(infinity, infinity)};
  const double time_step = 0.1, stiffness = 50., area = 2., depth = 0.01, share = 0.5;
  ContactProblem<2> problem(masses, time_step);
  const PairStencil<2> unused{};
  const SpatialVector<2> normal(0., 1.);
  problem.add({unused, normal, depth, area, stiffness, 0., 0., {}}, {{0, share}, {1, -1.}});
  const auto increments = problem.solve();
  ASSERT_TRUE(increments);
  // m δ/Δt² = A k (d − w δ) w
  const double expected =
      area * stiffness * depth * share / (3. / (time_step * time_step) + area * stiffness * share * share);
  EXPECT_NEAR((*increments)[0][1], expected, 1e-15);
  EXPECT_EQ((*increments)[0][0], 0.);
  EXPECT_EQ((*increments)[1], SpatialVector<2>(0., 0.));
}

TEST(ContactProblem, PointsThatDoNotOverlapMoveNothing)
{
  RandomPoints<3> points(8, 12, 1e3, 0.);
  for (double &depth : points.depths)
    depth = -std::abs(depth);
  ContactProblem<3> problem(points.masses, points.time_step);
  points.add_to(problem, 0, 12);
  const auto increments = problem.solve().value();
  for (const SpatialVector<3> &increment : increments)
    EXPECT_EQ(increment, SpatialVector<3>(0., 0., 0.));
}

/// The round-off of a depth weighs as the stiffness, over m/Δt² = 2.5e5.
double tolerance_for(double stiffness)
{
  return std::max(1e-12, 1e-21 * stiffness);
}

TEST(ContactProblem, FindsTheForcesOfSpringsOfAnyStiffness)
{
  for (const double stiffness : {1., 1e3, 1e6, 1e9, 1e12})
  {
    check_equilibrium(RandomPoints<2>(20, 90, stiffness, 0.), tolerance_for(stiffness));
    check_equilibrium(RandomPoints<3>(20, 90, stiffness, 0.), tolerance_for(stiffness));
  }
}

TEST(ContactProblem, FindsTheForcesOfDashpots)
{
  for (const double damping : {1., 1e4, 1e7})
    check_equilibrium(RandomPoints<3>(20, 90, 1e5, damping),
                      tolerance_for(damping / RandomPoints<3>::time_step));
}

TEST(ContactProblem, WhatCannotGiveWayStays)
{
  RandomPoints<3> points(20, 90, 1e6, 10.);
  points.masses[4] = SpatialVector<3>::Constant(infinity);
  points.masses[7][1] = infinity;
  check_equilibrium(points, 1e-12);
}

TEST(ContactProblem, NeverAddsEnergy)
{
  for (const double stiffness : {1e2, 1e6, 1e10})
  {
    const RandomPoints<3> points(20, 90, stiffness, 0.);
    ContactProblem<3> problem(points.masses, points.time_step);
    points.add_to(problem, 0, 90);
    const auto increments = problem.solve().value();
    test::RandomVectors<3> random(8);
    // Before the step the nodes were anywhere else, and moved by v Δt to where the depths are those given.
    for (unsigned int trial = 0; trial < 5; ++trial)
    {
      const auto way = random.field(20, 1e-3);
      double gain = 0.;
      for (std::size_t node = 0; node < 20; ++node)
        gain += 0.5 * points.masses[node][0] *
                ((way[node] + increments[node]).squaredNorm() - way[node].squaredNorm()) /
                std::pow(points.time_step, 2);
      std::vector<SpatialVector<3>> back;
      for (const SpatialVector<3> &of_node : way)
        back.push_back(-of_node);
      double scale = 0.;
      for (std::size_t q = 0; q < 90; ++q)
      {
        const auto energy = [&](double depth)
        { return 0.5 * points.area(q) * stiffness * std::pow(std::max(depth, 0.), 2); };
        const double before = energy(points.depth(q, back));
        gain += energy(points.depth(q, increments)) - before;
        scale += before;
      }
      EXPECT_LE(gain, 1e-12 * scale);
    }
  }
}

unsigned int as_it_is(unsigned int node)
{
  return node;
}

TEST(ContactProblem, IsTheSameTakenFromItsNumbers)
{
  const RandomPoints<3> points(20, 90, 1e6, 10.);
  ContactProblem<3> whole(points.masses, points.time_step), first = whole, second = whole, joined = whole;
  points.add_to(whole, 0, 90);
  points.add_to(first, 0, 33);
  points.add_to(second, 33, 90);
  joined.add_packed(first.pack(), as_it_is);
  joined.add_packed(second.pack(), as_it_is);
  EXPECT_EQ(joined.n_points(), 90u);
  EXPECT_EQ(whole.solve().value(), joined.solve().value());
}

TEST(ContactProblem, AddsUpTheWeightsOfANode)
{
  const std::vector<SpatialVector<2>> masses(2, SpatialVector<2>(1., 1.));
  const PairStencil<2> unused{};
  const SpatialVector<2> normal(0.6, 0.8);
  std::vector<std::vector<SpatialVector<2>>> found;
  for (const ContactProblem<2>::Weights &weights : {ContactProblem<2>::Weights{{0, 0.3}, {1, -1.}, {0, 0.7}},
                                                    ContactProblem<2>::Weights{{0, 1.}, {1, -1.}}})
  {
    ContactProblem<2> problem(masses, 0.1);
    problem.add({unused, normal, 0.01, 1., 100., 0., 0., {}}, weights);
    found.push_back(problem.solve().value());
  }
  for (unsigned int node = 0; node < 2; ++node)
    EXPECT_LT((found[0][node] - found[1][node]).norm(), 1e-15);
}

/// Points that rub, some of which stick, some slide and some are free.
template <int dim>
struct RubbingPoints : RandomPoints<dim>
{
  double coefficient;
  std::vector<LinearSlip<dim>> slips;

  RubbingPoints(double the_coefficient, double the_stiffness, double the_damping)
      : RandomPoints<dim>(20, 90, the_stiffness, the_damping), coefficient(the_coefficient)
  {
    test::RandomVectors<dim> random(4);
    for (std::size_t q = 0; q < this->weights.size(); ++q)
    {
      slips.emplace_back();
      slips.back().coefficient = coefficient;
      slips.back().trial = across(q, random.vector(1e-4));
      for (auto &weight : this->weights[q])
        weight.lever = across(q, random.vector(.1));
    }
  }

  SpatialVector<dim> across(std::size_t q, const SpatialVector<dim> &v) const
  {
    return v - this->normals[q].dot(v) * this->normals[q];
  }

  void add_to(ContactProblem<dim> &problem, std::size_t first, std::size_t end) const
  {
    for (std::size_t q = first; q < end; ++q)
      problem.add({this->unused, this->normals[q], this->depths[q], this->area(q), this->stiffness,
                   this->damping, this->start_depths[q], slips[q]},
                  this->weights[q]);
  }

  SpatialVector<dim> trial(std::size_t q, const std::vector<SpatialVector<dim>> &increments) const
  {
    SpatialVector<dim> slip = slips[q].trial;
    for (const auto &weight : this->weights[q])
      slip += weight.share * across(q, increments[weight.node]) +
              this->normals[q].dot(increments[weight.node]) * weight.lever;
    return slip;
  }
};

template <int dim>
void check_friction(const RubbingPoints<dim> &points)
{
  ContactProblem<dim> problem(points.masses, points.time_step);
  points.add_to(problem, 0, points.weights.size());
  const auto increments = problem.solve();
  ASSERT_TRUE(increments);
  std::vector<SpatialVector<dim>> forces(points.masses.size(), SpatialVector<dim>::Zero());
  double scale = 0.;
  unsigned int n_sticking = 0, n_sliding = 0;
  for (std::size_t q = 0; q < points.weights.size(); ++q)
  {
    const double pressure = points.pressure(q, *increments);
    const SpatialVector<dim> trial = points.trial(q, *increments);
    const double longest = points.coefficient * pressure / points.stiffness;
    const bool sticks = trial.norm() <= longest;
    n_sticking += pressure > 0. && sticks;
    n_sliding += pressure > 0. && !sticks;
    const SpatialVector<dim> elastic = sticks ? trial : SpatialVector<dim>(longest / trial.norm() * trial);
    const SpatialVector<dim> force =
        points.area(q) * (pressure * points.normals[q] - points.stiffness * elastic);
    scale = std::max(scale, force.norm());
    for (const auto &weight : points.weights[q])
      forces[weight.node] += weight.share * force + weight.lever.dot(force) * points.normals[q];
  }
  EXPECT_GT(n_sticking, 2u);
  EXPECT_GT(n_sliding, 5u);
  for (std::size_t node = 0; node < forces.size(); ++node)
    for (unsigned int d = 0; d < dim; ++d)
      EXPECT_NEAR(points.masses[node][d] * (*increments)[node][d] / std::pow(points.time_step, 2),
                  forces[node][d], 1e-7 * scale)
          << problem.n_iterations();
}

TEST(ContactProblem, FindsCoulombsForces)
{
  for (const double coefficient : {.3, .6, .9})
    for (const double damping : {0., 1e4})
    {
      check_friction(RubbingPoints<2>(coefficient, 1e6, damping));
      check_friction(RubbingPoints<3>(coefficient, 1e6, damping));
    }
}

TEST(ContactProblem, ASlidingPointByHand)
{
  // On a plane: the pressure is that without friction, the traction μ times it.
  const double time_step = 0.1, stiffness = 50., area = 2., depth = 0.01, mass = 3., coefficient = .4;
  const std::vector<SpatialVector<3>> masses{SpatialVector<3>::Constant(mass)};
  ContactProblem<3> problem(masses, time_step);
  const PairStencil<3> unused{};
  const SpatialVector<3> normal(0., 0., 1.);
  LinearSlip<3> slip;
  slip.coefficient = coefficient;
  slip.trial = SpatialVector<3>(.03, .04, 0.);
  problem.add({unused, normal, depth, area, stiffness, 0., 0., slip}, {{0, 1.}});
  const SpatialVector<3> increment = problem.solve().value()[0];
  const double inertia = mass / (time_step * time_step),
               lift = area * stiffness * depth / (inertia + area * stiffness);
  EXPECT_NEAR(increment[2], lift, 1e-15);
  const double drag = coefficient * lift;
  EXPECT_LT((increment - SpatialVector<3>(-.6 * drag, -.8 * drag, lift)).norm(), 1e-10 * lift);
}

TEST(ContactProblem, FrictionIsTheSameTakenFromItsNumbers)
{
  const RubbingPoints<3> points(.3, 1e6, 10.);
  ContactProblem<3> whole(points.masses, points.time_step), joined = whole;
  points.add_to(whole, 0, 90);
  joined.add_packed(whole.pack(), as_it_is);
  EXPECT_EQ(whole.solve().value(), joined.solve().value());
}
} // namespace
