// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>

namespace signorini
{
/// Three components always; in two dimensions the third is zero.
using Triple = std::array<double, 3>;
} // namespace signorini
