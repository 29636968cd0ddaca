// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

namespace signorini
{
/// What follows the last dot of a file's name, with the dot, in lower case.
std::string ending_of(const std::string &path);

/// All of a file. Throws FileError if it is no regular file or cannot be read.
std::string read_content(const std::string &path);
} // namespace signorini
