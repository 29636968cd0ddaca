// SPDX-License-Identifier: LGPL-2.1-or-later
#include "built_scene.h"

#include "signorini/physics/momentum.h"

using namespace signorini;
using namespace signorini::test;

namespace plastic_force_test
{
BodyParameters plastic(BodyParameters body, double yield_stress)
{
  body.material = make_material(Model::plastic);
  body.material.yield_stress = yield_stress;
  body.material.hardening_modulus = 100.;
  return body;
}

/// A body that does not yield between two that do: a box of simplices and a cube with hanging nodes.
template <int dim>
std::vector<BodyParameters> make_bodies()
{
  BodyParameters elastic = make_box("elastic", {1., 1., 1.}, {2, 2, 2}),
                 box = plastic(make_simplex_box("box", dim, {1., 1.5, .8}, {2, 2, 2}, .05), 20.);
  elastic.placement.shift = {2., 0., 0.};
  box.placement.shift = {4., 0., 0.};
  return {plastic(make_graded_cube(), 20.), elastic, box};
}

template <typename T>
class PlasticForces : public testing::Test
{
public:
  BuiltScene<T::dim> built{make_bodies<T::dim>(), T::degree};
  InternalForce<T::dim> &elasticity = *built.forces.elasticity;

  /// Brings the bodies to `displacement` and makes them remember it.
  double commit(const Vector &displacement)
  {
    built.state.displacement = displacement;
    elasticity.update(built.state);
    return elasticity.commit();
  }
};
TYPED_TEST_SUITE(PlasticForces, AllCases);

TYPED_TEST(PlasticForces, AreTheGradientOfTheStepsEnergyWithASymmetricTangent)
{
  ASSERT_GT(this->commit(this->built.random_vector(.04, 5)), 0.);
  const Vector u = this->built.random_vector(.04);
  expect_force_is_energy_gradient(this->built, this->elasticity, u, 1e-7, 1e-6);
  expect_tangent_is_force_gradient(this->built, this->elasticity, u, 1e-7, 1e-5);
  const VectorAndMoment sums =
      sum_over_nodes(this->built.discretization, u, this->built.force_of(this->elasticity, u));
  for (unsigned int d = 0; d < 3; ++d)
  {
    EXPECT_LT(std::abs(sums.vector[d]), 1e-13 * sums.vector_scale);
    EXPECT_LT(std::abs(sums.moment[d]), 1e-13 * sums.moment_scale);
  }
}

TYPED_TEST(PlasticForces, RememberWhatIsCommittedAndNothingElse)
{
  const Vector u = this->built.random_vector(.04);
  const Vector force = this->built.force_of(this->elasticity, u);
  const double energy = this->built.energy_of(this->elasticity, u);
  // Trials in between leave no trace.
  this->built.force_of(this->elasticity, this->built.random_vector(.1, 7));
  this->built.energy_of(this->elasticity, this->built.random_vector(.1, 8));
  EXPECT_EQ(this->built.energy_of(this->elasticity, u), energy);

  const double work = this->commit(u);
  EXPECT_GT(work, .1 * energy);
  EXPECT_NEAR(this->elasticity.energy(), energy - work, 1e-11 * energy);
  Vector difference = this->built.force_of(this->elasticity, u);
  difference -= force;
  EXPECT_LT(difference.linfty_norm(), 1e-11 * force.linfty_norm());
  EXPECT_EQ(this->elasticity.commit(), 0.);
  // Back where it came from, the energy is not what it was.
  EXPECT_GT(this->built.energy_of(this->elasticity, this->built.discretization.make_vector()), 1e-3 * energy);
}

TYPED_TEST(PlasticForces, OneDeformationIsRememberedByAllPointsOfTheBodiesThatYield)
{
  constexpr int dim = TypeParam::dim;
  SpatialTensor<3> A;
  A << .05, -.08, .02, .03, -.04, .06, -.02, .01, .03;
  const SpatialTensor<dim> H = A.topLeftCorner<dim, dim>();
  const double work = this->commit(
      this->built.interpolate([&](const SpatialVector<dim> &x) { return SpatialVector<dim>(H * x); }));

  const MaterialParameters &material = this->built.scene.materials[0];
  const double E = material.youngs_modulus, nu = material.poissons_ratio;
  const PlasticState untouched;
  const PlasticStep expected = J2Plastic<dim>{E / (2. * (1. + nu)), E / (3. * (1. - 2. * nu)),
                                              material.yield_stress, material.hardening_modulus, &untouched}
                                   .yield(H);
  ASSERT_GT(expected.work, 0.);
  const std::vector<double> strains = this->elasticity.plastic_strains();
  const CellTable<dim> &cells = this->built.discretization.cells;
  ASSERT_EQ(strains.size(), cells.n_cells);
  double volume = 0.;
  for (unsigned int cell = 0; cell < cells.n_cells; ++cell)
  {
    const bool may_yield = cells.bodies[cell] != 1;
    EXPECT_NEAR(strains[cell], may_yield ? expected.state.equivalent_strain : 0., 1e-12);
    for (unsigned int q = 0; q < cells.n_points(cell) && may_yield; ++q)
      volume += cells.cell_weights(cell)[q];
  }
  EXPECT_NEAR(work, volume * expected.work, 1e-12 * work);
}

TYPED_TEST(PlasticForces, ExplicitStepsAreBoundedByTheElasticTangent)
{
  // However far it has yielded on the way: what is committed resists the next step elastically.
  constexpr int dim = TypeParam::dim;
  BuiltScene<dim> soft({plastic(make_graded_cube(), .1)}, TypeParam::degree),
      hard({plastic(make_graded_cube(), 1e9)}, TypeParam::degree);
  const Vector u = soft.random_vector(5e-4);
  hard.force_of(*hard.forces.elasticity, u);
  const double elastic = bulk_frequency_squared(hard);
  soft.force_of(*soft.forces.elasticity, u);
  // The fastest motion of a hexahedron of degree 1 is one of its volume, which does not yield.
  if (dim == 2 || TypeParam::degree == 2)
  {
    EXPECT_LT(bulk_frequency_squared(soft), .95 * elastic);
  }
  EXPECT_GT(soft.forces.elasticity->commit(), 0.);
  EXPECT_NEAR(bulk_frequency_squared(soft), elastic, .02 * elastic);
}

TEST(ElasticForces, HaveNothingToRemember)
{
  BuiltScene<2> built({make_box("box", {1., 1., 1.}, {2, 2, 2})}, 1);
  const Vector u = built.random_vector(.1);
  const double energy = built.energy_of(*built.forces.elasticity, u);
  EXPECT_FALSE(built.forces.elasticity->has_plasticity());
  EXPECT_EQ(built.forces.elasticity->commit(), 0.);
  EXPECT_EQ(built.forces.elasticity->energy(), energy);
}
} // namespace plastic_force_test
