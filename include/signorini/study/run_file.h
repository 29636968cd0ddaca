// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/simulation/command_line.h"

#include <mpi.h>

namespace signorini
{
/// Reads the parameter file of a command line, checks it, and makes its run or its study unless only
/// validation is asked for. Collective. Throws InputError, NumericalError and FileError, the same on all
/// ranks.
void run_file(const CommandLine &command_line, const MPI_Comm &communicator);
} // namespace signorini
