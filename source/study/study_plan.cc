// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/study/study_plan.h"

#include "signorini/base/exceptions.h"
#include "signorini/parameters/body_parameters.h"
#include "signorini/parameters/read_parameters.h"
#include "signorini/parameters/strings.h"
#include "signorini/parameters/study_parameters.h"
#include "signorini/simulation/size_estimate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace signorini
{
namespace
{
using Factor = StudyParameters::Factor;

constexpr std::size_t most_runs = 10000;

/// All values of one factor, on top of every combination so far; a factor without values leaves them.
void multiply(std::vector<std::vector<StudySetting>> &combinations, const StudyParameters &study,
              const Factor factor)
{
  const auto values = study.values.find(factor);
  if (values == study.values.end())
    return;
  std::vector<std::vector<StudySetting>> product;
  for (const std::vector<StudySetting> &settings : combinations)
    for (const std::string &value : values->second)
    {
      product.push_back(settings);
      product.back().emplace_back(factor, value);
    }
  combinations = product;
}

/// Meshes are refined in one way or the other; all other factors multiply.
std::vector<std::vector<StudySetting>> combine(const StudyParameters &study)
{
  std::vector<std::vector<StudySetting>> combinations;
  for (const Factor factor : {Factor::uniform_refinements, Factor::adaptive_cycles})
    if (study.values.count(factor) > 0)
    {
      std::vector<std::vector<StudySetting>> meshes{{}};
      multiply(meshes, study, factor);
      combinations.insert(combinations.end(), meshes.begin(), meshes.end());
    }
  if (combinations.empty())
    combinations.emplace_back();
  for (const Factor factor :
       {Factor::degree, Factor::potential, Factor::penalty_factor, Factor::linear_solver,
        Factor::contact_stepping, Factor::step_factor, Factor::copies})
    multiply(combinations, study, factor);
  return combinations;
}

/// Puts values into the text of one run; messages name the list that they come from.
class RunText
{
public:
  RunText(const ParameterText &file, const Parameters &of_file) : text(file), parameters(of_file) {}

  void apply(const StudySetting &setting, const ParameterEntry &list)
  {
    place = list;
    const std::string &value = setting.second;
    switch (setting.first)
    {
    case Factor::uniform_refinements:
      return refine(parse_integer(value).value());
    case Factor::adaptive_cycles:
      return set("Adaptivity", "Maximum cycles", value);
    case Factor::degree:
      return set("", "Degree", value);
    case Factor::potential:
      return set("Contact", "Potential", value);
    case Factor::penalty_factor:
      return set("Contact", "Penalty factor", value);
    case Factor::linear_solver:
      return set("Quasi-static", "Linear solver", value);
    case Factor::contact_stepping:
      return set("Explicit", "Contact stepping", value);
    case Factor::step_factor:
      return shorten_step(parse_number(value).value());
    case Factor::copies:
      return multiply_bodies(join(split(value, ' '), ", "));
    }
  }

  /// What is another default in a study than in a run, and where adaptive refinement ends.
  ParameterText finish()
  {
    place = {"", "", "", text.where("Study"), 0};
    set("Output", "Number of fields", std::to_string(parameters.output.n_fields));
    const unsigned int own = parameters.adaptivity.value_or(AdaptivityParameters()).max_n_dofs;
    if (text.find_subsection("Adaptivity") != nullptr)
      set("Adaptivity", "Maximum dofs", std::to_string(std::min(own, parameters.study->max_n_dofs)));
    remove_subsection(text, "Study");
    return text;
  }

private:
  void set(const std::string &path, const std::string &key, const std::string &value)
  {
    set_entry(text, {path, key, value, place.file, place.line});
  }

  void refine(const long n_levels)
  {
    remove_subsection(text, "Adaptivity");
    std::string last;
    for (const BodyParameters &body : parameters.bodies)
      if (const std::string path = body_subsection(body.name); std::exchange(last, path) != path)
        set(path + "/Mesh", "Refinements", std::to_string(body.mesh.refinements + n_levels));
  }

  void multiply_bodies(const std::string &number)
  {
    for (const std::string &body : split(text.value("", "Bodies"), ','))
      if (const std::string path = "Body " + body + "/Copies"; text.find_subsection(path) != nullptr)
        set(path, "Number", number);
  }

  void shorten_step(const double factor)
  {
    const auto &run = std::get<ExplicitParameters>(parameters.solver);
    set("Explicit", "Bulk step factor", fmt::format("{}", factor * run.bulk_step_factor));
    set("Explicit", "Contact step factor", fmt::format("{}", factor * run.contact_step_factor));
  }

  ParameterText text;
  const Parameters &parameters;
  ParameterEntry place; ///< of the list whose value is applied
};

/// Dofs that refining adds in a cycle, as a share; of a Hertz contact with half of the error refined.
constexpr double growth_of_cycle = 1.5;

/// Even the smallest run takes as long as one of so many dofs would without it.
constexpr double dofs_of_overhead = 2000.;

void estimate_cost(StudyRun &run, const StudyParameters &study, const unsigned int n_ranks)
{
  run.n_dofs = estimate_size(run.parameters, n_ranks).n_dofs;
  if (run.n_dofs > study.max_n_dofs)
    run.left_out =
        fmt::format("about {:.3g} dofs, more than Study/Maximum dofs = {}", run.n_dofs, study.max_n_dofs);
  double n_final = run.n_dofs;
  if (run.parameters.adaptivity)
    n_final = std::min<double>(run.parameters.adaptivity->max_n_dofs,
                               n_final * std::pow(growth_of_cycle, run.parameters.adaptivity->max_cycles));
  // Explicit steps shorten with h, and solvers take more than linear time.
  run.cost = std::pow(n_final + dofs_of_overhead, 1. + 1. / run.parameters.dimension);
  for (const auto &[factor, value] : run.settings)
    if (factor == Factor::step_factor)
      run.cost /= parse_number(value).value();
}

/// The parameters of a run. A fault of a value is told by its list and its place there.
Parameters read_run(const StudyRun &run, const ParameterText &file, const StudyParameters &study)
{
  try
  {
    return read_parameters(run.text);
  }
  catch (const InputError &error)
  {
    Complaint complaint = error.complaint();
    std::string origin = fmt::format("run {} of the study", settings_name(run.settings));
    for (const auto &[factor, value] : run.settings)
      if (const std::string &key = study_key(factor); complaint.where == file.find("Study", key)->where())
      {
        const std::vector<std::string> &values = study.values.at(factor);
        origin = fmt::format("value {} of 'Study/{}', {}",
                             1 + std::find(values.begin(), values.end(), value) - values.begin(), key, value);
      }
    complaint.what = origin + ": " + complaint.what;
    throw InputError(complaint);
  }
}
} // namespace

std::string factor_name(const Factor factor)
{
  switch (factor)
  {
  case Factor::uniform_refinements:
    return "uniform";
  case Factor::adaptive_cycles:
    return "adaptive";
  case Factor::degree:
    return "degree";
  case Factor::potential:
    return "potential";
  case Factor::penalty_factor:
    return "alpha";
  case Factor::linear_solver:
    return "solver";
  case Factor::contact_stepping:
    return "contact";
  case Factor::step_factor:
    return "step";
  default:
    return "copies";
  }
}

std::string settings_name(const std::vector<StudySetting> &settings)
{
  std::vector<std::string> parts;
  for (const auto &[factor, value] : settings)
    parts.push_back(factor_name(factor) + "-" + join(split(value, ' '), "-"));
  return join(parts, "_");
}

std::string StudyRun::name() const
{
  return fmt::format("{}_repeat-{}", settings_name(settings), repeat);
}

std::vector<StudyRun> plan_study(const ParameterText &text, const Parameters &parameters,
                                 const unsigned int n_ranks)
{
  const StudyParameters &study = *parameters.study;
  const std::vector<std::vector<StudySetting>> combinations = combine(study);
  if (combinations.size() * study.n_repeats > most_runs)
    throw InputError(
        Complaint("the study has too many runs")
            .at(text.where("Study"))
            .found(fmt::format("{} combinations, each {} times", combinations.size(), study.n_repeats))
            .expected(fmt::format("at most {} runs", most_runs))
            .advise("shorten the lists, or split them into several files"));
  const std::string runs_directory = parameters.output.directory + "/runs/";
  std::vector<StudyRun> runs;
  for (const std::vector<StudySetting> &settings : combinations)
  {
    StudyRun run;
    run.settings = settings;
    RunText run_text(text, parameters);
    for (const StudySetting &setting : settings)
      run_text.apply(setting, *text.find("Study", study_key(setting.first)));
    run.text = run_text.finish();
    const auto write_into = [&](const std::string &directory)
    {
      set_entry(run.text, {"Output", "Directory", directory, text.where("Output", "Directory"), 0});
      run.parameters.output.directory = directory;
    };
    write_into(runs_directory + run.name());
    run.parameters = read_run(run, text, study);
    estimate_cost(run, study, n_ranks);
    for (; run.repeat <= study.n_repeats; ++run.repeat)
    {
      write_into(runs_directory + run.name());
      runs.push_back(run);
    }
  }
  std::stable_sort(runs.begin(), runs.end(),
                   [](const StudyRun &one, const StudyRun &other) { return one.cost < other.cost; });
  return runs;
}
} // namespace signorini
