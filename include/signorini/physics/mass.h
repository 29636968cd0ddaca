// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/discretization/discretization.h"

namespace signorini
{
/// Lumped mass of every degree of freedom [kg; kg/m in 2-D]: the nodal quadrature rule, hanging nodes shared among
/// their masters. Positive for degrees 1 and 2.
template <int dim>
Vector make_lumped_mass(const std::vector<MaterialParameters> &materials, const Discretization<dim> &discretization);

/// Volume [m³; m² in 2-D] that every degree of freedom stands for, by the same rule.
template <int dim>
Vector make_nodal_volume(const Discretization<dim> &discretization);
} // namespace signorini
