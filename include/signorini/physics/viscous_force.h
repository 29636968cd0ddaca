// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/discretization/discretization.h"
#include "signorini/parameters/parameters.h"
#include "signorini/physics/state.h"

#include <functional>
#include <vector>

namespace signorini
{
/// The forces by which bodies with a viscosity η resist the rate of their strain, beside their elastic ones
/// (Kelvin and Voigt): with Ė = sym(FᵀḢ) the rate of Green's strain, S = 2η dev Ė and P = F S in bodies of
/// finite strain, and F = I in linear elastic ones; plane strain in 2-D. A rigid motion meets no resistance,
/// nor does one of the volume alone, and the dissipation 2η |dev Ė|² is never negative.
template <int dim>
class ViscousForce
{
public:
  /// `discretization` must outlive this object.
  ViscousForce(const std::vector<MaterialParameters> &materials, const Discretization<dim> &discretization);

  /// Adds the force at these displacements and velocities to local and ghost entries; the caller collects.
  void add_force(const State &state, const Vector &velocity, Vector &force) const;

  /// Calls `visit(cell, damping)` for every one of these own cells that has a viscosity, with the matrix that
  /// its force is minus the product of with its velocities [N s/m], row-major with rows [node][component].
  void for_each_damping(const std::vector<unsigned int> &cells, const State &state,
                        const std::function<void(unsigned int, const std::vector<double> &)> &visit) const;

private:
  struct Law
  {
    double viscosity = 0.; ///< η [Pa s]
    bool has_finite_strain = false;
  };

  bool is_viscous(unsigned int cell) const { return laws[discretization->cells.bodies[cell]].viscosity > 0.; }

  /// Adds the force of one cell, all [node][component].
  void add_cell_force(unsigned int cell, const double *displacement, const double *velocity,
                      double *force) const;

  const Discretization<dim> *discretization;
  std::vector<Law> laws; ///< one a body
};
} // namespace signorini
