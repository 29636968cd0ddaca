// SPDX-License-Identifier: LGPL-2.1-or-later
#include "contact_bodies.h"

#include "signorini/physics/dead_load.h"
#include "signorini/simulation/held_bodies.h"

using namespace signorini;
using namespace signorini::test;

namespace
{
/// A quasi-static solver over a built scene whose forces are complete.
template <int dim>
struct StaticRun
{
  explicit StaticRun(BuiltScene<dim> &built_scene, const QuasiStaticParameters &parameters = {})
      : built(built_scene),
        solver(built.discretization, built.supports, built.scene,
               find_held_bodies(built.scene, built.supports), built.forces,
               built.forces.contacts.empty() ? nullptr : &built.map, parameters, built.run_time)
  {
  }

  bool solve(double time)
  {
    return solver.solve(time, built.state, [](const NewtonReport &) {});
  }

  BuiltScene<dim> &built;
  QuasiStaticSolver<dim> solver;
};

template <int dim>
void add_loads(BuiltScene<dim> &built)
{
  built.forces.loads.push_back(
      std::make_shared<DeadLoad<dim>>(built.scene, built.discretization, WeightShares::shape_integrals));
}

/// Symmetry planes on the lower sides, so that the body is free to shorten and widen.
template <int dim>
std::vector<SupportParameters> symmetry_supports()
{
  std::vector<SupportParameters> supports{make_support("left", {"0", {}, {}})};
  if (dim == 3)
    supports.push_back(make_support("front", {std::nullopt, "0", {}}));
  std::array<std::optional<std::string>, 3> last;
  last[dim - 1] = "0";
  supports.push_back(make_support("bottom", last));
  return supports;
}

template <int dim>
LoadParameters make_pressure(const std::string &pressure)
{
  LoadParameters load;
  load.boundary = "top";
  load.traction[dim - 1] = "-(" + pressure + ")";
  return load;
}

template <typename T>
class QuasiStatic : public testing::Test
{
};
TYPED_TEST_SUITE(QuasiStatic, AllCases);

TYPED_TEST(QuasiStatic, LinearBlockUnderPressureIsExact)
{
  constexpr int dim = TypeParam::dim;
  BodyParameters block = make_graded_cube({1., 1., 1.});
  block.material = make_material(Model::linear_elastic);
  block.supports = symmetry_supports<dim>();
  block.loads = {make_pressure<dim>("20*t")};
  BuiltScene<dim> built({block}, TypeParam::degree);
  add_loads(built);
  StaticRun<dim> run(built);
  ASSERT_TRUE(run.solve(.5)) << run.solver.failure();
  EXPECT_EQ(built.state.time, .5);
  // In plane strain E → E/(1 − ν²), ν → ν/(1 − ν).
  const double nu = .3, modulus = dim == 3 ? 1000. : 1000. / (1. - nu * nu),
               ratio = dim == 3 ? nu : nu / (1. - nu);
  double reaction = 0.;
  for (const OwnedNode<dim> &node : built.discretization.owned_nodes)
  {
    for (unsigned int d = 0; d < dim; ++d)
      EXPECT_NEAR(built.state.displacement.local_element(node.dofs[d]),
                  10. / modulus * node.position[d] * (d == dim - 1 ? -1. : ratio), 1e-10);
    reaction += run.solver.reactions().local_element(node.dofs[dim - 1]);
  }
  EXPECT_NEAR(reaction, 10., 1e-8);
  for (const Eigen::Matrix3d &stress : built.forces.elasticity->stresses())
    EXPECT_NEAR(stress(dim - 1, dim - 1), -10., 1e-7);
}

TYPED_TEST(QuasiStatic, NeoHookeanBlockUnderSupportsMatchesItsLaw)
{
  // Confined compression: F = diag(1, …, .8), the stress follows from the law at once.
  constexpr int dim = TypeParam::dim;
  BodyParameters block = make_graded_cube({1., 1., 1.});
  block.supports = symmetry_supports<dim>();
  block.supports.push_back(make_support("right", {"0", {}, {}}));
  if (dim == 3)
    block.supports.push_back(make_support("back", {std::nullopt, "0", {}}));
  std::array<std::optional<std::string>, 3> last;
  last[dim - 1] = "-.2*t";
  block.supports.push_back(make_support("top", last));
  BuiltScene<dim> built({block}, TypeParam::degree);
  StaticRun<dim> run(built);
  ASSERT_TRUE(run.solve(1.)) << run.solver.failure();
  const NeoHookean<dim> law{1000. / 2.6, 1000. / 1.2};
  SpatialTensor<dim> H = SpatialTensor<dim>::Zero();
  H(dim - 1, dim - 1) = -.2;
  const Eigen::Matrix3d expected = law.cauchy_stress(H, law.volume(-.2).pressure);
  for (const Eigen::Matrix3d &stress : built.forces.elasticity->stresses())
    EXPECT_LT((stress - expected).norm(), 1e-7 * expected.norm());
}

TYPED_TEST(QuasiStatic, BodyHeldOnlyByContactRestsOnTheFloor)
{
  constexpr int dim = TypeParam::dim;
  BodyParameters block = make_box("block", {1., 1., 1.}, {2, 2, 2});
  block.material = make_material(Model::linear_elastic, 0.);
  block.placement.shift[dim - 1] = .02; // above the floor at first
  for (const contact::Integration integration :
       {contact::Integration::face_quadrature, contact::Integration::face_segments})
  {
    BuiltScene<dim> built({block}, TypeParam::degree,
                          [](Parameters &p)
                          {
                            p.gravity[dim - 1] = -4.;
                            p.obstacles = {make_floor<dim>(0.)};
                          });
    add_loads(built);
    const auto contact = built.add_contact(make_settings(integration));
    ASSERT_FALSE(find_held_bodies(built.scene, built.supports)[0]);
    StaticRun<dim> run(built);
    ASSERT_TRUE(run.solve(1.)) << run.solver.failure();
    const auto measures = contact->measure();
    const double weight = 2. * 4.;
    EXPECT_NEAR(measures.resultants[0][dim - 1], weight, 1e-6 * weight);
    EXPECT_LT(std::abs(measures.resultants[0][0]), 1e-6 * weight);
    const double stiffness = 10. * 1000. / .5; // αE/h
    if (TypeParam::degree == 1)
    {
      EXPECT_NEAR(measures.max_penetration, weight / stiffness, 1e-6 * weight / stiffness);
    }
  }
}

TYPED_TEST(QuasiStatic, CubeRestsFarFromTheOriginOfTheCoordinates)
{
  // A million lengths away positions are only known to a hundredth of the depth of the contact.
  constexpr int dim = TypeParam::dim;
  BodyParameters block = make_box("block", {1., 1., 1.}, {2, 2, 2});
  block.material = make_material(Model::linear_elastic, 0.);
  block.placement.shift[dim - 1] = 1048576.;
  BuiltScene<dim> built({block}, TypeParam::degree,
                        [](Parameters &p)
                        {
                          p.gravity[dim - 1] = -4e-4;
                          p.obstacles = {make_floor<dim>(1048576.)};
                        });
  add_loads(built);
  const auto contact = built.add_contact(make_settings(contact::Integration::face_segments));
  StaticRun<dim> run(built);
  ASSERT_TRUE(run.solve(1.)) << run.solver.failure();
  EXPECT_NEAR(contact->measure().resultants[0][dim - 1], 8e-4, 8e-11);
}

TYPED_TEST(QuasiStatic, FaintLoadIsNotTakenForRoundOff)
{
  constexpr int dim = TypeParam::dim;
  BodyParameters block = make_box("block", {1., 1., 1.}, {2, 2, 2});
  block.material = make_material(Model::neo_hookean, 0.);
  block.supports = symmetry_supports<dim>();
  block.loads = {make_pressure<dim>("1e-20")};
  BuiltScene<dim> built({block}, TypeParam::degree);
  add_loads(built);
  StaticRun<dim> run(built);
  ASSERT_TRUE(run.solve(1.)) << run.solver.failure();
  EXPECT_NEAR(built.state.displacement.linfty_norm(), 1e-23, 1e-30);
}

TYPED_TEST(QuasiStatic, FailureNamesTheBodyThatNothingTouches)
{
  constexpr int dim = TypeParam::dim;
  BodyParameters block = make_box("block", {1., 1., 1.}, {1, 1, 1});
  block.placement.shift[dim - 1] = 3.;
  BuiltScene<dim> built({block}, TypeParam::degree,
                        [](Parameters &p)
                        {
                          p.gravity[dim - 1] = 4.; // away from the floor
                          p.obstacles = {make_floor<dim>(0.)};
                        });
  add_loads(built);
  built.add_contact(make_settings(contact::Integration::face_quadrature));
  StaticRun<dim> run(built);
  ASSERT_FALSE(run.solve(1.));
  EXPECT_NE(run.solver.failure().find("'block' flies off: nothing touches it"), std::string::npos)
      << run.solver.failure();
}

TYPED_TEST(QuasiStatic, LoadStepThatFailsRestoresTheState)
{
  constexpr int dim = TypeParam::dim;
  BodyParameters block = make_box("block", {1., 1., 1.}, {1, 1, 1});
  block.supports = symmetry_supports<dim>();
  std::array<std::optional<std::string>, 3> last;
  last[dim - 1] = "-t"; // at t = 1.2 the block would be inside out
  block.supports.push_back(make_support("top", last));
  BuiltScene<dim> built({block}, TypeParam::degree);
  StaticRun<dim> run(built);
  ASSERT_TRUE(run.solve(.1));
  EXPECT_TRUE(run.solver.failure().empty());
  const Vector before = built.state.displacement;
  EXPECT_FALSE(run.solve(1.2));
  EXPECT_FALSE(run.solver.failure().empty());
  EXPECT_EQ(built.state.time, .1);
  Vector change = built.state.displacement;
  change -= before;
  EXPECT_EQ(change.linfty_norm(), 0.);
  EXPECT_TRUE(run.solve(.2)) << run.solver.failure();
  EXPECT_EQ(built.state.time, .2);
}

TYPED_TEST(QuasiStatic, TooFewIterationsAreAFailure)
{
  constexpr int dim = TypeParam::dim;
  BodyParameters block = make_box("block", {1., 1., 1.}, {1, 1, 1});
  block.supports = symmetry_supports<dim>();
  block.loads = {make_pressure<dim>("300")};
  BuiltScene<dim> built({block}, TypeParam::degree);
  add_loads(built);
  QuasiStaticParameters parameters;
  parameters.max_iterations = 1;
  StaticRun<dim> run(built, parameters);
  EXPECT_FALSE(run.solve(1.));
  EXPECT_EQ(built.state.displacement.linfty_norm(), 0.);
}

/// Mean deflection of the end of a plane-strain cantilever of length 10 and height 1 under a unit end load.
double solve_cantilever(unsigned int degree, unsigned int n_layers, double poissons_ratio)
{
  BodyParameters beam = make_box("beam", {10., 1., 1.}, {10 * n_layers, n_layers, 1});
  beam.material = make_material(Model::linear_elastic, poissons_ratio);
  beam.material.youngs_modulus = 1e5;
  beam.supports = {make_support("left", {"0", "0", {}})};
  LoadParameters load;
  load.boundary = "right";
  load.traction = {{"0", "1", "0"}};
  beam.loads = {load};
  BuiltScene<2> built({beam}, degree);
  add_loads(built);
  StaticRun<2> run(built);
  EXPECT_TRUE(run.solve(1.)) << run.solver.failure();
  double sum = 0.;
  unsigned int n = 0;
  for (const OwnedNode<2> &node : built.discretization.owned_nodes)
    if (node.position[0] > 10. - 1e-9)
    {
      sum += built.state.displacement.local_element(node.dofs[1]);
      ++n;
    }
  return sum / n;
}

TEST(Locking, NearlyIncompressibleCantileverBendsAsItShould)
{
  const double nu = .4999, E = 1e5;
  // Timoshenko's beam in plane strain: P L³/(3 E' I) + P L/(5/6 G A).
  const double exact = 1000. / (3. * E / (1. - nu * nu) / 12.) + 10. / (5. / 6. * E / (2. * (1. + nu)));
  const double fine = solve_cantilever(2, 8, nu);
  EXPECT_NEAR(fine, exact, .03 * exact); // the clamp also stiffens
  EXPECT_NEAR(solve_cantilever(1, 8, nu), fine, .03 * fine);
  EXPECT_NEAR(solve_cantilever(1, 16, nu), fine, .01 * fine);
}

TEST(Locking, NearlyIncompressibleWaveMatchesDegreeTwo)
{
  // A block fixed below and at its sides, its top bent to a wave that keeps the volume.
  const auto stored_energy = [](unsigned int degree, unsigned int n_cells)
  {
    BodyParameters block = make_box("block", {1., 1., 1.}, {n_cells, n_cells, 1});
    block.material = make_material(Model::linear_elastic, .4999);
    block.supports = {make_support("bottom", {"0", "0", {}}), make_support("left", {"0", {}, {}}),
                      make_support("right", {"0", {}, {}}),
                      make_support("top", {std::nullopt, ".01*t*cos(2*pi*x)", {}})};
    BuiltScene<2> built({block}, degree);
    StaticRun<2> run(built);
    EXPECT_TRUE(run.solve(1.)) << run.solver.failure();
    return built.forces.elasticity->energy();
  };
  const double fine = stored_energy(2, 48);
  ASSERT_GT(fine, 0.);
  EXPECT_NEAR(stored_energy(1, 24), fine, .05 * fine); // locked: four times as much
}
} // namespace
