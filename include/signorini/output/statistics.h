// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
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
  /// Goes on behind the first `n_bytes` of an earlier part of the run. Throws FileError if there are fewer.
  Statistics(const std::string &file_name, std::uintmax_t n_bytes);
  void write(const Row &row);
  /// What has been written [bytes].
  std::uintmax_t size() { return static_cast<std::uintmax_t>(file.tellp()); }

private:
  std::string name;
  std::ofstream file;
  bool has_header = false;
};
} // namespace signorini
