// SPDX-License-Identifier: LGPL-2.1-or-later
// What holds for the contact potential in an implicit step, where depths are linear in the positions.
#include "law_suites.h"

using namespace signorini;
using namespace signorini::contact;
using namespace signorini::test;

namespace
{
INSTANTIATE_TEST_SUITE_P(Step, StepLaws, testing::ValuesIn(make_cases_of_points()), NameCase());

TEST_P(StepLaws, PairForcesHaveNoMomentAboutTheStart)
{
  on_scene(
      [](const auto &scene, auto dimension)
      {
        constexpr int dim = decltype(dimension)::value;
        if (!scene.is_between_bodies())
          return;
        auto potential = evaluate(scene);
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
        auto potential = evaluate(scene);
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
        auto potential = evaluate(scene);
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
        auto potential = evaluate(scene);
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
        auto potential = evaluate(scene);
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
} // namespace
