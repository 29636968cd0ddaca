// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

namespace signorini
{
/// Removes from an output directory what an earlier run left there and this one may not write over: fields,
/// summary, profile, table of a study and report with those of its pictures that scripts/report makes.
/// Nothing else is touched, nor anything in a directory without the log and parameters that every run leaves.
/// Call on one rank only, before the run writes. Throws FileError.
void remove_earlier_output(const std::string &directory);
} // namespace signorini
