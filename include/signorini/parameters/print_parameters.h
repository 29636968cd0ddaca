// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/parameters/parameter_text.h"

#include <iosfwd>
#include <string>
#include <vector>

namespace signorini
{
/// Formats of the list of all parameters.
enum class ParametersFormat
{
  prm,     ///< a commented parameter file
  json,    ///< that of dealii::ParameterHandler
  markdown ///< doc/parameters.md
};

/// "prm", "json" and "md".
std::vector<std::string> parameters_format_names();

/// The format of that name; throws InputError if there is none.
ParametersFormat parameters_format(const std::string &name);

/// Print all that can be set, with units, ranges, defaults and texts.
void print_parameters(ParametersFormat format, std::ostream &out);

/// Print the parameter file as used: with all defaults, overrides applied and includes resolved, without the
/// parts that are left out. The text must have passed read_parameters(). Reading the result gives the same
/// parameters.
void write_parameters_used(const ParameterText &text, std::ostream &out);
} // namespace signorini
