// SPDX-License-Identifier: LGPL-2.1-or-later
#include "built_scene.h"

#include "signorini/physics/momentum.h"

#include <Eigen/Geometry>

using namespace signorini;
using namespace signorini::test;

namespace
{
/// A turned ball of distorted elements, a turned box of simplices, some with curved edges, and a cube with
/// hanging nodes.
template <int dim>
std::vector<BodyParameters> make_bodies(Model ball_model, Model cube_model)
{
  BodyParameters ball = make_ball("ball", .8, 0);
  ball.placement.shift = {3., -1., .5};
  ball.placement.rotation_angle = 35.;
  ball.placement.rotation_axis = {1., .3, -.2};
  ball.material = make_material(ball_model, .3);
  BodyParameters cube = make_graded_cube();
  cube.material = make_material(cube_model, .45);
  BodyParameters box = make_simplex_box("box", dim, {1., 1.5, .8}, {2, 2, 2}, .05);
  box.placement = ball.placement;
  box.placement.shift = {-4., 1., 0.};
  box.material = cube.material;
  return {ball, box, cube};
}

template <typename T>
class InternalForces : public testing::Test
{
public:
  void expect_balance(BuiltScene<T::dim> &built, const Vector &displacement, const Vector &of_moments)
  {
    const Vector force = built.force_of(*built.forces.elasticity, displacement);
    const VectorAndMoment sums = sum_over_nodes(built.discretization, of_moments, force);
    for (unsigned int d = 0; d < 3; ++d)
    {
      EXPECT_LT(std::abs(sums.vector[d]), 1e-13 * sums.vector_scale);
      EXPECT_LT(std::abs(sums.moment[d]), 1e-13 * sums.moment_scale);
    }
  }
};
TYPED_TEST_SUITE(InternalForces, AllCases);

TYPED_TEST(InternalForces, ForceIsEnergyGradient)
{
  for (const auto &[one, other] : {std::pair(Model::neo_hookean, Model::linear_elastic),
                                   std::pair(Model::linear_elastic, Model::neo_hookean)})
  {
    BuiltScene<TypeParam::dim> built(make_bodies<TypeParam::dim>(one, other), TypeParam::degree);
    expect_force_is_energy_gradient(built, *built.forces.elasticity, built.random_vector(.04));
  }
}

TYPED_TEST(InternalForces, TangentIsForceGradient)
{
  for (const auto &[one, other] : {std::pair(Model::neo_hookean, Model::linear_elastic),
                                   std::pair(Model::linear_elastic, Model::neo_hookean)})
  {
    BuiltScene<TypeParam::dim> built(make_bodies<TypeParam::dim>(one, other), TypeParam::degree);
    expect_tangent_is_force_gradient(built, *built.forces.elasticity, built.random_vector(.04));
  }
}

TYPED_TEST(InternalForces, NeoHookeanForcesBalanceInTheDeformedConfiguration)
{
  BuiltScene<TypeParam::dim> built(make_bodies<TypeParam::dim>(Model::neo_hookean, Model::neo_hookean),
                                   TypeParam::degree);
  const Vector u = built.random_vector(.04);
  this->expect_balance(built, u, u);
}

TYPED_TEST(InternalForces, LinearElasticForcesBalanceInTheUndeformedConfiguration)
{
  BuiltScene<TypeParam::dim> built(make_bodies<TypeParam::dim>(Model::linear_elastic, Model::linear_elastic),
                                   TypeParam::degree);
  this->expect_balance(built, built.random_vector(.04), built.discretization.make_vector());
}

TYPED_TEST(InternalForces, NeoHookeanEnergyDoesNotSeeRigidMotion)
{
  constexpr int dim = TypeParam::dim;
  BuiltScene<dim> built(make_bodies<TypeParam::dim>(Model::neo_hookean, Model::neo_hookean),
                        TypeParam::degree);
  const SpatialTensor<dim> R =
      Eigen::AngleAxisd(1.1, Eigen::Vector3d(0., 0., 1.)).toRotationMatrix().topLeftCorner<dim, dim>();
  const Vector u = built.random_vector(.04);
  Vector turned = built.discretization.make_vector();
  for (const OwnedNode<dim> &node : built.discretization.owned_nodes)
  {
    SpatialVector<dim> X, x;
    for (unsigned int d = 0; d < dim; ++d)
    {
      X[d] = node.position[d];
      x[d] = X[d] + u.local_element(node.dofs[d]);
    }
    const SpatialVector<dim> moved = R * x + SpatialVector<dim>::Constant(.7) - X;
    for (unsigned int d = 0; d < dim; ++d)
      turned.local_element(node.dofs[d]) = moved[d];
  }
  built.discretization.distribute(turned);
  const double energy = built.energy_of(*built.forces.elasticity, u);
  EXPECT_GT(energy, 0.);
  EXPECT_NEAR(built.energy_of(*built.forces.elasticity, turned), energy, 1e-11 * energy);
}

TYPED_TEST(InternalForces, TurnsOfLinearBodiesAreTold)
{
  constexpr int dim = TypeParam::dim;
  constexpr double angle = .3;
  const SpatialTensor<dim> turned_stretch =
      Eigen::AngleAxisd(angle, Eigen::Vector3d(0., 0., 1.)).toRotationMatrix().topLeftCorner<dim, dim>() *
      1.2;
  BuiltScene<dim> built(make_bodies<dim>(Model::neo_hookean, Model::linear_elastic), TypeParam::degree);
  const Vector u = built.interpolate([&](const SpatialVector<dim> &x)
                                     { return SpatialVector<dim>(turned_stretch * x - x); });
  built.energy_of(*built.forces.elasticity, u);
  const std::vector<double> turns = built.forces.elasticity->turns_taken_for_strain();
  EXPECT_EQ(turns.at(0), 0.);
  EXPECT_NEAR(turns.at(1), angle, 1e-10);
  EXPECT_NEAR(turns.at(2), angle, 1e-10);
}

TYPED_TEST(InternalForces, LinearDisplacementGivesOneStress)
{
  constexpr int dim = TypeParam::dim;
  BuiltScene<dim> built(make_bodies<TypeParam::dim>(Model::linear_elastic, Model::linear_elastic),
                        TypeParam::degree);
  SpatialTensor<3> A;
  A << .02, -.01, .005, .03, -.015, .01, -.02, .004, .01;
  const SpatialTensor<dim> H = A.topLeftCorner<dim, dim>();
  const Vector u = built.interpolate([&](const SpatialVector<dim> &x) { return SpatialVector<dim>(H * x); });
  const Vector force = built.force_of(*built.forces.elasticity, u);

  const std::vector<Eigen::Matrix3d> stresses = built.forces.elasticity->stresses();
  for (unsigned int cell = 0; cell < stresses.size(); ++cell)
  {
    const MaterialParameters &material = built.scene.materials[built.discretization.cells.bodies[cell]];
    const double E = material.youngs_modulus, nu = material.poissons_ratio;
    Eigen::Matrix3d strain = Eigen::Matrix3d::Zero();
    strain.topLeftCorner<dim, dim>() = .5 * (H + H.transpose());
    const Eigen::Matrix3d expected = E / (1. + nu) * strain + E * nu / ((1. + nu) * (1. - 2. * nu)) *
                                                                  strain.trace() *
                                                                  Eigen::Matrix3d::Identity();
    EXPECT_LT((stresses[cell] - expected).norm(), 1e-12 * expected.norm());
  }

  std::vector<bool> is_inside(force.locally_owned_size(), true);
  for (unsigned int node = 0; node < built.map.surface().n_nodes(); ++node)
    for (const auto dof : built.map.node_dofs(node))
      is_inside[dof] = false;
  ASSERT_GT(std::count(is_inside.begin(), is_inside.end(), true), 0);
  for (unsigned int dof = 0; dof < is_inside.size(); ++dof)
    if (is_inside[dof])
    {
      EXPECT_NEAR(force.local_element(dof), 0., 1e-12 * force.linfty_norm());
    }
}

TYPED_TEST(InternalForces, MeanDilatationTakesOneVolumeRatioACell)
{
  // A bubble of one node of a single cell: its dilatation has zero mean for the hourglass mode, so that a
  // nearly incompressible cell of degree 1 resists it by shear only.
  constexpr int dim = TypeParam::dim;
  if (TypeParam::degree == 2)
    return;
  const auto energy = [](double poissons_ratio)
  {
    BodyParameters cell = make_box("cell", {2., 2., 2.}, {1, 1, 1});
    cell.placement.shift = {-1., -1., -1.};
    cell.material = make_material(Model::linear_elastic, poissons_ratio);
    cell.material.youngs_modulus = 2. * (1. + poissons_ratio); // shear modulus 1
    BuiltScene<dim> built({cell}, 1);
    const Vector u = built.interpolate(
        [](const SpatialVector<dim> &x)
        {
          SpatialVector<dim> bending = SpatialVector<dim>::Zero();
          bending[0] = x[0] * x[1];
          return bending;
        });
    return built.energy_of(*built.forces.elasticity, u);
  };
  EXPECT_NEAR(energy(.4999), energy(.1), 1e-9 * energy(.1));
}
} // namespace
