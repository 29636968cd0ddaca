// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/coupling/contact_force.h"
#include "signorini/physics/internal_force.h"
#include "signorini/physics/viscous_force.h"

namespace signorini
{
/// Largest squared natural frequency of the bodies [1/s²]: the maximum over cells of the largest eigenvalue
/// of (cell tangent, cell lumped mass), which bounds that of the assembled system from above (B. Irons,
/// 1970).
template <int dim>
double compute_bulk_frequency_squared(const InternalForce<dim> &elasticity,
                                      const std::vector<MaterialParameters> &materials,
                                      const Discretization<dim> &discretization);

/// The same of the damping by viscosity [1/s].
template <int dim>
double compute_bulk_damping_rate(const ViscousForce<dim> &viscosity, const State &state,
                                 const std::vector<MaterialParameters> &materials,
                                 const Discretization<dim> &discretization);

/// What contact adds to the frequencies at most.
struct ContactBound
{
  double frequency_squared =
      0.;                   ///< max over nodes of the row sum of the contact stiffness over the mass [1/s²]
  double damping_rate = 0.; ///< the same of the damping matrix [1/s]

  template <typename Archive>
  void serialize(Archive &archive, unsigned int /*version*/)
  {
    archive &frequency_squared &damping_rate;
  }
};

template <int dim>
ContactBound compute_contact_bound(const std::vector<const ContactTerm<dim> *> &contacts, const Vector &mass,
                                   const Discretization<dim> &discretization);

/// Stability bound of the central-difference scheme with damping forces taken from the velocity half a step
/// before: ω²Δt² + 2γΔt ≤ 4, so Δt = (√(γ² + 4ω²) − γ)/ω² (doc/theory.md).
double critical_time_step(double frequency_squared, double damping_rate);
} // namespace signorini
