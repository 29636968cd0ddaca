// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/physics/j2_plastic.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <cmath>
#include <limits>

namespace signorini
{
namespace
{
template <int dim>
Eigen::Matrix3d in_space(const Eigen::Matrix<double, dim, dim> &H)
{
  Eigen::Matrix3d in_three = Eigen::Matrix3d::Zero();
  in_three.topLeftCorner<dim, dim>() = H;
  return in_three;
}

/// What a step to some deformation is before and after yielding, along the axes of F C_p⁻¹ Fᵀ.
struct Return
{
  Eigen::Matrix3d axes;      ///< principal, as columns
  Eigen::Vector3d stretches; ///< squares of the elastic ones before yielding, minus 1
  Eigen::Vector3d strain;    ///< e, the deviator of the logarithmic one, before yielding
  double norm;               ///< |e|
  double increment;          ///< Δα
  double share = 1.;         ///< of e that is left after yielding

  /// The deviator of Kirchhoff's stress.
  Eigen::Matrix3d stress(double shear_modulus) const
  {
    return 2. * shear_modulus * share * axes * strain.asDiagonal() * axes.transpose();
  }
};

template <int dim>
Return return_to_yield_surface(const J2Plastic<dim> &law, const Eigen::Matrix<double, dim, dim> &gradient)
{
  const Eigen::Matrix3d H = in_space<dim>(gradient), F = Eigen::Matrix3d::Identity() + H,
                        pushed = F * law.state->inverse_metric * F.transpose();
  const Eigen::Matrix3d stretch = H + H.transpose() + H * H.transpose() + pushed;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(stretch);
  Return result;
  result.axes = eigen.eigenvectors();
  result.stretches = eigen.eigenvalues();
  const double volume_logarithm = std::log1p(volume_strain_of<dim>(gradient)); // not a number where J < 0
  for (int a = 0; a < 3; ++a)
    result.strain[a] = 0.5 * std::log1p(result.stretches[a]) - volume_logarithm / 3.;
  result.norm = result.strain.norm();

  const double mu = law.shear_modulus, h = law.hardening_modulus;
  const double limit = (law.yield_stress + h * law.state->equivalent_strain) / (std::sqrt(6.) * mu);
  // What has just yielded to its surface stays elastic there, whatever the round-off of its strain.
  const double round_off = 64. * std::numeric_limits<double>::epsilon() * (H.norm() + pushed.norm());
  const bool does_yield = result.norm > limit + round_off;
  result.increment = does_yield ? std::sqrt(6.) * mu * (result.norm - limit) / (3. * mu + h) : 0.;
  if (does_yield)
    result.share = 1. - std::sqrt(1.5) * result.increment / result.norm;
  return result;
}

template <int dim>
double plastic_work(const J2Plastic<dim> &law, double increment)
{
  return increment *
         (law.yield_stress + law.hardening_modulus * (law.state->equivalent_strain + 0.5 * increment));
}

/// log(1 + x)/x.
double logarithmic_slope(double x)
{
  return x == 0. ? 1. : std::log1p(x) / x;
}

/// What the deviator of Kirchhoff's stress changes by under a velocity gradient, both along the axes. Where
/// two principal stretches agree, so do the principal stresses: the quotient of their differences has a
/// limit.
template <int dim>
Eigen::Matrix3d change_of_stress(const J2Plastic<dim> &law, const Return &here,
                                 const Eigen::Matrix3d &velocity)
{
  const double two_mu = 2. * law.shear_modulus, third_of_trace = velocity.trace() / 3.;
  const bool does_yield = here.increment > 0.;
  const Eigen::Vector3d direction =
      does_yield ? Eigen::Vector3d(here.strain / here.norm) : Eigen::Vector3d::Zero().eval();
  const double h = law.hardening_modulus,
               along = (h / (3. * law.shear_modulus + h) - here.share) * direction.dot(velocity.diagonal());
  Eigen::Matrix3d change;
  for (int a = 0; a < 3; ++a)
  {
    change(a, a) = two_mu * (here.share * (velocity(a, a) - third_of_trace) + along * direction[a]);
    for (int b = 0; b < a; ++b)
    {
      const double ratio = (here.stretches[a] - here.stretches[b]) / (1. + here.stretches[b]);
      change(a, b) = change(b, a) = law.shear_modulus * here.share * logarithmic_slope(ratio) *
                                    (velocity(a, b) + (1. + ratio) * velocity(b, a));
    }
  }
  return change;
}
} // namespace

template <int dim>
void J2Plastic<dim>::shape(const Gradient &H, Order order, ShapeResponse<dim> &response) const
{
  const Return here = return_to_yield_surface(*this, H);
  const Eigen::Matrix3d G = (Eigen::Matrix3d::Identity() + in_space<dim>(H)).inverse().transpose(),
                        P = here.stress(shear_modulus) * G;
  const double elastic_norm = here.share * here.norm;
  response.energy = shear_modulus * elastic_norm * elastic_norm + plastic_work(*this, here.increment);
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j)
      response.stress[i * dim + j] = P(i, j);
  if (order == Order::second)
    for (int k = 0; k < dim; ++k)
      for (int l = 0; l < dim; ++l)
      {
        const Eigen::Matrix3d velocity =
            here.axes.row(k).transpose() * (here.axes.transpose() * G.col(l)).transpose();
        const Eigen::Matrix3d change =
            here.axes * change_of_stress(*this, here, velocity) * here.axes.transpose() * G -
            P.col(l) * G.row(k);
        for (int i = 0; i < dim; ++i)
          for (int j = 0; j < dim; ++j)
            response.tangent(i * dim + j, k * dim + l) = change(i, j);
      }
}

