// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/physics/material.h"

#include <array>

namespace signorini
{
/// What a point that has yielded remembers, always in three dimensions.
struct PlasticState
{
  Eigen::Matrix3d inverse_metric = Eigen::Matrix3d::Zero(); ///< C_p⁻¹ − I, with det C_p = 1
  double equivalent_strain = 0.;                            ///< α, of all yielding so far

  template <typename Archive>
  void serialize(Archive &archive, unsigned int /*version*/)
  {
    archive &inverse_metric &equivalent_strain;
  }
};

/// What yielding has made of a point.
struct PlasticStep
{
  PlasticState state;
  double work = 0.; ///< ∫ σ_y dα of the step [J/m³]
};

/// Elastic and plastic, finite strain: F = F_e F_p, yielding of von Mises with isotropic hardening,
/// σ_y = yield stress + hardening modulus · α, and Hencky's logarithmic elasticity. With e the deviator of
/// ½ ln(F C_p⁻¹ Fᵀ) and C_p, α those of the last accepted step,
///
///   ψ_shape = min over Δα ≥ 0 of μ (|e| − √(3/2) Δα)² + ∫ σ_y dα   (M. Ortiz, L. Stainier, 1999),
///
/// whose gradient is the stress at the end of the step; v and U are those of NeoHookean. Not a number where
/// J ≤ 0. See doc/theory.md, section 1.
template <int dim>
struct J2Plastic
{
  double shear_modulus;                ///< μ [Pa]
  double bulk_modulus;                 ///< κ [Pa]
  double yield_stress;                 ///< of what has never yielded, in uniaxial tension [Pa]
  double hardening_modulus;            ///< [Pa]
  const PlasticState *state = nullptr; ///< of the point, after the last accepted step

  using Gradient = Eigen::Matrix<double, dim, dim>;
  void shape(const Gradient &H, Order order, ShapeResponse<dim> &response) const;
  void volume_strain(const Gradient &H, Order order, VolumeStrain<dim> &strain) const;
  VolumeResponse volume(double strain) const;

  /// True stress with its out-of-plane component; `pressure` is U' [Pa].
  Eigen::Matrix3d cauchy_stress(const Gradient &H, double pressure) const;

  /// What the point would remember after a step to H.
  PlasticStep yield(const Gradient &H) const;

  /// What the point remembers at H, as numbers that may be interpolated: its elastic strain e by the rows of
  /// its upper triangle, whose trace is 0, and α. Stresses depend on e alone, which yielding keeps small.
  using Memory = std::array<double, 7>;
  Memory memory(const Gradient &H) const;

  /// The state that has this memory at H: C_p⁻¹ = J^⅔ F⁻¹ exp(2e) F⁻ᵀ. Untouched unless α > 0.
  static PlasticState recall(const Gradient &H, const Memory &memory);
};
} // namespace signorini
