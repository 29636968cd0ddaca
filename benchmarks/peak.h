// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace signorini
{
/// Runs `n` rounds of fused multiplications and additions on registers of this instruction set. Returns how
/// many operations that were; `sink` receives a number that depends on all of them.
using RunPeak = double (*)(unsigned int n, double &sink);

namespace baseline
{
double run_peak(unsigned int n, double &sink);
}
namespace avx2
{
double run_peak(unsigned int n, double &sink);
}
namespace avx512
{
double run_peak(unsigned int n, double &sink);
}
} // namespace signorini
