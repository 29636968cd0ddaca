// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/parameters/declarations.h"
#include "signorini/parameters/parameters.h"

#include <variant>
#include <vector>

namespace signorini
{
/// Most that may be asked of 'Tolerance': beyond it Newton's method would stop before it has found which
/// points touch.
inline constexpr double largest_newton_tolerance = 1e-2;

/// Declare `Quasi-static`, `Explicit` and `Implicit`.
void declare_solver(Declarations &declarations, const DeclarationScope &scope);

/// The subsection of a run's kind.
std::string name_of(const SolverParameters &solver);

/// Read the one of them that is present; throws InputError if it is none or several.
SolverParameters read_solver(const ParameterText &text, const Declarations &in_use);

/// Declare `Adaptivity`.
void declare_adaptivity(Declarations &declarations, const DeclarationScope &scope);
AdaptivityParameters read_adaptivity(const ParameterText &text, const Declarations &in_use);

/// Declare `Output`. Its directory is output/NAME by default, NAME being that of the parameter file.
void declare_output(Declarations &declarations, const DeclarationScope &scope);
OutputParameters read_output(const ParameterText &text, const Declarations &in_use);
} // namespace signorini
