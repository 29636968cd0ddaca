// SPDX-License-Identifier: LGPL-2.1-or-later
#include "contact_bodies.h"

#include "signorini/physics/dead_load.h"

using namespace signorini;
using namespace signorini::test;

namespace
{
/// An explicit solver over a built scene.
template <int dim>
struct Run
{
  explicit Run(BuiltScene<dim> &built_scene)
      : built(built_scene), solver(built.discretization, built.supports, built.scene.materials, built.forces,
                                   ExplicitParameters(), built.run_time)
  {
    solver.start(built.state);
  }

  /// Largest residual of the energy ledger over a number of steps.
  double advance(unsigned int n_steps, double time_step)
  {
    double largest = 0.;
    for (unsigned int step = 0; step < n_steps; ++step)
    {
      solver.step(time_step, built.state);
      solver.take_stock(built.state);
      largest = std::max(largest, std::abs(solver.energy().residual()));
    }
    return largest;
  }

  BuiltScene<dim> &built;
  ExplicitSolver<dim> solver;
};

template <typename T>
class Explicit : public testing::Test
{
};
TYPED_TEST_SUITE(Explicit, AllCases);

TYPED_TEST(Explicit, FreeBodyKeepsItsMomenta)
{
  constexpr int dim = TypeParam::dim;
  BuiltScene<dim> built({make_graded_cube()}, TypeParam::degree);
  built.state.velocity = built.random_vector(1.);
  Run<dim> run(built);
  run.advance(100, run.solver.stable_step());
  const MomentumLedger &momentum = run.solver.momentum();
  EXPECT_GT(momentum.linear_scale, 0.);
  EXPECT_GT(std::abs(momentum.angular[2]), 0.);
  EXPECT_LT(momentum.linear_drift(), 1e-13);
  EXPECT_LT(momentum.angular_drift(), 1e-13);
  EXPECT_GT(run.solver.energy().elastic, 0.);
}

TYPED_TEST(Explicit, GradedBallKeepsItsAngularMomentum)
{
  constexpr int dim = TypeParam::dim;
  BuiltScene<dim> built({graded(make_ball("ball", 1., 0), {1., 0., 0.}, 1, .8)}, TypeParam::degree);
  ASSERT_FALSE(built.discretization.hanging_dofs.empty());
  built.state.velocity = built.random_vector(1.);
  Run<dim> run(built);
  run.advance(50, run.solver.stable_step());
  EXPECT_LT(run.solver.momentum().linear_drift(), 1e-13);
  EXPECT_LT(run.solver.momentum().angular_drift(), 1e-13);
}

TYPED_TEST(Explicit, BodiesInDampedContactKeepTheirMomenta)
{
  constexpr int dim = TypeParam::dim;
  BuiltScene<dim> built(make_overlapping_bodies<dim>(.02), TypeParam::degree);
  contact::PotentialSettings settings = make_settings(contact::Integration::face_quadrature);
  settings.damping_ratio = .2;
  built.add_contact(settings);
  built.state.velocity = built.random_vector(.3);
  Run<dim> run(built);
  run.advance(100, run.solver.stable_step());
  EXPECT_LT(run.solver.momentum().linear_drift(), 1e-13);
  EXPECT_LT(run.solver.momentum().angular_drift(), 1e-12);
  EXPECT_GT(run.solver.energy().dissipated, 0.);
}

TYPED_TEST(Explicit, LedgerDriftIsSecondOrderInTheStep)
{
  constexpr int dim = TypeParam::dim;
  std::array<double, 2> drift;
  for (unsigned int halving = 0; halving < 2; ++halving)
  {
    BuiltScene<dim> built({make_graded_cube()}, TypeParam::degree);
    built.state.velocity = built.random_vector(.5);
    Run<dim> run(built);
    drift[halving] = run.advance(100 << halving, run.solver.stable_step() / (5 << halving));
  }
  EXPECT_LT(drift[1], .01);
  EXPECT_GT(drift[0] / drift[1], 3.4);
  EXPECT_LT(drift[0] / drift[1], 4.6);
}

TYPED_TEST(Explicit, LedgerClosesWithTheStepWhereABodyYields)
{
  constexpr int dim = TypeParam::dim;
  std::array<double, 2> drift;
  for (unsigned int halving = 0; halving < 2; ++halving)
  {
    BodyParameters cube = make_graded_cube();
    cube.material.model = Model::plastic;
    cube.material.yield_stress = 10.;
    cube.material.hardening_modulus = 100.;
    BuiltScene<dim> built({cube}, TypeParam::degree);
    built.state.velocity = built.random_vector(.5);
    Run<dim> run(built);
    drift[halving] = run.advance(100 << halving, run.solver.stable_step() / (5 << halving));
    EXPECT_GT(run.solver.energy().plastic_work, .1 * run.solver.energy().largest);
    EXPECT_LT(run.solver.momentum().linear_drift(), 1e-13);
    EXPECT_LT(run.solver.momentum().angular_drift(), 1e-13);
  }
  EXPECT_LT(drift[1], .005);
  EXPECT_GT(drift[0] / drift[1], 1.8);
}

TYPED_TEST(Explicit, LedgerOfContactOnAFloorClosesToSecondOrder)
{
  constexpr int dim = TypeParam::dim;
  std::array<double, 2> drift;
  for (unsigned int halving = 0; halving < 2; ++halving)
  {
    BuiltScene<dim> built({make_graded_cube()}, TypeParam::degree,
                          [](Parameters &p)
                          {
                            p.gravity[dim - 1] = -3.;
                            p.obstacles = {make_floor<dim>(.002)};
                          });
    contact::PotentialSettings settings = make_settings(contact::Integration::face_quadrature);
    settings.damping_ratio = .3;
    built.add_contact(settings);
    built.forces.loads.push_back(
        std::make_shared<DeadLoad<dim>>(built.scene, built.discretization, WeightShares::lumped_mass));
    Run<dim> run(built);
    drift[halving] = run.advance(150 << halving, run.solver.stable_step() / (4 << halving));
    EXPECT_GT(run.solver.energy().dissipated, 0.);
    EXPECT_NE(run.solver.energy().work_of_loads, 0.);
    EXPECT_LT(run.solver.momentum().linear_drift(), 1e-12);
    EXPECT_LT(run.solver.momentum().angular_drift(), 1e-12);
  }
  EXPECT_LT(drift[1], .01);
  // Points that touch and part spoil the order a little.
  EXPECT_GT(drift[0] / drift[1], 1.8);
}

template <int dim>
void add_friction(BuiltScene<dim> &built, double coefficient)
{
  contact::PotentialSettings settings = make_settings(contact::Integration::face_quadrature);
  settings.damping_ratio = .3;
  built.forces.frictions.push_back(std::make_shared<FrictionForce<dim>>(
      *built.add_contact(settings), coefficient, contact::SlidUnder::mean_traction, MPI_COMM_WORLD));
}

TYPED_TEST(Explicit, BodiesThatRubKeepTheirMomenta)
{
  constexpr int dim = TypeParam::dim;
  for (const double coefficient : {.3, 1e6})
  {
    BuiltScene<dim> built(make_overlapping_bodies<dim>(.02), TypeParam::degree);
    add_friction(built, coefficient);
    built.state.velocity = built.random_vector(.3);
    Run<dim> run(built);
    run.advance(100, run.solver.stable_step());
    EXPECT_LT(run.solver.momentum().linear_drift(), 1e-13);
    EXPECT_LT(run.solver.momentum().angular_drift(), 1e-12);
    EXPECT_GT(run.solver.energy().rubbed_off, 0.);
  }
}

TYPED_TEST(Explicit, LedgerOfABlockThatStartsToSlideClosesToSecondOrder)
{
  constexpr int dim = TypeParam::dim;
  std::array<double, 2> drift;
  for (unsigned int halving = 0; halving < 2; ++halving)
  {
    BuiltScene<dim> built({make_graded_cube()}, TypeParam::degree,
                          [](Parameters &p)
                          {
                            p.gravity[0] = 2.;
                            p.gravity[dim - 1] = -3.;
                            p.obstacles = {make_floor<dim>(.002)};
                          });
    add_friction(built, .4);
    built.forces.loads.push_back(
        std::make_shared<DeadLoad<dim>>(built.scene, built.discretization, WeightShares::lumped_mass));
    Run<dim> run(built);
    drift[halving] = run.advance(150 << halving, run.solver.stable_step() / (4 << halving));
    EXPECT_GT(run.solver.energy().rubbed_off, 0.);
    EXPECT_GE(run.solver.energy().contact, built.forces.frictions[0]->energy());
    EXPECT_LT(run.solver.momentum().linear_drift(), 1e-12);
    EXPECT_LT(run.solver.momentum().angular_drift(), 1e-12);
  }
  EXPECT_LT(drift[1], .01);
  EXPECT_GT(drift[0] / drift[1], 1.8);
}

TYPED_TEST(Explicit, FreeFallIsExact)
{
  constexpr int dim = TypeParam::dim;
  BuiltScene<dim> built({make_graded_cube()}, TypeParam::degree,
                        [](Parameters &p) {
                          p.gravity = {1., -3., 2.};
                        });
  built.forces.loads.push_back(
      std::make_shared<DeadLoad<dim>>(built.scene, built.discretization, WeightShares::lumped_mass));
  const SpatialVector<dim> start = SpatialVector<dim>::Constant(.4);
  built.state.velocity = built.interpolate([&](const SpatialVector<dim> &) { return start; });
  Run<dim> run(built);
  run.advance(60, run.solver.stable_step());
  const double t = built.state.time;
  for (const OwnedNode<dim> &node : built.discretization.owned_nodes)
    for (unsigned int d = 0; d < dim; ++d)
    {
      EXPECT_NEAR(built.state.displacement.local_element(node.dofs[d]),
                  .4 * t + .5 * built.scene.gravity[d] * t * t, 1e-11);
      EXPECT_NEAR(built.state.velocity.local_element(node.dofs[d]), .4 + built.scene.gravity[d] * t, 1e-11);
    }
  EXPECT_LT(std::abs(run.solver.energy().residual()), 1e-12);
  EXPECT_LT(run.solver.momentum().linear_drift(), 1e-13);
  EXPECT_LT(run.solver.momentum().angular_drift(), 1e-13);
}

TYPED_TEST(Explicit, WorkOfMovingSupportsIsTheEnergyGained)
{
  constexpr int dim = TypeParam::dim;
  BodyParameters body = make_graded_cube({1., 1., 1.});
  body.supports = {make_support("left", {"0", "0", "0"}),
                   make_support("right", {".05*(1-cos(2*t))", {}, {}})};
  std::array<double, 2> drift;
  for (unsigned int halving = 0; halving < 2; ++halving)
  {
    BuiltScene<dim> built({body}, TypeParam::degree);
    Run<dim> run(built);
    const double time_step = run.solver.stable_step() / (3 << halving);
    drift[halving] = run.advance(static_cast<unsigned int>(.7 / time_step), time_step);
    const EnergyLedger &energy = run.solver.energy();
    EXPECT_GT(energy.work_of_supports, .01);
    EXPECT_NEAR(energy.work_of_supports, energy.kinetic + energy.elastic, .01 * energy.work_of_supports);
    EXPECT_LT(run.solver.momentum().linear_drift(), 1e-12);
    EXPECT_LT(run.solver.momentum().angular_drift(), 1e-12);
  }
  EXPECT_LT(drift[1], drift[0] / 1.8);
}

TYPED_TEST(Explicit, WorkOfMovingObstaclesIsTheEnergyGained)
{
  constexpr int dim = TypeParam::dim;
  std::array<double, 2> drift;
  for (unsigned int halving = 0; halving < 2; ++halving)
  {
    BuiltScene<dim> built({make_graded_cube()}, TypeParam::degree,
                          [](Parameters &p)
                          {
                            p.obstacles = {make_floor<dim>(.002)};
                            p.obstacles[0].displacement.assign(dim, "0");
                            p.obstacles[0].displacement[0] = ".1*t"; // along the floor: no work
                            p.obstacles[0].displacement[dim - 1] = ".2*t^2";
                          });
    contact::PotentialSettings settings = make_settings(contact::Integration::face_quadrature);
    settings.damping_ratio = .3;
    built.add_contact(settings);
    Run<dim> run(built);
    const double time_step = run.solver.stable_step() / (4 << halving);
    drift[halving] = run.advance(static_cast<unsigned int>(.8 / time_step), time_step);
    const EnergyLedger &energy = run.solver.energy();
    EXPECT_GT(energy.dissipated, 0.);
    EXPECT_GT(energy.work_of_obstacles, .01);
    EXPECT_NEAR(energy.work_of_obstacles + energy.initial,
                energy.kinetic + energy.elastic + energy.contact + energy.dissipated,
                .01 * energy.work_of_obstacles);
    EXPECT_LT(run.solver.momentum().linear_drift(), 1e-12);
    EXPECT_LT(run.solver.momentum().angular_drift(), 1e-12);
  }
  EXPECT_LT(drift[1], .01);
  EXPECT_GT(drift[0] / drift[1], 1.8);
}

TYPED_TEST(Explicit, SupportsCarryABodyWithTheWorkOfItsKineticEnergy)
{
  constexpr int dim = TypeParam::dim;
  if (TypeParam::degree == 2)
    return; // has a node that is not supported
  BodyParameters body = make_box("body", {1., 1., 1.}, {1, 1, 1});
  body.supports = {make_support("left", {".3*t", "-.4*t", {}}), make_support("right", {".3*t", "-.4*t", {}})};
  BuiltScene<dim> built({body}, 1);
  Run<dim> run(built);
  run.advance(10, .5 * run.solver.stable_step());
  EXPECT_NEAR(run.solver.energy().work_of_supports, .5 * body.material.density * .25, 1e-12);
  EXPECT_NEAR(run.solver.energy().imbalance(), 0., 1e-12);
  EXPECT_NEAR(run.solver.momentum().linear_impulse[0], body.material.density * .3, 1e-12);
  EXPECT_NEAR(run.solver.momentum().linear_impulse[1], body.material.density * -.4, 1e-12);
}
} // namespace
