// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/simulation/progress.h"

#include "signorini/base/exceptions.h"

#include <fmt/core.h>

#include <iostream>

#include <unistd.h>

namespace signorini
{
Progress::Progress(bool is_first_rank, bool quiet)
    : is_active(is_first_rank), is_quiet(quiet), is_terminal(isatty(STDOUT_FILENO) == 1),
      start(std::chrono::steady_clock::now()), last_shown(start - std::chrono::hours(1))
{
}

void Progress::open_log(const std::string &directory, EarlierLog earlier)
{
  if (!is_active)
    return;
  log.open(directory + "/log.txt", earlier == EarlierLog::continued ? std::ios::app : std::ios::trunc);
  if (!log)
    throw FileError("cannot write '" + directory + "/log.txt'");
}

void Progress::say(const std::string &line)
{
  if (!is_active)
    return;
  log << line << std::endl;
  if (!is_quiet)
    std::cout << line << std::endl;
}

void Progress::step(const std::string &line, double share)
{
  if (!is_active)
    return;
  const auto now = std::chrono::steady_clock::now();
  const double elapsed = std::chrono::duration<double>(now - start).count();
  if (first_share < 0.)
    first_share = share;
  const double remaining = share > first_share ? elapsed * (1. - share) / (share - first_share) : 0.;
  const std::string full = fmt::format("{}  {:5.1f} %  ETA {:.0f} s", line, 100. * share, remaining);
  log << full << std::endl;
  const double pause = is_terminal ? 0.2 : 2.;
  const bool is_due = std::chrono::duration<double>(now - last_shown).count() > pause;
  if (is_quiet || !is_due)
    return;
  std::cout << full << std::endl;
  last_shown = now;
}
} // namespace signorini
