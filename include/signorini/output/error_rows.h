// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/output/results.h"

#include <cmath>

namespace signorini
{
/// A row with the difference of both over the exact value's magnitude.
inline ErrorRow compare(const std::string &quantity, double computed, double exact)
{
  return {quantity, computed, exact, (computed - exact) / std::abs(exact)};
}

inline double norm(const Triple &vector)
{
  return std::hypot(vector[0], vector[1], vector[2]);
}

/// E* with 1/E* = Σ (1 − ν²)/E over the bodies, all of which touch: two touch each other, one a rigid
/// obstacle (checked when the parameters are read) [Pa].
inline double contact_modulus(const Parameters &parameters)
{
  double compliance = 0.;
  for (const BodyParameters &body : parameters.bodies)
    compliance +=
        (1. - body.material.poissons_ratio * body.material.poissons_ratio) / body.material.youngs_modulus;
  return 1. / compliance;
}
} // namespace signorini
