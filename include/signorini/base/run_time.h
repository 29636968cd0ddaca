// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <chrono>
#include <map>
#include <string>

namespace signorini
{
/// Wall-clock time by section. A section that is never entered does not appear. This rank only, no communication.
class RunTime
{
public:
  /// Counts from its making to its end. Sections must not overlap: their sum is at most the total.
  class Section
  {
  public:
    explicit Section(double &time_of_section) : seconds(time_of_section), start(std::chrono::steady_clock::now()) {}
    ~Section() { seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); }
    Section(const Section &) = delete;
    Section &operator=(const Section &) = delete;

  private:
    double &seconds;
    std::chrono::steady_clock::time_point start;
  };

  Section enter(const std::string &name) { return Section(all[name]); }

  /// [s] by name.
  const std::map<std::string, double> &sections() const { return all; }

  /// Since this object was made [s].
  double total() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); }

private:
  std::map<std::string, double> all;
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
};
} // namespace signorini
