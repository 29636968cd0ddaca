// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/study/study_plan.h"

#include <limits>
#include <string>
#include <vector>

namespace signorini
{
/// One error of a run.
struct StudyError
{
  std::string quantity;
  double computed = 0., exact = 0.;
  double relative_error = 0.; ///< signed, without the model error
};

/// What a study keeps of a run, from its summary.json. What a run has not is NaN.
struct StudyRow
{
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();

  std::vector<StudySetting> settings;
  std::string status; ///< ok, failed, interrupted, or left out
  std::string reason; ///< unless it is ok
  std::string directory;
  unsigned int n_cells = 0, n_dofs = 0, n_steps = 0, n_iterations = 0, n_ranks = 0;
  double alpha = none;            ///< penalty factor used
  double k_A = none;              ///< largest contact stiffness [Pa/m]
  double run_time = none;         ///< without the writing of output [s]
  double total_time = none;       ///< with it [s]
  double set_up_time = none;      ///< of these [s]
  double memory_mb = none;        ///< peak, of all ranks
  std::vector<StudyError> errors; ///< of the exact solution, then the estimated ones

  std::string name() const { return settings_name(settings); }
  double core_seconds() const { return n_ranks * run_time; }
  /// What a cell takes in a step: of the run time without set-up and output [s].
  double time_of_cell_step() const { return (run_time - set_up_time) / n_cells / n_steps; }
  /// Magnitude of the error of a quantity; NaN if the run has none.
  double error(const std::string &quantity) const;
  /// The largest magnitude over several quantities; NaN if one of them has none.
  double largest_error(const std::vector<std::string> &quantities) const;
};

/// The row of a run from what it wrote into its Output/Directory. A summary that cannot be read makes a
/// failed row.
StudyRow read_row(const StudyRun &run, const StudyParameters &study);

/// Whether the directory of a run holds what the same run, on so many ranks, by this version of the program,
/// left when it ended well.
bool is_finished(const StudyRun &run, unsigned int n_ranks);

/// One row for all repeats of a run: that with the smallest run time, of those that ended well if any did.
std::vector<StudyRow> merge_repeats(const std::vector<StudyRow> &rows);

/// Indices, by increasing run time, of the rows that no other one beats in run time and largest error both.
/// Only rows with both count.
std::vector<std::size_t> find_pareto_front(const std::vector<StudyRow> &rows,
                                           const std::vector<std::string> &quantities);
} // namespace signorini
