// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

namespace signorini
{
/// Throws FileError if the directory cannot be made or written to; leaves nothing behind. Rank 0 tries, all
/// ranks throw.
void check_output_directory(const std::string &directory, const std::string &where);
} // namespace signorini
