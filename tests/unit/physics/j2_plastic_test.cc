// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/physics/j2_plastic.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>
#include <random>

using namespace signorini;

namespace j2_plastic_test
{
constexpr double mu = 3., kappa = 7., first_yield = .3, hardening = .5;
const PlasticState untouched;

template <int dim>
J2Plastic<dim> law_at(const PlasticState &state, double h = hardening)
{
  return {mu, kappa, first_yield, h, &state};
}

template <int dim>
using Gradient = Eigen::Matrix<double, dim, dim>;

template <int dim>
Gradient<dim> corner(const Eigen::Matrix3d &H)
{
  return H.topLeftCorner<dim, dim>();
}

Eigen::Matrix3d general_gradient()
{
  Eigen::Matrix3d H;
  H << .21, -.13, .08, .17, -.09, .11, -.05, .14, .12;
  return H;
}

/// Much yielding in another direction than that of the general gradient.
template <int dim>
PlasticState worked_state()
{
  Eigen::Matrix3d H;
  H << -.3, .4, .05, -.1, .2, -.15, .1, .12, .3;
  return law_at<dim>(untouched).yield(corner<dim>(H)).state;
}

template <int dim>
ShapeResponse<dim> shape(const J2Plastic<dim> &law, const Gradient<dim> &H)
{
  ShapeResponse<dim> response;
  law.shape(H, Order::second, response);
  return response;
}

double mises(const Eigen::Matrix3d &stress)
{
  return std::sqrt(1.5) * (stress - stress.trace() / 3. * Eigen::Matrix3d::Identity()).norm();
}

/// Of a step from `state` to H: the stress is the gradient of the energy, the tangent that of the stress.
template <int dim>
void expect_derivatives(const PlasticState &state, const Gradient<dim> &H, double step = 1e-5)
{
  const J2Plastic<dim> law = law_at<dim>(state);
  const auto here = shape<dim>(law, H);
  for (int i = 0; i < dim * dim; ++i)
  {
    Gradient<dim> forth = H, back = H;
    forth(i / dim, i % dim) += step;
    back(i / dim, i % dim) -= step;
    const auto right = shape<dim>(law, forth), left = shape<dim>(law, back);
    EXPECT_NEAR(here.stress[i], (right.energy - left.energy) / (2. * step), 1e-7 * mu);
    EXPECT_LT((here.tangent.col(i) - (right.stress - left.stress) / (2. * step)).norm(),
              1e-7 * here.tangent.norm());
  }
  EXPECT_LT((here.tangent - here.tangent.transpose()).norm(), 1e-14 * here.tangent.norm());
}

template <typename T>
class Plasticity : public testing::Test
{
};

template <int space_dim>
struct Dimension
{
  static constexpr int dim = space_dim;
};
using Dimensions = testing::Types<Dimension<2>, Dimension<3>>;
TYPED_TEST_SUITE(Plasticity, Dimensions);

TYPED_TEST(Plasticity, StressAndTangentAreGradients)
{
  constexpr int dim = TypeParam::dim;
  const Gradient<dim> H = corner<dim>(general_gradient());
  const PlasticState worked = worked_state<dim>();
  // From nothing within and beyond the yield surface; and from a worked state, both again.
  ASSERT_EQ(law_at<dim>(untouched).yield(.1 * H).work, 0.);
  expect_derivatives<dim>(untouched, .1 * H);
  ASSERT_GT(law_at<dim>(untouched).yield(H).work, .01);
  expect_derivatives<dim>(untouched, H);
  ASSERT_GT(law_at<dim>(worked).yield(H).work, .01);
  expect_derivatives<dim>(worked, H);
  const Gradient<dim> near_surface = [&]()
  {
    Eigen::Matrix3d G;
    G << -.3, .4, .05, -.1, .2, -.15, .1, .12, .3;
    return Gradient<dim>(.95 * corner<dim>(G));
  }();
  ASSERT_EQ(law_at<dim>(worked).yield(near_surface).work, 0.);
  expect_derivatives<dim>(worked, near_surface);
}

TYPED_TEST(Plasticity, StressAndTangentAreGradientsWhereStretchesAgree)
{
  constexpr int dim = TypeParam::dim;
  // All three stretches, and two of them, in axes of their own; nearly equal ones too.
  for (const double difference : {0., 1e-13, 1e-9, 1e-6})
    for (const Eigen::Vector3d &stretches :
         {Eigen::Vector3d(.2, .2 + difference, .2), Eigen::Vector3d(.4, .4 + difference, -.3),
          Eigen::Vector3d(-.3, .5, .5 + difference), Eigen::Vector3d(difference, 0., 0.)})
    {
      const Eigen::Matrix3d R =
          Eigen::AngleAxisd(.7, dim == 2 ? Eigen::Vector3d(0., 0., 1.) : Eigen::Vector3d(.6, 0., .8))
              .toRotationMatrix();
      const Eigen::Matrix3d H = R * stretches.asDiagonal() * R.transpose();
      expect_derivatives<dim>(untouched, corner<dim>(H));
      expect_derivatives<dim>(worked_state<dim>(), corner<dim>(H));
    }
}

TYPED_TEST(Plasticity, FlowKeepsVolumeAndStaysWhereItIs)
{
  constexpr int dim = TypeParam::dim;
  const Gradient<dim> H = corner<dim>(general_gradient());
  PlasticState state = worked_state<dim>();
  double work = 0.;
  for (unsigned int n = 1; n <= 200; ++n)
  {
    const Gradient<dim> turning = std::sin(.3 * n) * H + .3 * std::cos(.2 * n) * H.transpose();
    const J2Plastic<dim> law = law_at<dim>(state);
    const PlasticStep step = law.yield(turning);
    const double energy = shape<dim>(law, turning).energy;
    const Eigen::Matrix3d stress = law.cauchy_stress(turning, 0.);
    EXPECT_GE(step.work, 0.);
    EXPECT_GE(step.state.equivalent_strain, state.equivalent_strain);
    state = step.state;
    work += step.work;
    // What was accepted is elastic: the energy less the work, the same stress, the tangent of no yielding.
    EXPECT_EQ(law.yield(turning).work, 0.);
    EXPECT_NEAR(shape<dim>(law, turning).energy, energy - step.work, 1e-13);
    EXPECT_LT((law.cauchy_stress(turning, 0.) - stress).norm(), 1e-12 * mu);
    EXPECT_NEAR((Eigen::Matrix3d::Identity() + state.inverse_metric).determinant(), 1., 1e-13);
    EXPECT_LT((state.inverse_metric - state.inverse_metric.transpose()).norm(), 1e-13);
  }
  EXPECT_GT(state.equivalent_strain, 2.);
  // The work is that of the yield stress over all yielding.
  const double a = worked_state<dim>().equivalent_strain, b = state.equivalent_strain;
  EXPECT_NEAR(work, first_yield * (b - a) + .5 * hardening * (b * b - a * a), 1e-11 * work);
}

TYPED_TEST(Plasticity, SmallElasticStrainIsLambdaMu)
{
  constexpr int dim = TypeParam::dim;
  const Gradient<dim> H = 1e-12 * corner<dim>(general_gradient());
  Eigen::Matrix3d expected = (kappa - 2. / 3. * mu) * H.trace() * Eigen::Matrix3d::Identity();
  expected.topLeftCorner<dim, dim>() += mu * (H + H.transpose());
  const J2Plastic<dim> law = law_at<dim>(untouched);
  VolumeStrain<dim> strain;
  law.volume_strain(H, Order::first, strain);
  const double pressure = law.volume(strain.value).pressure;
  EXPECT_LT((law.cauchy_stress(H, pressure) - expected).norm(), 1e-11 * expected.norm());
  EXPECT_NEAR(shape<dim>(law, H).energy,
              mu * (expected - expected.trace() / 3. * Eigen::Matrix3d::Identity()).squaredNorm() /
                  (4. * mu * mu),
              1e-11 * mu * H.squaredNorm());
}

TYPED_TEST(Plasticity, SmallStrainKeepsItsDigitsThroughYielding)
{
  // The radial return of small strain, to first order: yield stress and strain of 1e-12.
  constexpr int dim = TypeParam::dim;
  constexpr double scale = 1e-12;
  const Gradient<dim> H = scale * corner<dim>(general_gradient());
  Eigen::Matrix3d e = Eigen::Matrix3d::Zero();
  e.topLeftCorner<dim, dim>() = .5 * (H + H.transpose());
  e -= e.trace() / 3. * Eigen::Matrix3d::Identity();
  const double limit = scale * first_yield;
  const J2Plastic<dim> law{mu, kappa, limit, hardening, &untouched};
  const double trial = std::sqrt(6.) * mu * e.norm(), increment = (trial - limit) / (3. * mu + hardening);
  ASSERT_GT(increment, 0.);
  const PlasticStep step = law.yield(H);
  EXPECT_NEAR(step.state.equivalent_strain, increment, 1e-10 * increment);
  const Eigen::Matrix3d expected = -2. * std::sqrt(1.5) * increment * e / e.norm();
  EXPECT_LT((step.state.inverse_metric - expected).norm(), 1e-10 * expected.norm());
  EXPECT_LT((law.cauchy_stress(H, 0.) - 2. * mu * (1. - 3. * mu * increment / trial) * e).norm(),
            1e-10 * mu * e.norm());
}

TYPED_TEST(Plasticity, WorkOfTheStressIsStoredOrDoneInYielding)
{
  constexpr int dim = TypeParam::dim;
  const Gradient<dim> A = corner<dim>(general_gradient());
  const auto path = [&](double t) { return Gradient<dim>(std::sin(t) * A + .2 * t * A.transpose()); };
  const auto missing = [&](unsigned int n_steps)
  {
    PlasticState state;
    double work = 0., yielding = 0., energy = 0.;
    for (unsigned int n = 0; n < n_steps; ++n)
    {
      const Gradient<dim> from = path(5. * n / n_steps), to = path(5. * (n + 1) / n_steps);
      const J2Plastic<dim> law = law_at<dim>(state);
      for (int i = 0; i < dim * dim; ++i)
        work += .5 * (shape<dim>(law, from).stress[i] + shape<dim>(law, to).stress[i]) *
                (to(i / dim, i % dim) - from(i / dim, i % dim));
      const PlasticStep step = law.yield(to);
      yielding += step.work;
      state = step.state;
      energy = shape<dim>(law, to).energy;
    }
    EXPECT_GT(yielding, .5 * work);
    return std::abs(work - yielding - energy) / work;
  };
  EXPECT_LT(missing(4000), 1e-5);
  EXPECT_LT(missing(4000), .1 * missing(1000));
}

TYPED_TEST(Plasticity, CauchyStressIsPushedForwardFirstStress)
{
  constexpr int dim = TypeParam::dim;
  const Gradient<dim> H = corner<dim>(general_gradient()), F = Gradient<dim>::Identity() + H;
  const PlasticState state = worked_state<dim>();
  const auto response = shape<dim>(law_at<dim>(state), H);
  Gradient<dim> first;
  for (int i = 0; i < dim * dim; ++i)
    first(i / dim, i % dim) = response.stress[i];
  const Gradient<dim> expected = first * F.transpose() / F.determinant();
  const Eigen::Matrix3d stress = law_at<dim>(state).cauchy_stress(H, 0.);
  EXPECT_LT((corner<dim>(stress) - expected).norm(), 1e-14);
  EXPECT_NEAR(stress.trace(), 0., 1e-14);
}

TYPED_TEST(Plasticity, InvertedElementIsNotANumber)
{
  constexpr int dim = TypeParam::dim;
  Gradient<dim> H = Gradient<dim>::Zero();
  H(0, 0) = -1.5;
  const auto response = shape<dim>(law_at<dim>(untouched), H);
  EXPECT_TRUE(std::isnan(response.energy));
  EXPECT_TRUE(std::isnan(response.stress[0]));
  H(0, 0) = -1.;
  EXPECT_FALSE(std::isfinite(shape<dim>(law_at<dim>(untouched), H).energy));
}

TEST(PlasticityInPlaneStrain, IsTheThreeDimensionalAnswer)
{
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
  H.topLeftCorner<2, 2>() = corner<2>(general_gradient());
  const PlasticState state = worked_state<2>();
  EXPECT_GT(std::abs(state.inverse_metric(2, 2)), .01);
  const J2Plastic<2> plane = law_at<2>(state);
  const J2Plastic<3> space = law_at<3>(state);
  EXPECT_LT((plane.cauchy_stress(corner<2>(H), -.4) - space.cauchy_stress(H, -.4)).norm(), 1e-14);
  EXPECT_NEAR(shape<2>(plane, corner<2>(H)).energy, shape<3>(space, H).energy, 1e-14);
  EXPECT_LT((plane.yield(corner<2>(H)).state.inverse_metric - space.yield(H).state.inverse_metric).norm(),
            1e-14);
}

TEST(PlasticityInSpace, RotationOfWhatHasYieldedRotatesTheStress)
{
  const Eigen::Matrix3d R =
      Eigen::AngleAxisd(1.9, Eigen::Vector3d(1., -2., .5).normalized()).toRotationMatrix();
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity(), H = general_gradient(), turned = R * (I + H) - I;
  const PlasticState state = worked_state<3>();
  const J2Plastic<3> law = law_at<3>(state);
  EXPECT_LT((law.cauchy_stress(turned, -.2) - R * law.cauchy_stress(H, -.2) * R.transpose()).norm(), 1e-13);
  EXPECT_NEAR(shape<3>(law, turned).energy, shape<3>(law, H).energy, 1e-13);
  const PlasticStep step = law.yield(H), turned_step = law.yield(turned);
  EXPECT_LT((step.state.inverse_metric - turned_step.state.inverse_metric).norm(), 1e-13);
  EXPECT_NEAR(step.work, turned_step.work, 1e-14);
  // A body that has never yielded may turn as it likes.
  EXPECT_EQ(law_at<3>(untouched).yield(R - I).work, 0.);
  EXPECT_LT(law_at<3>(untouched).cauchy_stress(R - I, 0.).norm(), 1e-14);
}

TEST(PlasticityInSpace, StretchingFollowsTheHardeningLineAndBack)
{
  // At constant volume, λ × λ^(−1/2) × λ^(−1/2): e = ln λ (1, −½, −½), in however many steps.
  const auto stretched = [](double logarithm)
  {
    return Eigen::Matrix3d(
        Eigen::Vector3d(std::expm1(logarithm), std::expm1(-.5 * logarithm), std::expm1(-.5 * logarithm))
            .asDiagonal());
  };
  const auto difference = [](const Eigen::Matrix3d &stress) { return stress(0, 0) - stress(1, 1); };
  const double end = std::log(3.);
  for (const unsigned int n_steps : {1u, 7u, 100u})
  {
    PlasticState state;
    double work = 0.;
    for (unsigned int n = 1; n <= n_steps; ++n)
    {
      const PlasticStep step = law_at<3>(state).yield(stretched(end * n / n_steps));
      state = step.state;
      work += step.work;
    }
    const double alpha = (3. * mu * end - first_yield) / (3. * mu + hardening),
                 limit = first_yield + hardening * alpha;
    const J2Plastic<3> law = law_at<3>(state);
    EXPECT_NEAR(state.equivalent_strain, alpha, 1e-13);
    EXPECT_NEAR(difference(law.cauchy_stress(stretched(end), 0.)), limit, 1e-12);
    EXPECT_NEAR(work, .5 * (first_yield + limit) * alpha, 1e-13);
    EXPECT_NEAR(state.inverse_metric(0, 0), std::expm1(-2. * alpha), 1e-13);
    // Back by twice the elastic strain it stays elastic, with the slope 3μ, and then yields the other way.
    const double elastic = limit / (3. * mu);
    EXPECT_NEAR(difference(law.cauchy_stress(stretched(end - elastic), 0.)), 0., 1e-12);
    EXPECT_NEAR(difference(law.cauchy_stress(stretched(end - 1.999 * elastic), 0.)), -.999 * limit, 1e-12);
    EXPECT_EQ(law.yield(stretched(end - 1.999 * elastic)).work, 0.);
    EXPECT_NEAR(law.yield(stretched(end - 3. * elastic)).state.equivalent_strain - alpha,
                limit / (3. * mu + hardening), 1e-13);
  }
}

TEST(PlasticityInSpace, ShearInOneStepFollowsItsClosedForm)
{
  // H_12 = γ: principal stretches exp(±asinh(γ/2)), with the first axis at tan 2θ = 2/γ.
  for (const double shear : {.06, .3, 2.})
  {
    Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
    H(0, 1) = shear;
    const double logarithm = std::asinh(.5 * shear),
                 alpha = (2. * std::sqrt(3.) * mu * logarithm - first_yield) / (3. * mu + hardening),
                 principal = (first_yield + hardening * alpha) / std::sqrt(3.);
    ASSERT_GT(alpha, 0.);
    const J2Plastic<3> law = law_at<3>(untouched);
    const Eigen::Matrix3d stress = law.cauchy_stress(H, 0.);
    EXPECT_NEAR(law.yield(H).state.equivalent_strain, alpha, 1e-14);
    EXPECT_NEAR(stress(0, 1), principal * 2. / std::hypot(2., shear), 1e-14);
    EXPECT_NEAR(stress(0, 0), principal * shear / std::hypot(2., shear), 1e-14);
    EXPECT_NEAR(mises(stress), first_yield + hardening * alpha, 1e-14);
  }
}

TEST(PlasticityInSpace, PerfectlyPlasticShearComesToStay)
{
  // With principal elastic stretches exp(±l), l = σ_y/(2√3 μ), the axes come to rest at tan θ = exp(−2l):
  // there σ_12 = σ_y/(√3 cosh 2l). Steps of finite length lag by their length.
  const double yield_in_shear = first_yield / std::sqrt(3.);
  const auto error = [&](unsigned int n_steps)
  {
    PlasticState state;
    Eigen::Matrix3d stress;
    for (unsigned int n = 1; n <= n_steps; ++n)
    {
      Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
      H(0, 1) = 4. * n / n_steps;
      const J2Plastic<3> law = law_at<3>(state, 0.);
      stress = law.cauchy_stress(H, 0.);
      state = law.yield(H).state;
    }
    EXPECT_NEAR(mises(stress), first_yield, 1e-12);
    return stress(0, 1) - yield_in_shear / std::cosh(yield_in_shear / mu);
  };
  const double coarse = error(1000), fine = error(4000);
  EXPECT_NEAR(coarse, 0., 2e-4 * yield_in_shear);
  EXPECT_NEAR(fine, .25 * coarse, .02 * std::abs(coarse));
}
} // namespace j2_plastic_test
