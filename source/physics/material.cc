// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/physics/material.h"

#include <Eigen/LU>
#include <boost/math/special_functions/log1p.hpp>

#include <cmath>
#include <limits>

namespace signorini
{
namespace
{
template <int dim>
double trace(const Eigen::Matrix<double, dim, dim> &H)
{
  return H.trace();
}

template <int dim>
Eigen::Matrix<double, dim, dim> to_matrix(const Eigen::Matrix<double, dim * dim, 1> &stress)
{
  return Eigen::Map<const Eigen::Matrix<double, dim, dim, Eigen::RowMajor>>(stress.data());
}
} // namespace

template <int dim>
double volume_strain_of(const Eigen::Matrix<double, dim, dim> &H)
{
  const double trace_of_square = (H * H).trace();
  const double second_invariant = 0.5 * (H.trace() * H.trace() - trace_of_square);
  return H.trace() + second_invariant + (dim == 3 ? H.determinant() : 0.);
}

template <int dim>
void LinearElastic<dim>::shape(const Gradient &H, Order order, ShapeResponse<dim> &response) const
{
  const double third_of_trace = trace<dim>(H) / 3.;
  double norm_squared = dim == 2 ? third_of_trace * third_of_trace : 0.;
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j)
    {
      const double deviator = 0.5 * (H(i, j) + H(j, i)) - (i == j ? third_of_trace : 0.);
      norm_squared += deviator * deviator;
      response.stress[i * dim + j] = 2. * shear_modulus * deviator;
    }
  response.energy = shear_modulus * norm_squared;
  if (order == Order::first)
    return;
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j)
      for (int k = 0; k < dim; ++k)
        for (int l = 0; l < dim; ++l)
          response.tangent(i * dim + j, k * dim + l) =
              shear_modulus * ((i == k) * (j == l) + (i == l) * (j == k) - 2. / 3. * (i == j) * (k == l));
}

template <int dim>
void LinearElastic<dim>::volume_strain(const Gradient &H, Order order, VolumeStrain<dim> &strain) const
{
  strain.value = trace<dim>(H);
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j)
      strain.gradient[i * dim + j] = (i == j);
  if (order == Order::second)
    strain.hessian.setZero();
}

template <int dim>
VolumeResponse LinearElastic<dim>::volume(double strain) const
{
  return {0.5 * bulk_modulus * strain * strain, bulk_modulus * strain, bulk_modulus};
}

template <int dim>
Eigen::Matrix3d LinearElastic<dim>::cauchy_stress(const Gradient &H, double pressure) const
{
  ShapeResponse<dim> response;
  shape(H, Order::first, response);
  Eigen::Matrix3d stress = pressure * Eigen::Matrix3d::Identity();
  stress.template topLeftCorner<dim, dim>() += to_matrix<dim>(response.stress);
  if (dim == 2)
    stress(2, 2) -= 2. / 3. * shear_modulus * trace<dim>(H);
  return stress;
}

template <int dim>
void NeoHookean<dim>::shape(const Gradient &H, Order order, ShapeResponse<dim> &response) const
{
  const Gradient F = Gradient::Identity() + H;
  const Gradient inverse_transpose = F.inverse().transpose();
  const double volume_logarithm = std::log1p(volume_strain_of<dim>(H)); // not a number where J < 0
  const double scale = std::exp(-2. / 3. * volume_logarithm);
  const double stretch = 2. * trace<dim>(H) + H.squaredNorm(); // |F|² − 3
  const double first_invariant = 3. + stretch;
  response.energy = 0.5 * shear_modulus * (3. * std::expm1(-2. / 3. * volume_logarithm) + scale * stretch);
  const double mu = shear_modulus * scale;
  // F − |F|²/3 F^(−T), with F^(−T) = I − Hᵀ F^(−T).
  const Gradient deviator = H + H.transpose() * inverse_transpose - stretch / 3. * inverse_transpose;
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j)
      response.stress[i * dim + j] = mu * deviator(i, j);
  if (order == Order::first)
    return;
  const auto &G = inverse_transpose;
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j)
      for (int k = 0; k < dim; ++k)
        for (int l = 0; l < dim; ++l)
          response.tangent(i * dim + j, k * dim + l) =
              mu * ((i == k) * (j == l) - 2. / 3. * (F(i, j) * G(k, l) + G(i, j) * F(k, l)) +
                    first_invariant * (2. / 9. * G(i, j) * G(k, l) + 1. / 3. * G(i, l) * G(k, j)));
}

template <int dim>
void NeoHookean<dim>::volume_strain(const Gradient &H, Order order, VolumeStrain<dim> &strain) const
{
  const Gradient F = Gradient::Identity() + H;
  const double J = F.determinant();
  const Gradient G = F.inverse().transpose();
  strain.value = volume_strain_of<dim>(H);
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j)
      strain.gradient[i * dim + j] = J * G(i, j);
  if (order == Order::first)
    return;
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j)
      for (int k = 0; k < dim; ++k)
        for (int l = 0; l < dim; ++l)
          strain.hessian(i * dim + j, k * dim + l) = J * (G(i, j) * G(k, l) - G(i, l) * G(k, j));
}

template <int dim>
VolumeResponse NeoHookean<dim>::volume(double strain) const
{
  // (v² − 1)/2 − ln v = e²/2 − (ln(1 + e) − e).
  const double ratio = 1. + strain;
  const double energy = strain > -1. ? 0.5 * strain * strain - boost::math::log1pmx(strain)
                                     : std::numeric_limits<double>::quiet_NaN();
  return {0.5 * bulk_modulus * energy, 0.5 * bulk_modulus * strain * (1. + ratio) / ratio,
          0.5 * bulk_modulus * (1. + 1. / (ratio * ratio))};
}

template <int dim>
Eigen::Matrix3d NeoHookean<dim>::cauchy_stress(const Gradient &H, double pressure) const
{
  const Gradient F = Gradient::Identity() + H;
  const double J = F.determinant();
  ShapeResponse<dim> response;
  shape(H, Order::first, response);
  Eigen::Matrix3d stress = pressure * Eigen::Matrix3d::Identity();
  stress.template topLeftCorner<dim, dim>() += to_matrix<dim>(response.stress) * F.transpose() / J;
  if (dim == 2)
    stress(2, 2) -= shear_modulus * std::pow(J, -5. / 3.) / 3. * (2. * trace<dim>(H) + H.squaredNorm());
  return stress;
}

template double volume_strain_of<2>(const Eigen::Matrix2d &);
template double volume_strain_of<3>(const Eigen::Matrix3d &);
template struct LinearElastic<2>;
template struct LinearElastic<3>;
template struct NeoHookean<2>;
template struct NeoHookean<3>;
} // namespace signorini
