// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/parameters/declarations.h"
#include "signorini/parameters/parameters.h"

#include <string>

namespace signorini
{
/// Declare `Body NAME` with all its subsections.
void declare_body(Declarations &declarations, const DeclarationScope &scope, const std::string &name);

/// Read and check it, boundaries by their names included; for the expressions see check_expressions(). Throws
/// InputError.
BodyParameters read_body(const ParameterText &text, const Declarations &in_use, const std::string &name,
                         unsigned int dimension);

/// The same, once for each of its copies on the lattice of `Copies`, named NAME.1, NAME.2, …; the body alone
/// where there is none.
std::vector<BodyParameters> read_body_and_copies(const ParameterText &text, const Declarations &in_use,
                                                 const std::string &name, unsigned int dimension);

/// The subsection that a body of this name, a copy or not, stands in.
std::string body_subsection(const std::string &name);
} // namespace signorini
