// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

// Only for sources that are compiled once for each instruction set, as lanes.h.
#include "signorini/physics/lanes.h"

namespace signorini
{
namespace SIGNORINI_INSTRUCTION_SET
{
namespace
{
template <int dim>
ALWAYS_INLINE Lanes trace(const Tensor<dim> &H)
{
  Lanes sum = H[0][0];
  for (int i = 1; i < dim; ++i)
    sum += H[i][i];
  return sum;
}

/// det(I + H) − 1, without the round-off of small differences.
template <int dim>
ALWAYS_INLINE Lanes volume_strain(const Tensor<dim> &H)
{
  if constexpr (dim == 2)
    return trace<dim>(H) + (H[0][0] * H[1][1] - H[0][1] * H[1][0]);
  else
  {
    const Lanes minor[3] = {H[1][1] * H[2][2] - H[1][2] * H[2][1], H[1][2] * H[2][0] - H[1][0] * H[2][2],
                            H[1][0] * H[2][1] - H[1][1] * H[2][0]};
    const Lanes second_invariant =
        minor[0] + (H[0][0] * H[1][1] - H[0][1] * H[1][0]) + (H[0][0] * H[2][2] - H[0][2] * H[2][0]);
    return trace<dim>(H) + second_invariant + (H[0][0] * minor[0] + H[0][1] * minor[1] + H[0][2] * minor[2]);
  }
}

/// det F · F^(−T) of F = I + H.
template <int dim>
ALWAYS_INLINE void compute_cofactors(const Tensor<dim> &H, Tensor<dim> &cofactors)
{
  Tensor<dim> F;
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j)
      F[i][j] = i == j ? 1. + H[i][j] : H[i][j];
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j)
    {
      const int k = (i + 1) % dim, l = (i + 2) % dim, m = (j + 1) % dim, n = (j + 2) % dim;
      if constexpr (dim == 2)
        cofactors[i][j] = i == j ? F[k][m] : -F[k][m];
      else
        cofactors[i][j] = F[k][m] * F[l][n] - F[k][n] * F[l][m];
    }
}

/// The laws of material.h: strain of the volume, pressure of its mean, first Piola-Kirchhoff stress, and the
/// energy without that of the volume.
struct LinearElasticLaw
{
  template <int dim>
  static ALWAYS_INLINE Lanes volume(const Tensor<dim> &H)
  {
    return trace<dim>(H);
  }

  static ALWAYS_INLINE Lanes pressure(double bulk_modulus, Lanes strain) { return bulk_modulus * strain; }

  template <int dim>
  static ALWAYS_INLINE void compute_stress(double shear_modulus, Lanes pressure, const Tensor<dim> &H,
                                           Tensor<dim> &stress)
  {
    const Lanes of_diagonal = pressure - (2. / 3. * shear_modulus) * trace<dim>(H);
    for (int i = 0; i < dim; ++i)
    {
      stress[i][i] = 2. * shear_modulus * H[i][i] + of_diagonal;
      for (int j = 0; j < i; ++j)
        stress[i][j] = stress[j][i] = shear_modulus * (H[i][j] + H[j][i]);
    }
  }

  template <int dim>
  static ALWAYS_INLINE Lanes shape_energy(double shear_modulus, const Tensor<dim> &H)
  {
    const Lanes third_of_trace = trace<dim>(H) * (1. / 3.);
    Lanes norm_squared = dim == 2 ? third_of_trace * third_of_trace : Lanes{};
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
      {
        const Lanes deviator = 0.5 * (H[i][j] + H[j][i]) - (i == j ? third_of_trace : Lanes{});
        norm_squared += deviator * deviator;
      }
    return shear_modulus * norm_squared;
  }
};

struct NeoHookeanLaw
{
  template <int dim>
  static ALWAYS_INLINE Lanes volume(const Tensor<dim> &H)
  {
    return volume_strain<dim>(H);
  }

  static ALWAYS_INLINE Lanes pressure(double bulk_modulus, Lanes strain)
  {
    const Lanes ratio = 1. + strain;
    return (0.5 * bulk_modulus) * strain * (1. + ratio) / ratio;
  }

  // With C the cofactors and s = |F|² − 3: μ J^(−2/3) (H + (Hᵀ − s/3) C/J) + p C. There is no division.
  template <int dim>
  static ALWAYS_INLINE void compute_stress(double shear_modulus, Lanes pressure, const Tensor<dim> &H,
                                           Tensor<dim> &stress)
  {
    const Lanes root = inverse_cube_root(1. + volume_strain<dim>(H)), root_squared = root * root,
                of_gradient = shear_modulus * root_squared, of_product = of_gradient * (root_squared * root);
    const Lanes of_cofactors = pressure - of_product * stretch<dim>(H) * (1. / 3.);
    Tensor<dim> C;
    compute_cofactors<dim>(H, C);
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
      {
        Lanes product = H[0][i] * C[0][j];
        for (int k = 1; k < dim; ++k)
          product += H[k][i] * C[k][j];
        stress[i][j] = of_gradient * H[i][j] + of_product * product + of_cofactors * C[i][j];
      }
  }

  template <int dim>
  static ALWAYS_INLINE Lanes shape_energy(double shear_modulus, const Tensor<dim> &H)
  {
    const Lanes root_less_one = inverse_cube_root_less_one(volume_strain<dim>(H)),
                scale_less_one = root_less_one * (2. + root_less_one), s = stretch<dim>(H);
    return 0.5 * shear_modulus * (3. * scale_less_one + s + scale_less_one * s);
  }

  /// |F|² − 3.
  template <int dim>
  static ALWAYS_INLINE Lanes stretch(const Tensor<dim> &H)
  {
    Lanes sum = 2. * trace<dim>(H);
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        sum += H[i][j] * H[i][j];
    return sum;
  }
};
} // namespace
} // namespace SIGNORINI_INSTRUCTION_SET
} // namespace signorini
