// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <chrono>
#include <fstream>
#include <string>

namespace signorini
{
/// What the user reads while a run goes on: every line to log.txt, to the screen only so many as can be read,
/// or a line every few seconds where it is not a terminal. Silent on all ranks but the first.
class Progress
{
public:
  Progress(bool is_first_rank, bool is_quiet);

  /// What becomes of the log of an earlier part of the run.
  enum class EarlierLog
  {
    replaced,
    continued
  };

  /// Starts log.txt, or goes on with it. Throws FileError.
  void open_log(const std::string &directory, EarlierLog earlier);

  /// A line that is always shown.
  void say(const std::string &line);

  /// A line about a step: `share` of the work is done (0 … 1); adds percent and the time still to go, by that
  /// since the first of these lines.
  void step(const std::string &line, double share);

private:
  bool is_active, is_quiet, is_terminal;
  std::ofstream log;
  double first_share = -1.;
  std::chrono::steady_clock::time_point start, last_shown;
};
} // namespace signorini
