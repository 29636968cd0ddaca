// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/output/results.h"

namespace signorini
{
/// Compares a run with the exact solution that its parameters name. One function a case, in the table of the
/// source file; formulas in doc/theory.md. Throws NumericalError if there is nothing to compare: nothing
/// touches, or a number is not finite.
template <int dim>
std::vector<ErrorRow> compute_errors(const Results<dim> &results);

/// Pressure of the exact solution at a distance from the axis [Pa], where the case has one (Hertz).
bool has_exact_profile(const Parameters &parameters);

template <int dim>
double exact_pressure(const Results<dim> &results, double radius);

} // namespace signorini
