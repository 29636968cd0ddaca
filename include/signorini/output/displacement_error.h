// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/discretization/discretization.h"
#include "signorini/parameters/parameters.h"

namespace signorini
{
/// Distances of a displacement from an exact one, and the exact one's own norms.
struct DisplacementError
{
  double displacement = 0., displacement_norm = 0.; ///< L2 norms [m^(1 + dim/2)]
  double energy = 0., energy_norm = 0.;             ///< √∫ ε : C : ε dV [J^½; (J/m)^½ in 2-D]
};

/// Compares with the formulas of an exact solution at time t, whose gradient is taken by central differences
/// (collective). Small strain.
template <int dim>
DisplacementError measure_displacement_error(const Discretization<dim> &discretization,
                                             const std::vector<MaterialParameters> &materials,
                                             const Vector &displacement,
                                             const std::vector<std::string> &formulas, double t);
} // namespace signorini
