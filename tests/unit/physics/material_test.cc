// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/physics/material.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>

using namespace signorini;

namespace material_test
{
constexpr double mu = 3., kappa = 7., lambda = kappa - 2. / 3. * mu;

template <int space_dim, template <int> class LawTemplate>
struct LawCase
{
  static constexpr int dim = space_dim;
  using Law = LawTemplate<space_dim>;
  using Gradient = typename Law::Gradient;
};

/// A general displacement gradient, large enough to be far from small strain, with J > 0.
template <int dim>
Eigen::Matrix<double, dim, dim> general_gradient()
{
  Eigen::Matrix3d H;
  H << .21, -.13, .08, .17, -.09, .11, -.05, .14, .12;
  return H.topLeftCorner<dim, dim>();
}

template <typename T>
class Material : public testing::Test
{
public:
  static constexpr int n = T::dim;
  static constexpr double step = 1e-5;
  using Gradient = typename T::Gradient;
  typename T::Law law{mu, kappa};
  Gradient general = general_gradient<n>();

  Gradient moved(int index, double distance) const
  {
    Gradient other = general;
    other(index / n, index % n) += distance;
    return other;
  }

  ShapeResponse<n> shape(const Gradient &gradient) const
  {
    ShapeResponse<n> response;
    law.shape(gradient, Order::second, response);
    return response;
  }

