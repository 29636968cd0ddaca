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

/// Makes an output directory ready for a run of `text`: what an earlier run left goes, and parameters.prm is
/// written unless the text comes from it. What is returned keeps other runs out; it is null on all ranks but
/// the first. Throws FileError if the directory is in use or cannot be written, and if the text comes from
/// there and has `overrides` (those of the command line), which would be lost. Collective.
std::unique_ptr<OutputLock> prepare_directory(const ParameterText &text,
                                              const std::vector<std::string> &overrides,
                                              const std::string &directory, const MPI_Comm &communicator);
} // namespace signorini
