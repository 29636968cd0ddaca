// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace signorini
{
/// What a number of threads reaches at most, together.
struct MachineLimits
{
  double bandwidth; ///< of the triad a = b + s c on arrays larger than the caches, 24 bytes an entry [B/s]
  double peak;      ///< of the best instruction set [flop/s]
};

/// Measured at the first call for this number of threads, best of several repeats.
const MachineLimits &measure_limits(unsigned int n_threads);
} // namespace signorini
