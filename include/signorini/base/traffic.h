// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

namespace signorini
{
/// What one rank has sent to others, counted between the program and MPI: by the program itself and by all
/// libraries that it uses.
struct Traffic
{
  std::uint64_t n_messages = 0;    ///< to single ranks
  std::uint64_t n_bytes = 0;       ///< in these
  std::uint64_t n_collectives = 0; ///< calls that all ranks take part in: sums, extremes, gathering, barriers
  std::uint64_t n_collective_bytes = 0; ///< that this rank contributed to these
};

/// Of this rank, since the start of the program.
Traffic count_traffic();

Traffic operator-(const Traffic &later, const Traffic &earlier);
} // namespace signorini
