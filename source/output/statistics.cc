// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/output/statistics.h"

#include "signorini/base/exceptions.h"

#include <fmt/core.h>

#include <filesystem>

namespace signorini
{
Statistics::Statistics(const std::string &file_name) : name(file_name), file(file_name)
{
  if (!file)
    throw FileError("cannot write '" + name + "'");
}

Statistics::Statistics(const std::string &file_name, std::uintmax_t n_bytes)
    : name(file_name), has_header(n_bytes > 0)
{
  std::error_code failure;
  const std::uintmax_t n_present = std::filesystem::file_size(name, failure);
  if (failure || n_present < n_bytes)
    throw FileError(Complaint("the rows that the run wrote before its checkpoint are gone")
                        .at(name)
                        .expected(fmt::format("a file of {} bytes or more", n_bytes))
                        .advise("put it back, or run again from the start"));
  std::filesystem::resize_file(name, n_bytes, failure);
  file.open(name, std::ios::app);
  file.seekp(0, std::ios::end);
  if (failure || !file)
    throw FileError("cannot write '" + name + "'");
}

void Statistics::write(const Row &row)
{
  if (!has_header)
    for (unsigned int i = 0; i < row.size(); ++i)
      file << (i > 0 ? "," : "") << row[i].first << (i + 1 == row.size() ? "\n" : "");
  has_header = true;
  for (unsigned int i = 0; i < row.size(); ++i)
    file << fmt::format("{}{:.15g}{}", i > 0 ? "," : "", row[i].second, i + 1 == row.size() ? "\n" : "");
  file.flush();
  if (!file)
    throw FileError("cannot write '" + name + "': is the disk full?");
}
} // namespace signorini
