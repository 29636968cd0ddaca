// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/parameters/declarations.h"
#include "signorini/parameters/parameters.h"

#include <map>
#include <string>

namespace signorini
{
/// Declare `Checkpoint`.
void declare_checkpoint(Declarations &declarations, const DeclarationScope &scope);
CheckpointParameters read_checkpoint(const ParameterText &text, const Declarations &in_use);

/// Throws InputError where there is `Checkpoint` for a run with something that no checkpoint holds.
void check_checkpoint(const ParameterText &text, const Parameters &parameters);

/// "Section/Key" and value in use of all entries that shape a run up to any time: all but those of `Output`,
/// `Checkpoint` and `Exact solution` and the end time. The text must have passed read_parameters().
std::map<std::string, std::string> scene_entries(const ParameterText &text);

/// Throws InputError if these entries are not those that the run began with.
void check_unchanged(const ParameterText &text, const std::map<std::string, std::string> &at_the_start);
} // namespace signorini
