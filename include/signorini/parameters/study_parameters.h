// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/parameters/declarations.h"
#include "signorini/parameters/parameters.h"

namespace signorini
{
/// Names of the estimated errors among the quantities of a study.
inline constexpr const char *estimated_discretization = "estimated discretization";
inline constexpr const char *estimated_contact = "estimated contact";

/// The key of the list of a factor in `Study`.
const std::string &study_key(StudyParameters::Factor factor);

/// Declare `Study`.
void declare_study(Declarations &declarations, const DeclarationScope &scope);

/// Throws InputError for a list without effect in this file, a value that stands twice, and a quantity that
/// the exact solution has not. `parameters`: all else that the file says. Whether the values of the lists are
/// valid where they are put is found by read_parameters() of each run.
StudyParameters read_study(const ParameterText &text, const Declarations &in_use,
                           const Parameters &parameters);
} // namespace signorini
