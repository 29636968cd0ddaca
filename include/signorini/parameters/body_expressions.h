// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/parameters/parameter_text.h"
#include "signorini/parameters/parameters.h"

namespace signorini
{
/// x ← shift + rotation·(scale·x).
Triple place(const PlacementParameters &placement, const Triple &x);

/// Parse the expressions of supports and loads and evaluate them at times 0 and `end_time` at the points that
/// bound their boundary. Throws InputError if one has a fault, or is not finite there.
void check_expressions(const ParameterText &text, const BodyParameters &body, unsigned int dimension,
                       double end_time);

/// The same for the motion of an obstacle, which must depend on t alone and begin with 0.
void check_motion(const ParameterText &text, const ObstacleParameters &obstacle, double end_time);
} // namespace signorini
