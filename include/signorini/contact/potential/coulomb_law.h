// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/base/spatial_vector.h"

namespace signorini::contact
{
/// How the elastic slip follows the trial one and the pressure.
template <int dim>
struct SlipDerivatives
{
  SpatialTensor<dim> by_trial;    ///< ∂s/∂s_trial; symmetric
  SpatialVector<dim> by_pressure; ///< ∂s/∂p [m/Pa]
};

/// Coulomb's friction at one point. Behind its traction τ = −k_T s [Pa] is an elastic slip s [m], a vector in
/// the tangent plane, and |k_T s| ≤ μ p.
struct CoulombLaw
{
  double coefficient = 0.; ///< μ ≥ 0
  double stiffness = 0.;   ///< k_T > 0 [Pa/m]

  /// Largest elastic slip under the pressure p ≥ 0, μp/k_T [m].
  template <typename Number>
  Number limit(const Number &pressure) const
  {
    return coefficient / stiffness * pressure;
  }

  /// What is elastic of a trial slip that all were elastic: all of it (stick), or as much as the limit in its
  /// direction, the rest having slid.
  template <typename Vector>
  Vector find_elastic_slip(const Vector &trial, const typename Vector::Scalar &pressure) const
  {
    const typename Vector::Scalar length = trial.norm(), longest = limit(pressure);
    if (length <= longest)
      return trial;
    const typename Vector::Scalar share = longest / length;
    return share * trial;
  }

  /// Derivatives of find_elastic_slip(); on the edge of the cone those of stick.
  template <int dim>
  SlipDerivatives<dim> differentiate(const SpatialVector<dim> &trial, double pressure) const
  {
    const double length = trial.norm(), longest = limit(pressure);
    if (length <= longest)
      return {SpatialTensor<dim>::Identity(), SpatialVector<dim>::Zero()};
    const SpatialVector<dim> direction = trial / length;
    return {longest / length * (SpatialTensor<dim>::Identity() - direction * direction.transpose()),
            coefficient / stiffness * direction};
  }
};
} // namespace signorini::contact
