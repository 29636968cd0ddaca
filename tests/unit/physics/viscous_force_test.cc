// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/physics/momentum.h"
#include "signorini/physics/viscous_force.h"

#include "built_scene.h"

#include <cmath>
#include <numeric>

using namespace signorini;
using namespace signorini::test;

namespace
{
constexpr double viscosity = 3.;

template <typename T>
class Viscosity : public testing::Test
{
};
TYPED_TEST_SUITE(Viscosity, AllCases);

BodyParameters with_viscosity(BodyParameters body, Model model, double eta = viscosity)
{
  body.material.model = model;
  body.material.viscosity = eta;
  return body;
}

/// Force of the viscosity at the built state on free entries.
template <int dim>
Vector force_at(const BuiltScene<dim> &built)
{
  const ViscousForce<dim> viscous(built.scene.materials, built.discretization);
  Vector force = built.discretization.make_vector();
  viscous.add_force(built.state, built.state.velocity, force);
  built.discretization.collect(force);
  return force;
}

template <int dim>
Vector linear_field(const BuiltScene<dim> &built, const SpatialTensor<dim> &gradient)
{
  return built.interpolate([&](const SpatialVector<dim> &x) { return SpatialVector<dim>(gradient * x); });
}

/// With entries from −1 to 1, always the same.
template <int dim>
SpatialTensor<dim> some_tensor(unsigned int seed)
{
  SpatialTensor<dim> tensor;
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j)
      tensor(i, j) = std::sin(7. * i + 3. * j + seed);
  return tensor;
}

TYPED_TEST(Viscosity, DissipatesByTheDeviatorOfTheStrainRate)
{
  constexpr int dim = TypeParam::dim;
  for (const Model model : {Model::linear_elastic, Model::neo_hookean})
    for (const BodyParameters &body :
         {make_graded_cube(), make_simplex_box("cut", dim, {1., 1., 1.}, {2, 2, 2})})
    {
      BuiltScene<dim> built({with_viscosity(body, model)}, TypeParam::degree);
      const SpatialTensor<dim> H = .2 * some_tensor<dim>(1), rate = some_tensor<dim>(2);
      built.state.displacement = linear_field(built, H);
      built.state.velocity = linear_field(built, rate);
      const SpatialTensor<dim> F = SpatialTensor<dim>::Identity() +
                                   (model == Model::neo_hookean ? H : SpatialTensor<dim>::Zero().eval()),
                               product = F.transpose() * rate,
                               strain_rate = .5 * (product + product.transpose());
      const double exact =
          2. * viscosity * (strain_rate.squaredNorm() - std::pow(strain_rate.trace(), 2) / 3.);
      EXPECT_NEAR(-(force_at(built) * built.state.velocity), exact, 1e-11 * exact);
    }
}

TYPED_TEST(Viscosity, RigidMotionMeetsNoResistance)
{
  constexpr int dim = TypeParam::dim;
  BuiltScene<dim> built({with_viscosity(make_graded_cube(), Model::neo_hookean)}, TypeParam::degree);
  SpatialTensor<dim> rotation = SpatialTensor<dim>::Identity(), spin = SpatialTensor<dim>::Zero();
  rotation(0, 0) = rotation(1, 1) = std::cos(1.2);
  rotation(1, 0) = std::sin(1.2);
  rotation(0, 1) = -std::sin(1.2);
  spin(1, 0) = 2.;
  spin(0, 1) = -2.;
  built.state.displacement = linear_field<dim>(built, rotation - SpatialTensor<dim>::Identity());
  built.state.velocity = built.random_vector(1.);
  const double scale = force_at(built).l2_norm();
  ASSERT_GT(scale, 0.);
  built.state.velocity = linear_field<dim>(built, spin * rotation);
  EXPECT_LT(force_at(built).l2_norm(), 1e-13 * scale);
}

TYPED_TEST(Viscosity, ForcesAndMomentsBalanceAndOnlyBodiesWithAViscosityFeelThem)
{
  constexpr int dim = TypeParam::dim;
  BuiltScene<dim> built(
      {with_viscosity(make_graded_cube(), Model::neo_hookean), make_box("other", {1., 1., 1.}, {1, 1, 1})},
      TypeParam::degree);
  built.state.displacement = built.random_vector(.05);
  built.state.velocity = built.random_vector(1., 2);
  const Vector force = force_at(built);
  const VectorAndMoment sum = sum_over_nodes(built.discretization, built.state.displacement, force);
  for (unsigned int d = 0; d < 3; ++d)
  {
    EXPECT_NEAR(sum.vector[d], 0., 1e-12 * sum.vector_scale);
    EXPECT_NEAR(sum.moment[d], 0., 1e-12 * sum.moment_scale);
  }
  for (const OwnedNode<dim> &node : built.discretization.owned_nodes)
    for (const unsigned int dof : node.dofs)
      EXPECT_TRUE(node.body == 0 || force.local_element(dof) == 0.);
  EXPECT_LT(force * built.state.velocity, 0.);
}

