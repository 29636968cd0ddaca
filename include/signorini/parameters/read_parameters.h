// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/parameters/declarations.h"
#include "signorini/parameters/parameter_text.h"
#include "signorini/parameters/parameters.h"

namespace signorini
{
/// Everything that is declared for a parameter file. Names of bodies and obstacles are taken from its text.
Declarations declare_parameters(const ParameterText &text, Extent extent);

/// Check a parameter file completely and turn it into plain structs.
/// Throws InputError for a name, value or combination that is not allowed, FileError if the output directory
/// cannot be made or written to. Collective: all ranks throw the same.
Parameters read_parameters(const ParameterText &text);
} // namespace signorini
