// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/parameters/parameter_text.h"

#include <optional>
#include <string>
#include <vector>

namespace signorini
{
/// What the user asked for.
struct CommandLine
{
  std::string file;                             ///< parameter file, "-" for standard input
  bool validate = false;                        ///< check everything, run nothing
  std::optional<std::string> parameters_format; ///< print all parameters as prm, json or md, and leave
  std::vector<std::string> overrides;           ///< "Section/Key=value"
  std::optional<std::string> output;            ///< instead of Output/Directory
  bool resume = false; ///< go on from a checkpoint; of a study: make only the runs that are not finished
  bool quiet = false;  ///< print errors only
  std::string answer;  ///< text of --help or --version: print it and leave with code 0
};

/// Throws InputError for an option that does not exist or has no value, and if there is no file although one
/// is needed.
CommandLine parse_command_line(int argc, const char *const *argv);

/// The parameter file of a command line, with its overrides and its output directory applied. Collective.
ParameterText read_parameter_text(const CommandLine &command_line);
} // namespace signorini
