// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/study/observed_order.h"
#include "signorini/study/study_row.h"

#include <optional>
#include <string>
#include <vector>

namespace signorini
{
/// All that a study is reported from.
struct StudyResults
{
  std::string input;
  std::string status; ///< ok, failed (no run ended well), or interrupted
  std::string reason; ///< unless it is ok
  std::vector<std::string> warnings;
  unsigned int n_ranks = 1;
  StudyParameters parameters;
  std::vector<StudyRow> rows; ///< one for all repeats
  std::vector<ObservedOrder> orders;
  std::vector<std::size_t> pareto_front;
  std::optional<std::size_t> cheapest; ///< row with no error above the tolerance and the smallest run time
};

/// Fills what follows from the rows: orders, Pareto front, cheapest run. `rows`: one a run.
void compare_runs(StudyResults &results, const std::vector<StudyRow> &rows, unsigned int dimension);

/// Writes study.csv, one row a combination, columns with units in the first row. Throws FileError.
void write_study_table(const StudyResults &results, const std::string &directory);

/// Writes summary.json of the study. Throws FileError.
void write_study_summary(const StudyResults &results, const std::string &directory);

/// What is shown at the end, line by line: a table of runs, orders of the quantities that count, the cheapest
/// run.
std::vector<std::string> describe_study(const StudyResults &results);
} // namespace signorini
