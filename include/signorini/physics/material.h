// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Core>

namespace signorini
{
/// Laws in two parts, ψ(H) = ψ_shape(H) + U(e(H)), of the displacement gradient H_ij = ∂u_i/∂X_j: one of the
/// change of shape, one of the volume strain e = v − 1, with v the volume ratio. Elements of degree 1 take e
/// as its mean over the cell, which keeps them from locking; the energy stays an energy. In 2-D the strain is
/// plane: H_33 = 0 in formulas of three dimensions.
///
/// Stresses keep their digits however small the strain is: nothing is subtracted from 1.
///
/// Index pairs (i, j) are stored as i·dim + j.
template <int dim>
struct ShapeResponse
{
  double energy = 0.;                                  ///< ψ_shape [J/m³]
  Eigen::Matrix<double, dim * dim, 1> stress;          ///< ∂ψ_shape/∂H [Pa]
  Eigen::Matrix<double, dim * dim, dim * dim> tangent; ///< ∂²ψ_shape/∂H∂H [Pa]; only if asked for
};

/// e, ∂e/∂H and ∂²e/∂H∂H.
template <int dim>
struct VolumeStrain
{
  double value = 0.;
  Eigen::Matrix<double, dim * dim, 1> gradient;
  Eigen::Matrix<double, dim * dim, dim * dim> hessian; ///< only if asked for
};

/// U, U' and U'' at a volume strain.
struct VolumeResponse
{
  double energy = 0.;   ///< [J/m³]
  double pressure = 0.; ///< U' [Pa]
  double modulus = 0.;  ///< U'' [Pa]
};

enum class Order
{
  first, ///< energy and stress
  second ///< tangents too
};

/// det(I + H) − 1.
template <int dim>
double volume_strain_of(const Eigen::Matrix<double, dim, dim> &H);

/// Small strain: ψ_shape = μ |dev ε|², e = tr ε, U = κ/2 e².
template <int dim>
struct LinearElastic
{
  double shear_modulus; ///< μ [Pa]
  double bulk_modulus;  ///< κ [Pa]

  using Gradient = Eigen::Matrix<double, dim, dim>;
  void shape(const Gradient &H, Order order, ShapeResponse<dim> &response) const;
  void volume_strain(const Gradient &H, Order order, VolumeStrain<dim> &strain) const;
  VolumeResponse volume(double strain) const;

  /// True stress with its out-of-plane component; `pressure` is U' [Pa].
  Eigen::Matrix3d cauchy_stress(const Gradient &H, double pressure) const;
};

/// Compressible neo-Hookean, with F = I + H, J = det F: ψ_shape = μ/2 (J^(−2/3) |F|² − 3), v = J = 1 + e,
/// U = κ/2 ((v² − 1)/2 − ln v). (J. C. Simo, R. L. Taylor, K. S. Pister, 1985.)
/// Not a number where J ≤ 0: solvers see it in the energy.
template <int dim>
struct NeoHookean
{
  double shear_modulus; ///< μ [Pa]
  double bulk_modulus;  ///< κ [Pa]

  using Gradient = Eigen::Matrix<double, dim, dim>;
  void shape(const Gradient &H, Order order, ShapeResponse<dim> &response) const;
  void volume_strain(const Gradient &H, Order order, VolumeStrain<dim> &strain) const;
  VolumeResponse volume(double strain) const;

  /// True stress with its out-of-plane component; `pressure` is U' [Pa].
  Eigen::Matrix3d cauchy_stress(const Gradient &H, double pressure) const;
};
} // namespace signorini