  VolumeStrain<n> strain(const Gradient &gradient) const
  {
    VolumeStrain<n> result;
    law.volume_strain(gradient, Order::second, result);
    return result;
  }
};

using Laws = testing::Types<LawCase<2, LinearElastic>, LawCase<3, LinearElastic>, LawCase<2, NeoHookean>,
                            LawCase<3, NeoHookean>>;
TYPED_TEST_SUITE(Material, Laws);

TYPED_TEST(Material, StressIsGradientOfEnergy)
{
  const auto here = this->shape(this->general);
  for (int i = 0; i < here.stress.size(); ++i)
  {
    const double difference =
        this->shape(this->moved(i, this->step)).energy - this->shape(this->moved(i, -this->step)).energy;
    EXPECT_NEAR(here.stress[i], difference / (2. * this->step), 1e-7 * here.stress.norm());
  }
}

TYPED_TEST(Material, TangentIsGradientOfStressAndSymmetric)
{
  const auto here = this->shape(this->general);
  for (int i = 0; i < here.stress.size(); ++i)
  {
    const auto column =
        ((this->shape(this->moved(i, this->step)).stress - this->shape(this->moved(i, -this->step)).stress) /
         (2. * this->step))
            .eval();
    EXPECT_LT((here.tangent.col(i) - column).norm(), 1e-7 * here.tangent.norm());
  }
  EXPECT_LT((here.tangent - here.tangent.transpose()).norm(), 1e-14 * here.tangent.norm());
}

TYPED_TEST(Material, VolumeStrainAndItsDerivatives)
{
  const auto here = this->strain(this->general);
  for (int i = 0; i < here.gradient.size(); ++i)
  {
    const auto forth = this->strain(this->moved(i, this->step)),
               back = this->strain(this->moved(i, -this->step));
    EXPECT_NEAR(here.gradient[i], (forth.value - back.value) / (2. * this->step), 1e-7);
    EXPECT_LT((here.hessian.col(i) - (forth.gradient - back.gradient) / (2. * this->step)).norm(), 1e-7);
  }
  EXPECT_LT((here.hessian - here.hessian.transpose()).norm(), 1e-14);
}

TYPED_TEST(Material, VolumeResponseAndItsDerivatives)
{
  for (const double e : {-.2, 0., .3})
  {
    const VolumeResponse here = this->law.volume(e), forth = this->law.volume(e + this->step),
                         back = this->law.volume(e - this->step);
    EXPECT_NEAR(here.pressure, (forth.energy - back.energy) / (2. * this->step), 1e-7 * kappa);
    EXPECT_NEAR(here.modulus, (forth.pressure - back.pressure) / (2. * this->step), 1e-7 * kappa);
  }
  EXPECT_NEAR(this->law.volume(0.).energy, 0., 1e-15);
  EXPECT_NEAR(this->law.volume(0.).pressure, 0., 1e-15);
  EXPECT_NEAR(this->law.volume(0.).modulus, kappa, 1e-14);
}

TYPED_TEST(Material, SmallStrainIsLambdaMu)
{
  constexpr int dim = TypeParam::dim;
  const auto H = (1e-12 * this->general).eval();
  const auto strain = (.5 * (H + H.transpose())).eval();
  Eigen::Matrix3d expected = lambda * H.trace() * Eigen::Matrix3d::Identity();
  expected.template topLeftCorner<dim, dim>() += 2. * mu * strain;
  const double pressure = this->law.volume(this->strain(H).value).pressure;
  EXPECT_LT((this->law.cauchy_stress(H, pressure) - expected).norm(), 1e-11 * expected.norm());
}

TYPED_TEST(Material, CauchyStressIsPushedForwardFirstStress)
{
  constexpr int dim = TypeParam::dim;
  const auto shape = this->shape(this->general);
  const auto strain = this->strain(this->general);
  const double pressure = this->law.volume(strain.value).pressure;
  using Matrix = Eigen::Matrix<double, dim, dim, Eigen::RowMajor>;
  Matrix first = Eigen::Map<const Matrix>(
      Eigen::Matrix<double, dim * dim, 1>(shape.stress + pressure * strain.gradient).data());
  if (std::is_same_v<typename TypeParam::Law, NeoHookean<dim>>)
    first = (first * (Matrix::Identity() + this->general).transpose() / (1. + strain.value)).eval();
  const Eigen::Matrix3d stress = this->law.cauchy_stress(this->general, pressure);
  EXPECT_LT((stress.template topLeftCorner<dim, dim>() - first).norm(), 1e-13 * first.norm());
  EXPECT_LT((stress - stress.transpose()).norm(), 1e-13 * stress.norm());
}

TYPED_TEST(Material, PlaneStrainIsTheThreeDimensionalAnswer)
{
  constexpr int dim = TypeParam::dim;
  if (dim == 3)
    return;
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
  H.topLeftCorner<dim, dim>() = this->general;
  const double pressure = -.4;
  const bool is_linear = std::is_same_v<typename TypeParam::Law, LinearElastic<dim>>;
  const Eigen::Matrix3d expected = is_linear ? LinearElastic<3>{mu, kappa}.cauchy_stress(H, pressure)
                                             : NeoHookean<3>{mu, kappa}.cauchy_stress(H, pressure);
  EXPECT_LT((this->law.cauchy_stress(this->general, pressure) - expected).norm(), 1e-14 * expected.norm());
  ShapeResponse<3> response;
  is_linear ? LinearElastic<3>{mu, kappa}.shape(H, Order::first, response)
            : NeoHookean<3>{mu, kappa}.shape(H, Order::first, response);
  EXPECT_NEAR(this->shape(this->general).energy, response.energy, 1e-14);
}

TEST(LinearElasticLaw, UniaxialStressFollowsYoungsModulus)
{
  const double E = 9. * kappa * mu / (3. * kappa + mu),
               nu = (3. * kappa - 2. * mu) / (2. * (3. * kappa + mu));
  const double strain = .01;
  const Eigen::Matrix3d H = Eigen::Vector3d(strain, -nu * strain, -nu * strain).asDiagonal();
  const LinearElastic<3> law{mu, kappa};
  const Eigen::Matrix3d stress = law.cauchy_stress(H, law.volume(H.trace()).pressure);
  const Eigen::Matrix3d expected = Eigen::Vector3d(E * strain, 0., 0.).asDiagonal();
  EXPECT_LT((stress - expected).norm(), 1e-15);
}

TEST(NeoHookeanLaw, UniformDilatationIsPurePressure)
{
  const double stretch = 1.2, J = stretch * stretch * stretch;
  const NeoHookean<3> law{mu, kappa};
  const Eigen::Matrix3d H = (stretch - 1.) * Eigen::Matrix3d::Identity();
  ShapeResponse<3> response;
  law.shape(H, Order::first, response);
  EXPECT_NEAR(response.energy, 0., 1e-14);
  const Eigen::Matrix3d stress = law.cauchy_stress(H, law.volume(J - 1.).pressure);
  EXPECT_LT((stress - .5 * kappa * (J - 1. / J) * Eigen::Matrix3d::Identity()).norm(), 1e-13);
}

TEST(NeoHookeanLaw, SimpleShearGivesShearModulusTimesShear)
{
  // J = 1, so τ_12 = μ γ and σ_11 − σ_22 = μ γ² exactly.
  const double shear = .7;
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
  H(0, 1) = shear;
  const Eigen::Matrix3d stress = NeoHookean<3>{mu, kappa}.cauchy_stress(H, 0.);
  EXPECT_NEAR(stress(0, 1), mu * shear, 1e-14);
  EXPECT_NEAR(stress(0, 0) - stress(1, 1), mu * shear * shear, 1e-14);
  EXPECT_NEAR(stress.trace(), 0., 1e-14);
}

TEST(NeoHookeanLaw, RotationRotatesTheStressAndStoresNothing)
{
  const NeoHookean<3> law{mu, kappa};
  const Eigen::Matrix3d R =
      Eigen::AngleAxisd(1.9, Eigen::Vector3d(1., -2., .5).normalized()).toRotationMatrix();
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity(), H = general_gradient<3>();
  const Eigen::Matrix3d turned = R * (I + H) - I;
  EXPECT_LT((law.cauchy_stress(turned, -.2) - R * law.cauchy_stress(H, -.2) * R.transpose()).norm(), 1e-13);
  ShapeResponse<3> response, turned_response;
  law.shape(H, Order::first, response);
  law.shape(turned, Order::first, turned_response);
  EXPECT_NEAR(response.energy, turned_response.energy, 1e-14);
  law.shape(R - I, Order::first, response);
  EXPECT_NEAR(response.energy, 0., 1e-14);
  EXPECT_LT(law.cauchy_stress(R - I, 0.).norm(), 1e-14);
}

TEST(NeoHookeanLaw, InvertedElementIsNotANumber)
{
  const NeoHookean<2> law{mu, kappa};
  Eigen::Matrix2d H = Eigen::Matrix2d::Zero();
  H(0, 0) = -1.5;
  ShapeResponse<2> response;
  law.shape(H, Order::first, response);
  EXPECT_TRUE(std::isnan(response.energy));
}
} // namespace material_test