template <int dim>
void J2Plastic<dim>::volume_strain(const Gradient &H, Order order, VolumeStrain<dim> &strain) const
{
  NeoHookean<dim>{shear_modulus, bulk_modulus}.volume_strain(H, order, strain);
}

template <int dim>
VolumeResponse J2Plastic<dim>::volume(double strain) const
{
  return NeoHookean<dim>{shear_modulus, bulk_modulus}.volume(strain);
}

template <int dim>
Eigen::Matrix3d J2Plastic<dim>::cauchy_stress(const Gradient &H, double pressure) const
{
  return return_to_yield_surface(*this, H).stress(shear_modulus) / (1. + volume_strain_of<dim>(H)) +
         pressure * Eigen::Matrix3d::Identity();
}

template <int dim>
PlasticStep J2Plastic<dim>::yield(const Gradient &H) const
{
  const Return here = return_to_yield_surface(*this, H);
  if (here.increment == 0.)
    return {*state, 0.};
  // Along the axes the squares of the elastic stretches become those before yielding times exp(−2 Δε_p).
  Eigen::Vector3d changes;
  for (int a = 0; a < 3; ++a)
    changes[a] = (1. + here.stretches[a]) * std::expm1(-2. * (1. - here.share) * here.strain[a]);
  const Eigen::Matrix3d pulled_axes = (Eigen::Matrix3d::Identity() + in_space<dim>(H)).inverse() * here.axes;
  return {{state->inverse_metric + pulled_axes * changes.asDiagonal() * pulled_axes.transpose(),
           state->equivalent_strain + here.increment},
          plastic_work(*this, here.increment)};
}

template <int dim>
auto J2Plastic<dim>::memory(const Gradient &H) const -> Memory
{
  const Return here = return_to_yield_surface(*this, H);
  const Eigen::Matrix3d e = here.share * here.axes * here.strain.asDiagonal() * here.axes.transpose();
  return {e(0, 0), e(0, 1), e(0, 2), e(1, 1), e(1, 2), e(2, 2), state->equivalent_strain};
}

template <int dim>
PlasticState J2Plastic<dim>::recall(const Gradient &gradient, const Memory &m)
{
  if (!(m[6] > 0.))
    return {};
  Eigen::Matrix3d logarithm; // of the squares of the elastic stretches
  logarithm << m[0], m[1], m[2], m[1], m[3], m[4], m[2], m[4], m[5];
  logarithm *= 2.;
  logarithm.diagonal().array() += 2. / 3. * std::log1p(volume_strain_of<dim>(gradient));
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(logarithm);
  const Eigen::Matrix3d H = in_space<dim>(gradient), inverse = (Eigen::Matrix3d::Identity() + H).inverse(),
                        stretch = eigen.eigenvectors() *
                                  eigen.eigenvalues()
                                      .array()
                                      .unaryExpr([](double x) { return std::expm1(x); })
                                      .matrix()
                                      .asDiagonal() *
                                  eigen.eigenvectors().transpose();
  return {inverse * (stretch - H - H.transpose() - H * H.transpose()) * inverse.transpose(), m[6]};
}

template struct J2Plastic<2>;
template struct J2Plastic<3>;
} // namespace signorini
