// SPDX-License-Identifier: LGPL-2.1-or-later
// What holds for the contact potential in an implicit step, where depths are linear in the positions.
#include "signorini/contact/friction/friction.h"

#include "law_suites.h"

using namespace signorini;
using namespace signorini::contact;
using namespace signorini::test;

namespace
{
std::vector<Case> make_cases()
{
  std::vector<Case> cases;
  for (int dim : {2, 3})
    for (unsigned int degree : {1, 2})
      for (Target target : {Target::body, Target::itself, Target::plane, Target::sphere})
        cases.push_back({dim, degree, target, Integration::face_quadrature});
  for (Triangles triangles : {Triangles::both, Triangles::upper, Triangles::lower})
    for (unsigned int degree : {1, 2})
      cases.push_back({3, degree, Target::body, Integration::face_quadrature, Multipliers::none, triangles});
  return cases;
}

INSTANTIATE_TEST_SUITE_P(Step, StepLaws, testing::ValuesIn(make_cases()), NameCase());

/// Where the nodes of a scene were before a step: they slid, sank and bent in it.
template <typename Scene>
auto make_start(const Scene &scene)
{
  constexpr int dim = std::decay_t<decltype(scene.positions[0])>::RowsAtCompileTime;
  SpatialVector<dim> way = .02 * SpatialVector<dim>::Unit(dim - 1);
  way[0] = .03;
  RandomVectors<dim> random(11);
  return shifted<dim>(scene.moved(way), random.field(scene.positions.size(), 5e-3), 1.);
}

TEST_P(StepLaws, PairForcesHaveNoMomentAboutTheStart)
{
  on_scene(
      [](const auto &scene, auto dimension)
      {
        constexpr int dim = decltype(dimension)::value;
        if (!scene.is_between_bodies())
          return;
        auto potential = scene.make_potential();
        potential.update(scene.positions);
        potential.evaluate(scene.positions);
        const Positions<dim> start = make_start(scene);
        const auto before = compute_forces(potential, start.size());
        EXPECT_GT(measure_imbalance<dim>(start, before), 1e-4 * norm<dim>(before))
            << "the bodies do not slide";
        potential.linearize(start);
        auto forces = compute_forces(potential, start.size());
        EXPECT_GT(norm<dim>(forces), 0.);
        EXPECT_LT(measure_imbalance<dim>(start, forces), 1e-12 * norm<dim>(forces));

        potential.follow(RandomVectors<dim>(12).field(start.size(), 1e-3), 1e-3);
        forces = compute_forces(potential, start.size());
        potential.add_damping_forces(scene.zeros(), forces);
        EXPECT_LT(measure_imbalance<dim>(start, forces), 1e-12 * norm<dim>(forces));
      });
}

TEST_P(StepLaws, ForcesAreTheGradientOfTheEnergyThatFollows)
{
  on_scene(
      [](const auto &scene, auto dimension)
      {
        constexpr int dim = decltype(dimension)::value;
        constexpr double length = 1e-6;
        auto potential = scene.make_potential();
        potential.update(scene.positions);
        potential.evaluate(scene.positions);
        potential.linearize(make_start(scene));
        const auto forces = compute_forces(potential, scene.positions.size());
        RandomVectors<dim> random(13);
        for (unsigned int trial = 0; trial < 4; ++trial)
        {
          const auto way = shifted<dim>(scene.zeros(), random.field(scene.positions.size(), 1.), length);
          potential.follow(way, 1.);
          const double ahead = potential.energy();
          potential.follow(shifted<dim>(scene.zeros(), way, -2.), 1.);
          const double behind = potential.energy();
          potential.follow(way, 1.);
          EXPECT_NEAR((ahead - behind) / (2. * length), -dot<dim>(forces, way) / length,
                      1e-7 * norm<dim>(forces));
        }
      });
}

TEST_P(StepLaws, LinearPointsTellForcesAndDepths)
{
  on_scene(
      [](const auto &scene, auto dimension)
      {
        constexpr int dim = decltype(dimension)::value;
        auto potential = scene.make_potential();
        potential.update(scene.positions);
        potential.evaluate(scene.positions);
        const Positions<dim> start = make_start(scene);
        potential.linearize(start);
        auto forces = compute_forces(potential, start.size());
        std::vector<double> start_depths;
        potential.for_each_linear_point(0.,
                                        [&](const LinearPoint<dim> &point)
                                        {
                                          start_depths.push_back(point.start_depth);
                                          for (unsigned int a = 0; a < point.stencil.n_nodes; ++a)
                                            forces[point.stencil.node[a]] -=
                                                point.area * point.stiffness * point.depth *
                                                point.stencil.weight[a] * point.normal;
                                        });
        EXPECT_LT(norm<dim>(forces), 1e-12 * norm<dim>(compute_forces(potential, start.size())));
        ASSERT_GT(start_depths.size(), 1u);

        // Back at the start, every point is as deep as it was said to have been there.
        potential.follow(shifted<dim>(start, scene.positions, -1.), 1.);
        std::size_t n = 0;
        potential.for_each_linear_point(std::numeric_limits<double>::lowest(),
                                        [&](const LinearPoint<dim> &point)
                                        {
                                          EXPECT_NEAR(point.depth, point.start_depth, 1e-12);
                                          ++n;
                                        });
        EXPECT_GE(n, start_depths.size());
      });
}

TEST_P(StepLaws, DampingTakesThePowerOfTheWayInContact)
{
  on_scene(
      [](const auto &scene, auto dimension)
      {
        constexpr int dim = decltype(dimension)::value;
        constexpr double time_step = 1e-3;
        auto potential = scene.make_potential();
        potential.update(scene.positions);
        potential.evaluate(scene.positions);
        potential.linearize(make_start(scene));
        potential.follow(scene.zeros(), time_step);
        auto damping = scene.zeros();
        const double power = potential.add_damping_forces(scene.zeros(), damping);
        double expected = 0.;
        auto expected_forces = scene.zeros();
        potential.for_each_linear_point(
            0.,
            [&](const LinearPoint<dim> &point)
            {
              const double rate = (point.depth - std::max(point.start_depth, 0.)) / time_step;
              const double pressure = std::max(point.damping * rate, -point.stiffness * point.depth);
              expected += point.area * pressure * rate;
              for (unsigned int a = 0; a < point.stencil.n_nodes; ++a)
                expected_forces[point.stencil.node[a]] +=
                    point.area * pressure * point.stencil.weight[a] * point.normal;
            });
        EXPECT_GT(power, 0.);
        EXPECT_NEAR(power, expected, 1e-12 * power);
        EXPECT_LT(norm<dim>(shifted<dim>(damping, expected_forces, -1.)), 1e-12 * norm<dim>(damping));
      });
}

TEST_P(StepLaws, EvaluationEndsTheStep)
{
  on_scene(
      [](const auto &scene, auto dimension)
      {
        constexpr int dim = decltype(dimension)::value;
        auto potential = scene.make_potential();
        potential.update(scene.positions);
        potential.evaluate(scene.positions);
        const auto forces = compute_forces(potential, scene.positions.size());
        potential.linearize(make_start(scene));
        potential.follow(scene.zeros(), 1.);
        potential.evaluate(scene.positions);
        EXPECT_EQ(flatten<dim>(compute_forces(potential, scene.positions.size())), flatten<dim>(forces));
      });
}

/// One point of a box sank, in a step, beside the edge of another one: deeper below the face that it came
/// through than it is from the side face.
template <int dim>
void check_entry()
{
  Case c{dim, 1, Target::body, Integration::face_quadrature};
  PotentialScene<dim> scene(c, 2, 0.);
  auto potential = scene.make_potential();
  SpatialVector<dim> upwards = SpatialVector<dim>::Zero();
  upwards[dim - 1] = scene.overlap + .01;
  const Positions<dim> start = scene.moved(upwards);
  // Beside the edge by half of the way that it sank.
  SpatialVector<dim> aside = SpatialVector<dim>::Zero();
  aside[0] = -.1371 - .75 * .5 * .1127 + .5 * scene.overlap;
  auto at_end = scene.positions, at_start = start;
  for (std::size_t i = 0; i < at_end.size(); ++i)
    if (start[i] != scene.positions[i])
    {
      at_end[i] += aside;
      at_start[i] += aside;
    }
  potential.update(at_end);
  const auto count = [&](bool is_sideways)
  {
    unsigned int n = 0;
    potential.for_each_linear_point(1e-9, [&](const LinearPoint<dim> &point)
                                    { n += (std::abs(point.normal[0]) > .5) == is_sideways; });
    return n;
  };
  potential.evaluate(at_end);
  potential.linearize(at_start);
  EXPECT_GT(count(true), 0u);
  potential.evaluate(at_end);
  potential.find_entries(at_start);
  potential.linearize(at_start);
  EXPECT_EQ(count(true), 0u);
  EXPECT_GT(count(false), 0u);
  potential.for_each_linear_point(1e-9,
                                  [&](const LinearPoint<dim> &point)
                                  {
                                    EXPECT_LT(point.start_depth, -.009);
                                    EXPECT_NEAR(point.depth - point.start_depth, scene.overlap + .01, 1e-12);
                                  });
}

TEST(StepEntries, AreThroughTheFaceThatWasOutside)
{
  check_entry<2>();
  check_entry<3>();
}

/// A scene that rubs in a step from make_start() to its positions.
template <int dim>
struct RubbingStep
{
  static constexpr double least = -.2;

