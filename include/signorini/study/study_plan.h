// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/parameters/parameter_text.h"
#include "signorini/parameters/parameters.h"

#include <string>
#include <utility>
#include <vector>

namespace signorini
{
/// The value that a run has of a factor, as it stands in the file.
using StudySetting = std::pair<StudyParameters::Factor, std::string>;

/// Short name of a factor, as in the names of runs: uniform, adaptive, degree, alpha, solver, step, copies.
std::string factor_name(StudyParameters::Factor factor);

/// `uniform-2_alpha-10`: the settings of a run as a name of a folder.
std::string settings_name(const std::vector<StudySetting> &settings);

/// One run of a study.
struct StudyRun
{
  std::vector<StudySetting> settings; ///< in the order of the factors
  unsigned int repeat = 1;
  ParameterText text; ///< the file without `Study`, with the settings in their places
  Parameters parameters;
  double n_dofs = 0.;   ///< estimated
  double cost = 0.;     ///< in an unknown unit; a rough guess
  std::string left_out; ///< why the run is not made; empty if it is

  std::string name() const; ///< unique in the study
};

/// All runs, roughly from the cheapest to the dearest, repeats of one next to each other. Throws InputError
/// for a run that is not valid, at the place of the list its values come from, and for too many.
/// `parameters`, with a study, are those of `text`. Collective.
std::vector<StudyRun> plan_study(const ParameterText &text, const Parameters &parameters,
                                 unsigned int n_ranks);
} // namespace signorini
