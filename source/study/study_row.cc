// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/study/study_row.h"

#include "signorini/base/exceptions.h"
#include "signorini/base/version.h"
#include "signorini/parameters/print_parameters.h"
#include "signorini/parameters/study_parameters.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <sstream>

namespace signorini
{
namespace
{
using Json = nlohmann::json;

/// JSON has no NaN: it is written as null.
double number(const Json &object, const char *key)
{
  const auto found = object.find(key);
  return found != object.end() && found->is_number() ? found->get<double>() : StudyRow::none;
}

void read_errors(const Json &summary, const StudyParameters &study, std::vector<StudyError> &errors)
{
  for (const Json &row : summary.at("errors"))
    errors.push_back({row.at("quantity").get<std::string>(), number(row, "computed"), number(row, "exact"),
                      number(row, "relative_error")});
  const Json &estimate = summary.at("estimate");
  const double discretization = number(estimate, "discretization");
  errors.push_back({estimated_discretization, discretization, 0., discretization});
  if (summary.contains("contact"))
  {
    const double contact = number(estimate, "contact");
    errors.push_back({estimated_contact, contact, 0., contact});
  }
  for (StudyError &error : errors)
    if (const auto model = study.model_errors.find(error.quantity); model != study.model_errors.end())
      error.relative_error -= model->second;
}

void read_summary(const Json &summary, const StudyParameters &study, StudyRow &row)
{
  if (summary.contains("reason"))
    row.reason = summary.at("reason").get<std::string>();
  row.n_cells = summary.at("n_cells").get<unsigned int>();
  row.n_dofs = summary.at("n_dofs").get<unsigned int>();
  row.n_steps = summary.at("n_steps").get<unsigned int>();
  row.n_iterations = summary.at("n_iterations").get<unsigned int>();
  row.n_ranks = summary.at("n_ranks").get<unsigned int>();
  row.total_time = number(summary.at("run_time"), "total");
  const double output = number(summary.at("run_time").at("sections"), "output");
  row.run_time = std::isfinite(output) ? row.total_time - output : row.total_time;
  row.set_up_time = number(summary.at("run_time").at("sections"), "set-up");
  row.memory_mb = number(summary, "memory_peak_mb");
  if (summary.contains("contact"))
  {
    row.alpha = number(summary.at("contact"), "alpha");
    row.k_A = number(summary.at("contact"), "effective_stiffness");
  }
  // What a failed run measured is of no state that was sought.
  row.status = summary.at("status").get<std::string>();
  if (row.status == "ok")
    read_errors(summary, study, row.errors);
}

std::string content(const std::string &file)
{
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}
/// What a parameter file says, without its comments: they hold defaults that depend on the name of the input.
/// Throws InputError.
std::vector<std::array<std::string, 3>> values_in(const std::string &parameters)
{
  std::vector<std::array<std::string, 3>> values;
  for (const ParameterEntry &entry : scan_parameter_text(parameters, "parameters.prm").entries)
    values.push_back({entry.path, entry.key, entry.value});
  return values;
}
} // namespace

double StudyRow::error(const std::string &quantity) const
{
  for (const StudyError &entry : errors)
    if (entry.quantity == quantity)
      return std::abs(entry.relative_error);
  return none;
}

double StudyRow::largest_error(const std::vector<std::string> &quantities) const
{
  double largest = 0.;
  for (const std::string &quantity : quantities)
  {
    const double magnitude = error(quantity);
    if (!std::isfinite(magnitude))
      return none;
    largest = std::max(largest, magnitude);
  }
  return largest;
}

StudyRow read_row(const StudyRun &run, const StudyParameters &study)
{
  StudyRow row;
  row.settings = run.settings;
  row.directory = run.parameters.output.directory;
  try
  {
    read_summary(Json::parse(content(row.directory + "/summary.json")), study, row);
  }
  catch (const Json::exception &error)
  {
    row.status = "failed";
    row.reason = "summary.json of the run cannot be read: " + std::string(error.what());
  }
  return row;
}

bool is_finished(const StudyRun &run, const unsigned int n_ranks)
{
  const std::string &directory = run.parameters.output.directory;
  std::ostringstream used;
  write_parameters_used(run.text, used);
  try
  {
    if (values_in(content(directory + "/parameters.prm")) != values_in(used.str()))
      return false;
    const Json summary = Json::parse(content(directory + "/summary.json"));
    return summary.at("status") == "ok" && summary.at("n_ranks") == n_ranks &&
           summary.at("version") == program_version();
  }
  catch (const Json::exception &)
  {
    return false;
  }
  catch (const InputError &)
  {
    return false;
  }
}

std::vector<StudyRow> merge_repeats(const std::vector<StudyRow> &rows)
{
  std::vector<StudyRow> merged;
  const auto is_better = [](const StudyRow &one, const StudyRow &other)
  {
    if ((one.status == "ok") != (other.status == "ok"))
      return one.status == "ok";
    return one.run_time < other.run_time;
  };
  for (const StudyRow &row : rows)
  {
    const auto same = std::find_if(merged.begin(), merged.end(),
                                   [&row](const StudyRow &other) { return other.settings == row.settings; });
    if (same == merged.end())
      merged.push_back(row);
    else if (is_better(row, *same))
      *same = row;
  }
  return merged;
}

std::vector<std::size_t> find_pareto_front(const std::vector<StudyRow> &rows,
                                           const std::vector<std::string> &quantities)
{
  std::vector<std::size_t> by_time;
  std::vector<double> errors;
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    errors.push_back(rows[i].largest_error(quantities));
    if (std::isfinite(errors[i]) && std::isfinite(rows[i].run_time))
      by_time.push_back(i);
  }
  std::sort(by_time.begin(), by_time.end(),
            [&](const std::size_t one, const std::size_t other) {
              return std::pair(rows[one].run_time, errors[one]) <
                     std::pair(rows[other].run_time, errors[other]);
            });
  std::vector<std::size_t> front;
  for (const std::size_t i : by_time)
    if (front.empty() || errors[i] < errors[front.back()])
      front.push_back(i);
  return front;
}
} // namespace signorini
