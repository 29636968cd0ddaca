// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

namespace signorini
{
/// Content of a parameter file. Throws InputError if it is no regular file or larger than a parameter file
/// can be, FileError if it cannot be read.
std::string read_input_file(const std::string &file);

/// Content of standard input, under the same limit; rank 0 reads and broadcasts. Collective.
std::string read_standard_input();
} // namespace signorini
