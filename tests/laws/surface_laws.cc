// SPDX-License-Identifier: LGPL-2.1-or-later
// The laws of damping and samples; contact_laws.cc says on which scenes.
#include "law_suites.h"

#include <map>

using namespace signorini;
using namespace signorini::contact;
using namespace signorini::test;

TEST_P(SurfaceLaws, DampingActsEquallyOnBothBodies)
{
  on_scene(
      [](const auto &scene, auto dimension)
      {
        constexpr int dim = decltype(dimension)::value;
        if (!scene.is_between_bodies())
          return;
        auto potential = evaluate(scene);
        RandomVectors<dim> random(3);
        auto damping_forces = scene.zeros();
        potential.add_damping_forces(random.field(scene.positions.size(), 1.), damping_forces);
        EXPECT_GT(norm<dim>(damping_forces), 0.);
        EXPECT_LT(measure_imbalance<dim>(scene.positions, damping_forces), 1e-12 * norm<dim>(damping_forces));
      });
}

TEST_P(SurfaceLaws, OnlyNearPointsAreSampledAndNoneDampedAtADistance)
{
  on_scene(
      [](const auto &scene, auto dimension)
      {
        constexpr int dim = decltype(dimension)::value;
        for (double gap : {.05, 10.})
        {
          const auto apart = scene.moved((.15 + gap) * SpatialVector<dim>::Unit(dim - 1));
          auto potential = scene.make_potential();
          potential.update(apart);
          potential.evaluate(apart);
          auto forces = scene.zeros();
          EXPECT_EQ(potential.add_damping_forces(scene.positions, forces), 0.);
          EXPECT_EQ(norm<dim>(forces), 0.);
          EXPECT_EQ(!potential.samples().empty(), gap < 1.);
          for (const auto &sample : potential.samples())
            EXPECT_LT(sample.depth, 0.);
        }
      });
}

TEST_P(SurfaceLaws, DampingOnlyDissipates)
{
  on_scene(
      [](const auto &scene, auto dimension)
      {
        constexpr int dim = decltype(dimension)::value;
        auto potential = evaluate(scene);
        RandomVectors<dim> random(6);
        for (double speed : {1e-3, 1., 1e3})
        {
          const auto velocities = random.field(scene.positions.size(), speed);
          auto forces = scene.zeros();
          const double power = potential.add_damping_forces(velocities, forces);
          EXPECT_GT(power, 0.);
          EXPECT_NEAR(power, -dot<dim>(forces, velocities),
                      1e-12 * norm<dim>(forces) * norm<dim>(velocities));
        }
        auto undamped_scene = scene;
        undamped_scene.settings.damping_ratio.reset();
        auto undamped = undamped_scene.make_potential();
        undamped.update(scene.positions);
        undamped.evaluate(scene.positions);
        auto forces = scene.zeros();
        EXPECT_EQ(undamped.add_damping_forces(scene.positions, forces), 0.);
        EXPECT_EQ(norm<dim>(forces), 0.);
      });
}

TEST_P(SurfaceLaws, AllForcesAndMeasuresComeInOnePass)
{
  on_scene(
      [](const auto &scene, auto dimension)
      {
        constexpr int dim = decltype(dimension)::value;
        auto potential = evaluate(scene);
        const auto measures = potential.measure();
        const auto velocities = RandomVectors<dim>(6).field(scene.positions.size(), 1.);
        auto forces = scene.zeros(), damping_forces = scene.zeros();
        potential.add_all_forces(velocities, forces, damping_forces);
        EXPECT_EQ(potential.measure().n_active, measures.n_active);
        EXPECT_EQ(potential.measure().max_pressure, measures.max_pressure);
        EXPECT_GT(norm<dim>(damping_forces), 0.);
        auto one_by_one = scene.zeros(), damping_alone = scene.zeros();
        potential.add_forces(one_by_one);
        potential.add_damping_forces(velocities, damping_alone);
        EXPECT_EQ(forces, one_by_one);
        EXPECT_EQ(damping_forces, damping_alone);

        potential.set_penalty_factor(2. * scene.settings.penalty_factor);
        EXPECT_GT(potential.measure().max_pressure, measures.max_pressure); // those of the forces are old
      });
}

TEST_P(SurfaceLaws, TheConvexTangentIsThatOfSquaredRatesOfDepth)
{
  on_scene(
      [](const auto &scene, auto dimension)
      {
        constexpr int dim = decltype(dimension)::value;
        constexpr double step = 1e-7;
        auto potential = scene.make_potential();
        potential.update(scene.positions);
        const auto direction = RandomVectors<dim>(4).field(scene.positions.size(), 1.);
        const auto depths_at = [&](double t)
        {
          potential.evaluate(shifted<dim>(scene.positions, direction, t));
          std::map<std::size_t, double> depths;
          potential.for_each_overlap_above(-1e-3,
                                           [&](const auto &near) { depths[near.index] = near.foot.depth; });
          return depths;
        };
        const auto after = depths_at(step), before = depths_at(-step);
        potential.evaluate(scene.positions);
        double expected = 0.;
        potential.for_each_overlap_above(0.,
                                         [&](const auto &near)
                                         {
                                           const double rate =
                                               (after.at(near.index) - before.at(near.index)) / (2. * step);
                                           expected += near.pair.area * near.pair.stiffness * rate * rate;
                                         });
        Eigen::MatrixXd tangent = make_square<dim>(scene.positions.size());
        potential.for_each_tangent([&](const auto &nodes, const Eigen::MatrixXd &block)
                                   { add_block<dim>(nodes, block, tangent); },
                                   true);
        const Eigen::VectorXd u = flatten<dim>(direction);
        EXPECT_GT(expected, 0.);
        EXPECT_NEAR(u.dot(tangent * u), expected, 1e-5 * expected);
      });
}

/// Towards contact nothing is clipped, and the damping force is linear in the velocities.
TEST_P(SurfaceLaws, RowSumsBoundDamping)
{
  on_scene(
      [](const auto &scene, auto dimension)
      {
        constexpr int dim = decltype(dimension)::value;
        auto potential = evaluate(scene);
        const std::size_t n = scene.positions.size();
        std::vector<double> stiffness(n, 0.), damping(n, 0.);
        potential.add_row_sum_bounds(stiffness, damping);
        RandomVectors<dim> random(8);
        const double damping_bound = *std::max_element(damping.begin(), damping.end());
        const auto velocities = random.field(n, 1e-9);
        auto forces = scene.zeros();
        potential.add_damping_forces(velocities, forces);
        EXPECT_GT(norm<dim>(forces), 0.);
        EXPECT_LE(norm<dim>(forces), damping_bound * norm<dim>(velocities));
      });
}