TYPED_TEST(Viscosity, DampingMatrixGivesTheForce)
{
  constexpr int dim = TypeParam::dim;
  BuiltScene<dim> built({with_viscosity(make_graded_cube(), Model::neo_hookean)}, TypeParam::degree);
  built.state.displacement = built.random_vector(.05);
  built.state.velocity = built.random_vector(1., 2);
  const ViscousForce<dim> viscous(built.scene.materials, built.discretization);
  Vector product = built.discretization.make_vector();
  std::vector<unsigned int> all_cells(built.discretization.cells.n_cells);
  std::iota(all_cells.begin(), all_cells.end(), 0u);
  viscous.for_each_damping(all_cells, built.state,
                           [&](unsigned int cell, const std::vector<double> &damping)
                           {
                             const unsigned int n = built.discretization.cells.n_cell_dofs(cell),
                                                *dofs = built.discretization.cells.cell_dofs(cell);
                             for (unsigned int i = 0; i < n; ++i)
                               for (unsigned int j = 0; j < n; ++j)
                               {
                                 EXPECT_NEAR(damping[i * n + j], damping[j * n + i], 1e-12 * viscosity);
                                 product.local_element(dofs[i]) -=
                                     damping[i * n + j] * built.state.velocity.local_element(dofs[j]);
                               }
                           });
  built.discretization.collect(product);
  product -= force_at(built);
  EXPECT_LT(product.l2_norm(), 1e-12 * force_at(built).l2_norm());
}

/// One free cell that is strained with random velocities, n_steps of a share of the stable step; the largest
/// energy it then has, over that at the start, and the residual of its ledger.
template <int dim>
std::pair<double, double> shake(double eta, double step_over_stable, unsigned int n_steps)
{
  BuiltScene<dim> built(
      {with_viscosity(make_box("cell", {1., 1., 1.}, {1, 1, 1}), Model::linear_elastic, eta)}, 1);
  built.forces.viscosities.push_back(
      std::make_shared<ViscousForce<dim>>(built.scene.materials, built.discretization));
  built.state.velocity = built.random_vector(1e-3);
  ExplicitParameters parameters;
  parameters.bulk_step_factor = 1.;
  ExplicitSolver<dim> solver(built.discretization, built.supports, built.scene.materials, built.forces,
                             parameters, built.run_time);
  solver.start(built.state);
  const double time_step = step_over_stable * solver.stable_step();
  for (unsigned int step = 0; step < n_steps; ++step)
    solver.step(time_step, built.state);
  solver.take_stock(built.state);
  const EnergyLedger &energy = solver.energy();
  EXPECT_LT(solver.momentum().linear_drift(), 1e-12);
  return {energy.stored() / energy.initial, energy.residual()};
}

TYPED_TEST(Viscosity, StepIsStableUpToItsBound)
{
  constexpr int dim = TypeParam::dim;
  for (const double eta : {.3, 30., 3000.})
    EXPECT_LT((shake<dim>(eta, .98, 600).first), 1.) << eta;
  // The bound is sharp where one of its two parts rules; between, their modes are not the same.
  EXPECT_FALSE((shake<dim>(3000., 1.05, 600).first) < 10.);
}

TYPED_TEST(Viscosity, DissipationClosesTheLedger)
{
  constexpr int dim = TypeParam::dim;
  const double coarse = shake<dim>(2., .1, 100).second, fine = shake<dim>(2., .05, 200).second;
  EXPECT_LT(std::abs(coarse), .02);
  EXPECT_LT(std::abs(fine), std::abs(coarse) / 1.8);
}

/// Shear of a column that is held from widening: u = sin(πy/2L), a damped oscillator of known frequency and
/// decay.
TYPED_TEST(Viscosity, DampsAShearWaveAtTheExactRate)
{
  constexpr int dim = TypeParam::dim;
  constexpr double pi = 3.14159265358979323846;
  constexpr unsigned int n_cells = TypeParam::degree == 1 ? 12 : 6;
  std::array<unsigned int, 3> cells{1, 1, 1};
  cells[dim - 1] = n_cells;
  const double eta = 4.;
  BodyParameters body =
      with_viscosity(make_box("column", {.3, dim == 2 ? 1. : .3, 1.}, cells), Model::linear_elastic, eta);
  std::array<std::optional<std::string>, 3> held{"0", "0", "0"}, only_shear{std::nullopt, "0", "0"};
  body.supports = {make_support("bottom", held)};
  for (const char *const side : {"left", "right", "front", "back", "top"})
    if (dim == 3 || (std::string(side) != "front" && std::string(side) != "back"))
      body.supports.push_back(make_support(side, only_shear));
  BuiltScene<dim> built({body}, TypeParam::degree);
  built.forces.viscosities.push_back(
      std::make_shared<ViscousForce<dim>>(built.scene.materials, built.discretization));
  const auto shape = [](const SpatialVector<dim> &x)
  { return SpatialVector<dim>(std::sin(.5 * pi * x[dim - 1]) * SpatialVector<dim>::Unit(0)); };
  built.state.velocity = built.interpolate(shape);
  built.state.velocity *= 1e-3;
  ExplicitSolver<dim> solver(built.discretization, built.supports, built.scene.materials, built.forces,
                             ExplicitParameters(), built.run_time);
  solver.start(built.state);
  const MaterialParameters &material = body.material;
  const double k = .5 * pi, mu = material.youngs_modulus / (2. * (1. + material.poissons_ratio)),
               decay = eta * k * k / (2. * material.density),
               frequency = std::sqrt(mu * k * k / material.density - decay * decay);
  const double end = 1.5 * pi / frequency; // one and a half half-waves: the largest of the other side
  const unsigned int n_steps = 1 + static_cast<unsigned int>(2. * end / solver.stable_step());
  for (unsigned int step = 0; step < n_steps; ++step)
    solver.step(end / n_steps, built.state);
  Vector exact = built.interpolate(shape);
  exact *= -1e-3 / frequency * std::exp(-decay * end);
  Vector difference = built.state.displacement;
  difference -= exact;
  EXPECT_LT(difference.l2_norm(), .02 * exact.l2_norm());
  EXPECT_GT(std::exp(-decay * end), .2);
  EXPECT_LT(std::exp(-decay * end), .8);
}
} // namespace
