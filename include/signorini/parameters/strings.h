// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

/// Taking values in a parameter file apart. Independent of the locale.
namespace signorini
{
std::string trim(const std::string &text);

/// Every run of white space becomes one space.
std::string collapse_spaces(const std::string &text);

/// Parts between separators, trimmed; an empty text has none.
std::vector<std::string> split(const std::string &text, char separator);

std::string join(const std::vector<std::string> &parts, const std::string &separator);

/// The whole text as a finite number; nothing if it is anything else (a unit, nan, inf, 1,000, out of range).
std::optional<double> parse_number(const std::string &text);

/// The whole text as an integer.
std::optional<long> parse_integer(const std::string &text);
} // namespace signorini
