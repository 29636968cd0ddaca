// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <mpi.h>

#include <functional>

namespace signorini
{
/// Calls `call` on every rank. If it throws a ProgramError on some, throws the one of the first of these, as
/// the same kind, on all, so that no rank waits for another that is gone. Collective.
void throw_together(const MPI_Comm &communicator, const std::function<void()> &call);
} // namespace signorini
