// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/coupling/contact_force.h"

namespace signorini
{
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
