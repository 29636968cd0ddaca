// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/output/statistics.h"

#include "signorini/base/exceptions.h"

#include <fmt/core.h>

namespace signorini
{
Statistics::Statistics(const std::string &file_name)
  : name(file_name)
  , file(file_name)
{
  if (!file)
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
