// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/output/output_lock.h"
#include "signorini/parameters/parameter_text.h"

#include <mpi.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace signorini
{
/// Calls `call` on rank 0. If it throws FileError there, throws it on all ranks. Collective.
void on_first_rank(const MPI_Comm &communicator, const std::function<void()> &call);

/// Makes an output directory if need be, and keeps other runs out of it as long as what is returned lives,
/// which is null on all ranks but the first. Throws FileError if it is in use or cannot be made. Collective.
std::unique_ptr<OutputLock> lock_directory(const std::string &directory, const MPI_Comm &communicator);

/// Makes an output directory ready for a run of `text` from the start: what an earlier run left goes. Throws
/// FileError if that cannot be removed, and if the text comes from there and has `overrides` (those of the
/// command line), which would be lost. Collective.
void clear_directory(const ParameterText &text, const std::vector<std::string> &overrides,
                     const std::string &directory, const MPI_Comm &communicator);

/// Writes parameters.prm, unless the text comes from it. Throws FileError. Collective.
void write_parameters(const ParameterText &text, const std::string &directory, const MPI_Comm &communicator);
} // namespace signorini
