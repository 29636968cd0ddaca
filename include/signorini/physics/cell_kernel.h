// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/discretization/cell_table.h"
#include "signorini/physics/j2_plastic.h"

#include <type_traits>
#include <vector>

namespace signorini
{
/// Geometry of one cell, as pointers into a CellTable, and its memory.
struct CellGeometry
{
  unsigned int n_nodes = 0;
  unsigned int n_points = 0;
  const double *reference_gradients = nullptr; ///< [point][node][direction]
  const double *inverse_jacobians = nullptr;   ///< [point][d][j]
  const double *weights = nullptr;             ///< [point]
  const PlasticState *states = nullptr;        ///< [point] after the last accepted step; of J2Plastic only
};

template <int dim>
CellGeometry geometry_of(const CellTable<dim> &cells, unsigned int cell)
{
  const typename CellTable<dim>::Kind &kind = cells.kind_of(cell);
  return {kind.n_nodes, kind.n_points, kind.reference_gradients.data(), cells.cell_inverse_jacobians(cell),
          cells.cell_weights(cell)};
}

/// ∂u_i/∂X_j at a point of a cell; `u`: [node][component].
template <int dim>
Eigen::Matrix<double, dim, dim> displacement_gradient(const CellGeometry &cell, unsigned int point,
                                                      const double *u)
{
  double by_reference[dim][dim] = {};
  const double *g = cell.reference_gradients + point * cell.n_nodes * dim;
  for (unsigned int a = 0; a < cell.n_nodes; ++a)
    for (int i = 0; i < dim; ++i)
      for (int d = 0; d < dim; ++d)
        by_reference[i][d] += u[a * dim + i] * g[a * dim + d];
  const double *K = cell.inverse_jacobians + point * dim * dim;
  Eigen::Matrix<double, dim, dim> gradient;
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j)
    {
      gradient(i, j) = by_reference[i][0] * K[j];
      for (int d = 1; d < dim; ++d)
        gradient(i, j) += by_reference[i][d] * K[d * dim + j];
    }
  return gradient;
}

/// Adds −P : ∂δu/∂X of one point to `force` [node][component]; `stress`: P times the point's weight, by rows.
template <int dim>
void add_point_force(const CellGeometry &cell, unsigned int point, const double *stress, double *force)
{
  const double *K = cell.inverse_jacobians + point * dim * dim;
  double by_reference[dim][dim] = {};
  for (int i = 0; i < dim; ++i)
    for (int d = 0; d < dim; ++d)
      for (int j = 0; j < dim; ++j)
        by_reference[i][d] += stress[i * dim + j] * K[d * dim + j];
  const double *g = cell.reference_gradients + point * cell.n_nodes * dim;
  for (unsigned int a = 0; a < cell.n_nodes; ++a)
    for (int i = 0; i < dim; ++i)
      for (int d = 0; d < dim; ++d)
        force[a * dim + i] -= by_reference[i][d] * g[a * dim + d];
}

/// Energy, force and tangent of one cell of a given law. Keeps its scratch memory between cells.
///
/// Degree 1: W = Σ_q w_q ψ_shape(H_q) + V U(v̄), v̄ = Σ_q w_q v(H_q) / V, V = Σ_q w_q (mean dilatation).
/// Degree 2: W = Σ_q w_q [ψ_shape(H_q) + U(v(H_q))].
template <int dim, typename Law>
class CellKernel
{
public:
  CellKernel(const Law &material_law, unsigned int degree) : law(material_law), uses_mean_volume(degree == 1)
  {
  }

  /// `u`: [node][component].
  double energy(const CellGeometry &cell, const double *u);

  /// Adds −∂W/∂u to `force` [node][component].
  void add_force(const CellGeometry &cell, const double *u, double *force);

  /// Overwrites `tangent`, row-major with rows [node][component], with ∂²W/∂u∂u.
  void compute_tangent(const CellGeometry &cell, const double *u, double *tangent);

  /// Overwrites `stresses` [point] with the true stress, with its out-of-plane component in 2-D [Pa].
  void compute_stresses(const CellGeometry &cell, const double *u, Eigen::Matrix3d *stresses);

  /// The law as it is at a point: what remembers does so point by point.
  decltype(auto) law_at(const CellGeometry &cell, unsigned int point) const
  {
    if constexpr (std::is_same_v<Law, J2Plastic<dim>>)
    {
      Law there = law;
      there.state = &cell.states[point];
      return there;
    }
    else
      return (law);
  }

  /// Volume mean of H + Hᵀ + HᵀH.
  Eigen::Matrix<double, dim, dim> mean_stretch(const CellGeometry &cell, const double *u) const;

private:
  using Gradient = Eigen::Matrix<double, dim, dim>;

  /// Fills gradients and volume strains of all points, and the pressure and modulus that act at each.
  void evaluate_volume(const CellGeometry &cell, const double *u, Order order);

  Law law;
  bool uses_mean_volume;
  std::vector<Gradient> gradients;
  std::vector<VolumeStrain<dim>> volume_strains;
  std::vector<VolumeResponse> volumes; ///< one a point
  double cell_volume = 0.;
  std::vector<double> mean_strain_gradient; ///< Σ_q w_q ∂e_q/∂u [node][component]
};
} // namespace signorini
