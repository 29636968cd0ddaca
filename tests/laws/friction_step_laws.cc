// SPDX-License-Identifier: LGPL-2.1-or-later
// What holds for friction in an implicit step, where slips are linear in the positions.
#include "rubbing.h"

using namespace signorini;
using namespace signorini::contact;
using namespace signorini::test;

namespace
{
/// A scene that rubs in a step from make_start() to its positions.
template <int dim>
struct RubbingStep
{
  static constexpr double least = -.2;

  RubbingStep(const PotentialScene<dim> &the_scene, double coefficient)
      : scene(the_scene), start(make_start(scene)), potential(scene.make_potential()),
        friction(potential, coefficient, SlidUnder::last_traction)
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
    friction.linearize(least, start);
  }

  /// One body slides by one along x.
  Positions<dim> slide() const
  {
    return shifted<dim>(scene.moved(SpatialVector<dim>::Unit(0)), scene.positions, -1.);
  }

  void follow(const Positions<dim> &increments, double time_step = 1e-3)
  {
    potential.follow(increments, time_step);
    friction.follow();
  }

  Positions<dim> forces() const { return compute_forces(friction, start.size()); }

  PotentialScene<dim> scene;
  Positions<dim> start;
  ContactPotential<dim> potential;
  Friction<dim> friction;
};

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
          const auto energy_after = [&](double factor)
          {
            step.follow(shifted<dim>(scene.zeros(), way, factor));
            return step.friction.energy();
          };
          const double ahead = energy_after(1.), behind = energy_after(-2.);
          step.follow(way);
          EXPECT_NEAR(ahead - behind, -2. * dot<dim>(forces, way), 1e-7 * length * norm<dim>(forces));
        }
      });
}

TEST_P(StepLaws, TangentOfTractionsIsTheirDerivative)
{
  on_scene(
      [](const auto &scene, auto dimension)
      {
        constexpr int dim = decltype(dimension)::value;
        constexpr double length = 1e-6;
        for (const double coefficient : {.2, never_slides})
        {
          constexpr double no_damping = 1e12; // time step
          RubbingStep<dim> step(scene, coefficient);
          step.follow(scene.zeros(), no_damping);
          RandomVectors<dim> random(16);
          for (unsigned int trial = 0; trial < 4; ++trial)
          {
            const auto way = shifted<dim>(scene.zeros(), random.field(step.start.size(), 1.), length);
            const auto predicted = apply_tangent<dim>(step.friction, way);
            step.follow(way, no_damping);
            const auto ahead = step.forces();
            step.follow(shifted<dim>(scene.zeros(), way, -2.), no_damping);
            const auto difference = shifted<dim>(ahead, step.forces(), -1.);
            step.follow(way, no_damping);
            EXPECT_GT(norm<dim>(predicted), 0.);
            EXPECT_LT(norm<dim>(shifted<dim>(difference, predicted, -2.)), 1e-6 * norm<dim>(predicted));
          }
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
