// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

namespace signorini
{
/// As in the project line of CMakeLists.txt.
std::string program_version();
} // namespace signorini
