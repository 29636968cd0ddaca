// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace signorini
{
/// statistics.csv: one row an output, columns as in the first row. Call on one rank only.
class Statistics
{
public:
  using Row = std::vector<std::pair<std::string, double>>; ///< heading with unit, value

  /// Throws FileError if the file cannot be made.
  explicit Statistics(const std::string &file_name);
  void write(const Row &row);

private:
  std::string name;
  std::ofstream file;
  bool has_header = false;
};
} // namespace signorini