  RubbingStep(const PotentialScene<dim> &the_scene, double coefficient)
      : scene(the_scene), start(make_start(scene)), potential(scene.make_potential()),
        friction(potential, coefficient)
  {
    // The slip at the start is not zero.
    for (const double way : {2e-3, 0.})
    {
      potential.update(shifted<dim>(start, slide(), way));
      potential.evaluate(shifted<dim>(start, slide(), way));
      friction.evaluate(scene.zeros());
      friction.commit();
    }
    potential.update(scene.positions);
    potential.evaluate(scene.positions);
    potential.linearize(start);
    friction.linearize(least);
  }

  /// One body slides by one along x.
  Positions<dim> slide() const
  {
    return shifted<dim>(scene.moved(SpatialVector<dim>::Unit(0)), scene.positions, -1.);
  }

  void follow(const Positions<dim> &increments)
  {
    potential.follow(increments, 1e-3);
    friction.follow(increments);
  }

  Positions<dim> forces() const
  {
    Positions<dim> all = scene.zeros();
    friction.add_forces(all);
    return all;
  }

  PotentialScene<dim> scene;
  Positions<dim> start;
  ContactPotential<dim> potential;
  Friction<dim> friction;
};

constexpr double never_slides = 1e6; // coefficient of friction

TEST_P(StepLaws, TractionsHaveNoMomentAboutTheStart)
{
  on_scene(
      [](const auto &scene, auto dimension)
      {
        constexpr int dim = decltype(dimension)::value;
        if (!scene.is_between_bodies())
          return;
        for (const double coefficient : {.2, never_slides})
        {
          RubbingStep<dim> step(scene, coefficient);
          step.follow(RandomVectors<dim>(12).field(step.start.size(), 1e-3));
          const auto forces = step.forces();
          EXPECT_GT(norm<dim>(forces), 0.);
          EXPECT_LT(measure_imbalance<dim>(step.start, forces), 1e-12 * norm<dim>(forces));
        }
      });
}

TEST_P(StepLaws, TractionsOfStickAreTheGradientOfTheirEnergy)
{
  on_scene(
      [](const auto &scene, auto dimension)
      {
        constexpr int dim = decltype(dimension)::value;
        constexpr double length = 1e-6;
        RubbingStep<dim> step(scene, never_slides);
        step.follow(scene.zeros());
        const auto forces = step.forces();
        RandomVectors<dim> random(14);
        for (unsigned int trial = 0; trial < 4; ++trial)
        {
          const auto way = shifted<dim>(scene.zeros(), random.field(step.start.size(), 1.), length);
          const auto energy_at = [&](double factor)
          {
            step.friction.follow(shifted<dim>(scene.zeros(), way, factor));
            return step.friction.energy();
          };
          EXPECT_NEAR(energy_at(1.) - energy_at(-1.), -2. * dot<dim>(forces, way),
                      1e-7 * length * norm<dim>(forces));
        }
      });
}

/// To first order: the step is linear. What would be slip against the foot is of the order of depth × angle.
TEST_P(StepLaws, TurningTogetherIsNoSlip)
{
  on_scene(
      [](const auto &scene, auto dimension)
      {
        constexpr int dim = decltype(dimension)::value;
        constexpr double angle = 1e-5;
        if (!scene.is_between_bodies())
          return;
        RubbingStep<dim> step(scene, never_slides);
        step.follow(scene.zeros());
        const auto forces = step.forces();
        SpatialTensor<dim> spin = RandomVectors<dim>(15).rotation();
        spin = .5 * (spin - spin.transpose()).eval();
        auto turned = scene.zeros();
        for (std::size_t i = 0; i < turned.size(); ++i)
          turned[i] = angle * spin * step.start[i];
        // Points keep their depths too, so the same ones touch.
        step.follow(turned);
        EXPECT_LT(norm<dim>(shifted<dim>(step.forces(), forces, -1.)), 1e-11 * norm<dim>(forces));
      });
}

TEST_P(StepLaws, LinearSlipsTellTractions)
{
  on_scene(
      [](const auto &scene, auto dimension)
      {
        constexpr int dim = decltype(dimension)::value;
        constexpr double coefficient = .3;
        RubbingStep<dim> step(scene, coefficient);
        const auto increments = RandomVectors<dim>(16).field(step.start.size(), 1e-3);
        std::vector<LinearSlip<dim>> slips;
        step.friction.for_each_linear_point(std::numeric_limits<double>::lowest(),
                                            [&](const LinearPoint<dim> &point)
                                            { slips.push_back(point.slip); });
        step.follow(increments);
        auto expected = scene.zeros();
        std::size_t q = 0;
        double dissipated = 0.;
        step.potential.for_each_linear_point(
            std::numeric_limits<double>::lowest(),
            [&](const LinearPoint<dim> &point)
            {
              const LinearSlip<dim> &slip = slips.at(q++);
              SpatialVector<dim> trial = slip.trial;
              for (unsigned int a = 0; a < point.stencil.n_nodes; ++a)
              {
                const SpatialVector<dim> &moved = increments[point.stencil.node[a]];
                const double along = point.normal.dot(moved);
                trial += point.stencil.weight[a] * (moved - along * point.normal) + along * slip.levers[a];
              }
              const double pressure =
                  std::max(0., point.stiffness * point.depth +
                                   point.damping * (point.depth - std::max(point.start_depth, 0.)) / 1e-3);
              const CoulombLaw law{coefficient, point.stiffness};
              const SpatialVector<dim> elastic = law.find_elastic_slip(trial, pressure);
              dissipated += point.area * point.stiffness * elastic.dot(trial - elastic);
              for (unsigned int a = 0; a < point.stencil.n_nodes; ++a)
                expected[point.stencil.node[a]] -=
                    point.area * point.stiffness *
                    (point.stencil.weight[a] * elastic + slip.levers[a].dot(elastic) * point.normal);
            });
        EXPECT_EQ(q, slips.size());
        const auto forces = step.forces();
        EXPECT_LT(norm<dim>(shifted<dim>(forces, expected, -1.)), 1e-12 * norm<dim>(forces));
        EXPECT_GT(dissipated, 0.);
        EXPECT_NEAR(step.friction.commit(), dissipated, 1e-12 * dissipated);
      });
}
} // namespace
