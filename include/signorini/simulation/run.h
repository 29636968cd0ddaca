// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/parameters/parameter_text.h"
#include "signorini/parameters/parameters.h"

#include <mpi.h>

#include <string>
#include <vector>

namespace signorini
{
/// What is shown on the screen beside errors.
enum class Screen
{
  all,
  nothing
};

/// Where a run begins.
enum class Start
{
  anew,
  at_checkpoint ///< the last one in Output/Directory
};

/// Makes one run of a text, already read, into its Output/Directory; `overrides` are those of the command
/// line. Throws InputError for a scene that cannot be run, before the directory is touched, or cannot go on
/// from its checkpoint, NumericalError and FileError, the same on all ranks. Collective.
void run(const ParameterText &text, const Parameters &parameters, const std::vector<std::string> &overrides,
         const MPI_Comm &communicator, Screen screen, Start start);

/// Builds all that a run begins with and prints what would be done. Throws as run(). Collective.
void print_plan(const ParameterText &text, const Parameters &parameters, const MPI_Comm &communicator,
                Screen screen);
} // namespace signorini
