// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <mpi.h>

#include <string>

namespace signorini
{
/// From now on the first SIGINT and the first SIGTERM are noted instead of ending the program; a second one
/// ends it.
void watch_for_interruption();

/// Name of a signal that any rank has received; empty if there was none. Collective.
std::string interruption(const MPI_Comm &communicator);
} // namespace signorini
