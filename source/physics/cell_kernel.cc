// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/physics/cell_kernel.h"

#include <algorithm>

namespace signorini
{
template <int dim, typename Law>
void CellKernel<dim, Law>::evaluate_volume(const CellGeometry &cell, const double *u, Order order)
{
  gradients.resize(cell.n_points);
  volume_strains.resize(cell.n_points);
  volumes.resize(cell.n_points);
  cell_volume = 0.;
  double mean_strain = 0.;
  for (unsigned int q = 0; q < cell.n_points; ++q)
  {
    gradients[q] = displacement_gradient<dim>(cell, q, u);
    law.volume_strain(gradients[q], order, volume_strains[q]);
    cell_volume += cell.weights[q];
    mean_strain += cell.weights[q] * volume_strains[q].value;
  }
  mean_strain /= cell_volume;
  for (unsigned int q = 0; q < cell.n_points; ++q)
    volumes[q] = law.volume(uses_mean_volume ? mean_strain : volume_strains[q].value);
}

template <int dim, typename Law>
double CellKernel<dim, Law>::energy(const CellGeometry &cell, const double *u)
{
  evaluate_volume(cell, u, Order::first);
  double energy = 0.;
  ShapeResponse<dim> response;
  for (unsigned int q = 0; q < cell.n_points; ++q)
  {
    law_at(cell, q).shape(gradients[q], Order::first, response);
    energy += cell.weights[q] * (response.energy + volumes[q].energy);
  }
  return energy;
}

template <int dim, typename Law>
void CellKernel<dim, Law>::add_force(const CellGeometry &cell, const double *u, double *force)
{
  evaluate_volume(cell, u, Order::first);
  ShapeResponse<dim> response;
  for (unsigned int q = 0; q < cell.n_points; ++q)
  {
    law_at(cell, q).shape(gradients[q], Order::first, response);
    double stress[dim * dim];
    for (int i = 0; i < dim * dim; ++i)
      stress[i] =
          cell.weights[q] * (response.stress[i] + volumes[q].pressure * volume_strains[q].gradient[i]);
    add_point_force<dim>(cell, q, stress, force);
  }
}

namespace
{
/// Turns a second derivative by ∂u_i/∂X_j, at i dim + j, into one by ∂u_i/∂ξ_d.
template <int dim>
void pull_back(const Eigen::Matrix<double, dim, dim> &inverse_jacobian,
               Eigen::Matrix<double, dim * dim, dim * dim> &tangent)
{
  for (int i = 0; i < dim; ++i)
  {
    auto rows = tangent.template middleRows<dim>(i * dim);
    rows = (inverse_jacobian * rows).eval();
  }
  for (int i = 0; i < dim; ++i)
  {
    auto columns = tangent.template middleCols<dim>(i * dim);
    columns = (columns * inverse_jacobian.transpose()).eval();
  }
}
} // namespace

template <int dim, typename Law>
void CellKernel<dim, Law>::compute_tangent(const CellGeometry &cell, const double *u, double *tangent)
{
  const unsigned int n = cell.n_nodes * dim;
  std::fill(tangent, tangent + n * n, 0.);
  mean_strain_gradient.assign(n, 0.);
  evaluate_volume(cell, u, Order::second);
  ShapeResponse<dim> response;
  for (unsigned int q = 0; q < cell.n_points; ++q)
  {
    law_at(cell, q).shape(gradients[q], Order::second, response);
    Eigen::Matrix<double, dim * dim, dim *dim> A =
        response.tangent + volumes[q].pressure * volume_strains[q].hessian;
    if (!uses_mean_volume)
      A += volumes[q].modulus * volume_strains[q].gradient * volume_strains[q].gradient.transpose();
    A *= cell.weights[q];
    // From here on by the reference coordinates.
    const Gradient inverse_jacobian = Eigen::Map<const Eigen::Matrix<double, dim, dim, Eigen::RowMajor>>(
        cell.inverse_jacobians + q * dim * dim);
    pull_back<dim>(inverse_jacobian, A);
    Eigen::Matrix<double, dim * dim, 1> strain_gradient = volume_strains[q].gradient;
    for (int i = 0; i < dim; ++i)
      strain_gradient.template segment<dim>(i * dim) =
          (inverse_jacobian * strain_gradient.template segment<dim>(i * dim)).eval();
    const double *g = cell.reference_gradients + q * cell.n_nodes * dim;
    for (unsigned int a = 0; a < cell.n_nodes; ++a)
      for (int i = 0; i < dim; ++i)
      {
        double row[dim * dim] = {};
        for (int j = 0; j < dim; ++j)
          for (int kl = 0; kl < dim * dim; ++kl)
            row[kl] += g[a * dim + j] * A(i * dim + j, kl);
        double *tangent_row = tangent + (a * dim + i) * n;
        for (unsigned int b = 0; b < cell.n_nodes; ++b)
          for (int k = 0; k < dim; ++k)
            for (int l = 0; l < dim; ++l)
              tangent_row[b * dim + k] += row[k * dim + l] * g[b * dim + l];
        for (int j = 0; j < dim; ++j)
          mean_strain_gradient[a * dim + i] +=
              cell.weights[q] * strain_gradient[i * dim + j] * g[a * dim + j];
      }
  }
  if (uses_mean_volume)
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        tangent[i * n + j] +=
            volumes[0].modulus / cell_volume * mean_strain_gradient[i] * mean_strain_gradient[j];
}

template <int dim, typename Law>
Eigen::Matrix<double, dim, dim> CellKernel<dim, Law>::mean_stretch(const CellGeometry &cell,
                                                                   const double *u) const
{
  Gradient sum = Gradient::Zero();
  double volume = 0.;
  for (unsigned int q = 0; q < cell.n_points; ++q)
  {
    const Gradient H = displacement_gradient<dim>(cell, q, u);
    sum += cell.weights[q] * (H + H.transpose() + H.transpose() * H);
    volume += cell.weights[q];
  }
  return sum / volume;
}

template <int dim, typename Law>
void CellKernel<dim, Law>::compute_stresses(const CellGeometry &cell, const double *u,
                                            Eigen::Matrix3d *stresses)
{
  evaluate_volume(cell, u, Order::first);
  for (unsigned int q = 0; q < cell.n_points; ++q)
    stresses[q] = law_at(cell, q).cauchy_stress(gradients[q], volumes[q].pressure);
}

template class CellKernel<2, LinearElastic<2>>;
template class CellKernel<3, LinearElastic<3>>;
template class CellKernel<2, NeoHookean<2>>;
template class CellKernel<3, NeoHookean<3>>;
template class CellKernel<2, J2Plastic<2>>;
template class CellKernel<3, J2Plastic<3>>;
} // namespace signorini
