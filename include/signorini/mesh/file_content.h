// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

namespace signorini
{
/// What follows the last dot of a file's name, with the dot, in lower case; of a packed Abaqus file, .inp.gz,
/// what stands before .gz.
std::string ending_of(const std::string &path);

/// Names that a file may have: `path`, and of an Abaqus file that of its packed or unpacked form.
std::vector<std::string> possible_names(const std::string &path);

/// All of a file, unpacked if it was packed by gzip. Throws FileError if it is no regular file or cannot be
/// read.
std::string read_content(const std::string &path);
} // namespace signorini
