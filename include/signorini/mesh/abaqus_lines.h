// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace signorini
{
/// A line of an Abaqus input file: a keyword with its options, or data.
struct AbaqusLine
{
  std::string keyword;                        ///< in upper case, with its asterisk; empty: data
  std::map<std::string, std::string> options; ///< values as written, by upper-case names
  std::vector<std::string> fields;            ///< of a data line, trimmed
  int number = 0;

  /// Empty if it is absent.
  std::string option(const std::string &name) const;
};

/// Goes through the lines of a file: comments and empty ones are passed over, keyword lines that go on are
/// joined.
class AbaqusLines
{
public:
  /// Throws FileError.
  explicit AbaqusLines(const std::string &path);
  /// False at the end of the file.
  bool next(AbaqusLine &line);

private:
  std::istringstream stream;
  int number = 0;
};

std::string upper_case(std::string text);
} // namespace signorini
