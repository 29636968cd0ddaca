// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/physics/material.h"

#include <Eigen/LU>

#include <cmath>

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
void LinearElastic<dim>::volume_ratio(const Gradient &H, Order order, VolumeRatio<dim> &ratio) const
{
  ratio.value = 1. + trace<dim>(H);
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j)
      ratio.gradient[i * dim + j] = (i == j);
  if (order == Order::second)
    ratio.hessian.setZero();
}

template <int dim>
VolumeResponse LinearElastic<dim>::volume(double ratio) const
{
  const double strain = ratio - 1.;
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
  const double J = F.determinant();
  const Gradient inverse_transpose = F.inverse().transpose();
  const double scale = std::pow(J, -2. / 3.);
  const double first_invariant = F.squaredNorm() + (dim == 2 ? 1. : 0.);
  response.energy = 0.5 * shear_modulus * (scale * first_invariant - 3.);
  const double mu = shear_modulus * scale;
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j)
      response.stress[i * dim + j] = mu * (F(i, j) - first_invariant / 3. * inverse_transpose(i, j));
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
void NeoHookean<dim>::volume_ratio(const Gradient &H, Order order, VolumeRatio<dim> &ratio) const
{
  const Gradient F = Gradient::Identity() + H;
  const double J = F.determinant();
  const Gradient G = F.inverse().transpose();
  ratio.value = J;
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j)
      ratio.gradient[i * dim + j] = J * G(i, j);
  if (order == Order::first)
    return;
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j)
      for (int k = 0; k < dim; ++k)
        for (int l = 0; l < dim; ++l)
          ratio.hessian(i * dim + j, k * dim + l) = J * (G(i, j) * G(k, l) - G(i, l) * G(k, j));
}

template <int dim>
VolumeResponse NeoHookean<dim>::volume(double ratio) const
{
  return {0.5 * bulk_modulus * (0.5 * (ratio * ratio - 1.) - std::log(ratio)), 0.5 * bulk_modulus * (ratio - 1. / ratio),
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
    stress(2, 2) += shear_modulus * std::pow(J, -5. / 3.) * (1. - (F.squaredNorm() + 1.) / 3.);
  return stress;
}

template struct LinearElastic<2>;
template struct LinearElastic<3>;
template struct NeoHookean<2>;
template struct NeoHookean<3>;
} // namespace signorini
