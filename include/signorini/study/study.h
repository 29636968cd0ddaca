// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/parameters/parameter_text.h"
#include "signorini/parameters/parameters.h"
#include "signorini/simulation/command_line.h"
#include "signorini/simulation/progress.h"
#include "signorini/study/study_results.h"

#include <mpi.h>

#include <vector>

namespace signorini
{
/// Makes the runs of a study one after the other, each into runs/NAME of the study's directory, and compares
/// them. The rows come from what the runs wrote.
class Study
{
public:
  /// Plans all runs and builds the first one. Throws InputError for a run that is not valid. `parameters`,
  /// with a study, are those of `text`; all must outlive this object. Collective, as all that follows.
  Study(const CommandLine &command_line, const ParameterText &text, const Parameters &parameters,
        const MPI_Comm &communicator);

  /// Lists the runs.
  void print_plan();

  /// Throws NumericalError, after all is written, if no run ends well or a signal ends the study; FileError.
  void run();

private:
  /// Those of earlier studies must not be taken for those of this one.
  void remove_earlier_runs() const;
  /// Makes a run, or finds that nothing of it is left to do.
  void make(const StudyRun &run);
  /// Runs into the directory of the run; what it throws ends this run only.
  void simulate(const StudyRun &run, StudyRow &row);
  void say_row(const StudyRun &run, const StudyRow &row, bool is_earlier);
  void finish(const std::string &signal);

  const CommandLine &command_line;
  const ParameterText &text;
  const Parameters &parameters;
  MPI_Comm communicator;
  bool is_first;
  unsigned int n_ranks;
  Progress progress;
  std::vector<StudyRun> plan;
  std::vector<StudyRow> rows; ///< one a run, so far
  StudyResults results;
  double cost_done = 0., seconds_done = 0.; ///< of runs made now
  double cost_left = 0.;
};
} // namespace signorini
