// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <chrono>
#include <map>
#include <string>

namespace signorini
{
/// Wall-clock time by section. A section that is never entered does not appear. This rank only, no
/// communication.
class RunTime
{
public:
  /// Counts from its making to its end. Sections must not overlap: their sum is at most the total.
  class Section
  {
  public:
    explicit Section(double &time_of_section)
        : seconds(time_of_section), start(std::chrono::steady_clock::now())
    {
    }
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

  /// Since this object was made, and in what an archive has brought [s].
  double total() const
  {
    return earlier + std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }

  /// For boost's archives: what is read from one is added.
  template <typename Archive>
  void serialize(Archive &archive, unsigned int /*version*/)
  {
    std::map<std::string, double> sections_so_far = all;
    double total_so_far = total();
    archive &sections_so_far &total_so_far;
    if (!Archive::is_loading::value)
      return;
    for (const auto &[name, seconds] : sections_so_far)
      all[name] += seconds;
    earlier += total_so_far;
  }

private:
  std::map<std::string, double> all;
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  double earlier = 0.; ///< in what archives have brought [s]
};
} // namespace signorini
