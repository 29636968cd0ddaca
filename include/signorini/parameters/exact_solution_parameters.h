// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/parameters/declarations.h"
#include "signorini/parameters/parameters.h"

namespace signorini
{
/// Declare `Exact solution`, with the keys that belong to its case.
void declare_exact_solution(Declarations &declarations, const DeclarationScope &scope);

ExactSolutionParameters read_exact_solution(const ParameterText &text, const Declarations &in_use,
                                            unsigned int dimension);

/// Names of the rows that are compared for a known exact solution, in their order.
std::vector<std::string> exact_solution_quantities(const std::string &name);

/// Throws InputError unless the scene is what its exact solution, if it names one, holds for.
void check_exact_solution(const ParameterText &text, const Parameters &parameters);
} // namespace signorini
