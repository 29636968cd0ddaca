// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/base/types.h"

namespace signorini
{
/// Where everything is and how fast it moves. Both vectors have up-to-date ghosts and hanging entries.
struct State
{
  double time = 0.;    ///< [s]; quasi-static runs: the load parameter
  Vector displacement; ///< [m]
  Vector velocity;     ///< [m/s]; empty in quasi-static runs
};
} // namespace signorini
