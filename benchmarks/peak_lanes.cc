// SPDX-License-Identifier: LGPL-2.1-or-later
// Compiled once for each instruction set.
#include "peak.h"

#include "signorini/physics/lanes.h"

namespace signorini
{
namespace SIGNORINI_INSTRUCTION_SET
{
double run_peak(unsigned int n, double &sink)
{
  // Two units with a latency of four cycles take eight independent sums; twelve fit in all register files.
  constexpr int n_sums = 12;
  Lanes sums[n_sums], factor = {}, summand = {};
  factor += 0.999;
  summand += 1e-3;

  for (int i = 0; i < n_sums; ++i)
    sums[i] = summand * i;
  for (unsigned int round = 0; round < n; ++round)
#pragma GCC unroll 12
    for (int i = 0; i < n_sums; ++i)
      sums[i] = sums[i] * factor + summand;
  for (int i = 0; i < n_sums; ++i)
    for (unsigned int l = 0; l < n_lanes; ++l)
      sink += sums[i][l];
  return 2. * n_sums * n_lanes * n;
}
} // namespace SIGNORINI_INSTRUCTION_SET
} // namespace signorini
