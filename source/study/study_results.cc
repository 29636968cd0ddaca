// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/study/study_results.h"

#include "signorini/base/exceptions.h"
#include "signorini/base/version.h"
#include "signorini/parameters/strings.h"
#include "signorini/parameters/study_parameters.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>

namespace signorini
{
namespace
{
using Json = nlohmann::ordered_json;

/// Empty where there is none.
std::string cell(const double value)
{
  return std::isfinite(value) ? fmt::format("{:.10g}", value) : "";
}

using Columns = std::vector<std::pair<std::string, std::string>>; ///< heading with unit, value

Columns columns_of(const StudyRow &row, const StudyResults &results,
                   const std::vector<std::string> &quantities)
{
  Columns columns{{"run", row.name()}};
  for (const auto &[factor, values] : results.parameters.values)
  {
    const auto own =
        std::find_if(row.settings.begin(), row.settings.end(),
                     [factor = factor](const StudySetting &setting) { return setting.first == factor; });
    columns.emplace_back(factor_name(factor), own != row.settings.end() ? own->second : "");
  }
  const Columns numbers{{"n_cells", fmt::format("{}", row.n_cells)},
                        {"n_dofs", fmt::format("{}", row.n_dofs)},
                        {"n_steps", fmt::format("{}", row.n_steps)},
                        {"n_iterations", fmt::format("{}", row.n_iterations)},
                        {"penalty factor used", cell(row.alpha)},
                        {"effective stiffness [Pa/m]", cell(row.k_A)},
                        {"run time [s]", cell(row.run_time)},
                        {"run time with output [s]", cell(row.total_time)},
                        {"core-seconds [s]", cell(row.core_seconds())},
                        {"set-up time [s]", cell(row.set_up_time)},
                        {"run time of a cell and step [s]", cell(row.time_of_cell_step())},
                        {"memory [MB]", cell(row.memory_mb)},
                        {"largest error", cell(row.largest_error(results.parameters.quantities))}};
  columns.insert(columns.end(), numbers.begin(), numbers.end());
  for (const std::string &quantity : quantities)
  {
    const auto error =
        std::find_if(row.errors.begin(), row.errors.end(),
                     [&quantity](const StudyError &other) { return other.quantity == quantity; });
    const StudyError none{quantity, StudyRow::none, StudyRow::none, StudyRow::none};
    const StudyError &shown = error != row.errors.end() ? *error : none;
    columns.emplace_back(quantity + ": computed", cell(shown.computed));
    columns.emplace_back(quantity + ": exact", cell(shown.exact));
    columns.emplace_back(quantity + ": relative error", cell(shown.relative_error));
  }
  columns.emplace_back("status", row.status);
  return columns;
}

Json describe_settings(const std::vector<StudySetting> &settings)
{
  Json described = Json::object();
  for (const auto &[factor, value] : settings)
    described[factor_name(factor)] = value;
  return described;
}

Json describe_row(const StudyRow &row, const std::vector<std::string> &quantities)
{
  Json errors = Json::array();
  for (const StudyError &error : row.errors)
    errors.push_back({{"quantity", error.quantity},
                      {"computed", error.computed},
                      {"exact", error.exact},
                      {"relative_error", error.relative_error}});
  return {{"run", row.name()},
          {"settings", describe_settings(row.settings)},
          {"status", row.status},
          {"reason", row.reason},
          {"directory", row.directory},
          {"n_cells", row.n_cells},
          {"n_dofs", row.n_dofs},
          {"n_steps", row.n_steps},
          {"n_iterations", row.n_iterations},
          {"alpha", row.alpha},
          {"effective_stiffness", row.k_A},
          {"run_time", row.run_time},
          {"run_time_with_output", row.total_time},
          {"core_seconds", row.core_seconds()},
          {"set_up_time", row.set_up_time},
          {"time_of_cell_step", row.time_of_cell_step()},
          {"memory_peak_mb", row.memory_mb},
          {"largest_error", row.largest_error(quantities)},
          {"errors", errors}};
}

Json describe_order(const ObservedOrder &order)
{
  return {{"quantity", order.quantity},
          {"in", order.variable},
          {"settings", describe_settings(order.others)},
          {"order", order.fit.order},
          {"standard_error", order.fit.standard_error},
          {"r_squared", order.fit.r_squared},
          {"n_points", order.fit.n_points}};
}

std::vector<std::string> quantities_with_estimates(const StudyResults &results)
{
  for (const StudyRow &row : results.rows)
    if (!row.errors.empty())
    {
      std::vector<std::string> names;
      for (const StudyError &error : row.errors)
        names.push_back(error.quantity);
      return names;
    }
  return results.parameters.quantities;
}

void write(const std::string &name, const std::string &text)
{
  std::ofstream file(name);
  file << text;
  if (!file.flush())
    throw FileError("cannot write '" + name + "': is the disk full?");
}

/// Orders of the quantities that count; of poor fits only how many there are.
std::vector<std::string> describe_orders(const StudyResults &results)
{
  constexpr double clear = 0.9; // of R²
  const std::vector<std::string> &counted = results.parameters.quantities;
  std::vector<std::string> lines;
  unsigned int n_unclear = 0;
  for (const ObservedOrder &order : results.orders)
  {
    if (std::find(counted.begin(), counted.end(), order.quantity) == counted.end())
      continue;
    if (order.fit.r_squared < clear)
      ++n_unclear;
    else
      lines.push_back(
          fmt::format("Order of '{}' in {}{}: {:.3f} ± {:.3f} ({} points, R² {:.4f})", order.quantity,
                      order.variable, order.others.empty() ? "" : " at " + settings_name(order.others),
                      order.fit.order, order.fit.standard_error, order.fit.n_points, order.fit.r_squared));
  }
  if (n_unclear > 0)
    lines.push_back(
        fmt::format("{} further fits show no clear order: their R² is below {}", n_unclear, clear));
  return lines;
}

std::string shown_error(const double error)
{
  return std::isfinite(error) ? fmt::format("{:.2e}", error) : "–";
}
} // namespace

void compare_runs(StudyResults &results, const std::vector<StudyRow> &rows, const unsigned int dimension)
{
  const StudyParameters &study = results.parameters;
  results.rows = merge_repeats(rows);
  results.orders = find_orders(results.rows, dimension);
  results.pareto_front = find_pareto_front(results.rows, study.quantities);
  // The front runs from the cheapest to the most exact run: its first good enough one is the cheapest of all.
  for (const std::size_t i : results.pareto_front)
    if (!results.cheapest && results.rows[i].largest_error(study.quantities) <= study.tolerance)
      results.cheapest = i;
}

void write_study_table(const StudyResults &results, const std::string &directory)
{
  std::string text;
  const std::vector<std::string> quantities = quantities_with_estimates(results);
  for (const StudyRow &row : results.rows)
  {
    std::vector<std::string> headings, values;
    for (const auto &[heading, value] : columns_of(row, results, quantities))
    {
      headings.push_back(heading);
      values.push_back(value);
    }
    if (text.empty())
      text = join(headings, ",") + "\n";
    text += join(values, ",") + "\n";
  }
  write(directory + "/study.csv", text);
}

void write_study_summary(const StudyResults &results, const std::string &directory)
{
  const StudyParameters &study = results.parameters;
  Json rows = Json::array(), orders = Json::array(), front = Json::array();
  for (const StudyRow &row : results.rows)
    rows.push_back(describe_row(row, study.quantities));
  for (const ObservedOrder &order : results.orders)
    orders.push_back(describe_order(order));
  for (const std::size_t i : results.pareto_front)
    front.push_back(results.rows[i].name());
  Json summary{{"program", "signorini"}, {"version", program_version()}, {"status", results.status},
               {"input", results.input}, {"n_ranks", results.n_ranks},   {"warnings", results.warnings}};
  if (!results.reason.empty())
    summary["reason"] = results.reason;
  summary["study"] = {{"quantities", study.quantities},
                      {"tolerance", study.tolerance},
                      {"model_errors", study.model_errors},
                      {"n_repeats", study.n_repeats},
                      {"cheapest", results.cheapest ? Json(results.rows[*results.cheapest].name()) : Json()},
                      {"pareto_front", front},
                      {"orders", orders},
                      {"rows", rows}};
  write(directory + "/summary.json", summary.dump(2) + "\n");
}

std::vector<std::string> describe_study(const StudyResults &results)
{
  const StudyParameters &study = results.parameters;
  std::vector<std::string> lines;
  std::size_t width = 3;
  for (const StudyRow &row : results.rows)
    width = std::max(width, row.name().size());
  lines.push_back(fmt::format("{:<{}}  {:>9} {:>11} {:>9} {:>13}  Pareto front", "run", width, "dofs",
                              "run time/s", "memory/MB", "largest error"));
  for (std::size_t i = 0; i < results.rows.size(); ++i)
  {
    const StudyRow &row = results.rows[i];
    const auto &front = results.pareto_front;
    const bool is_on_front = std::find(front.begin(), front.end(), i) != front.end();
    lines.push_back(row.status == "ok"
                        ? fmt::format("{:<{}}  {:>9} {:>11.3g} {:>9.0f} {:>13}  {}", row.name(), width,
                                      row.n_dofs, row.run_time, row.memory_mb,
                                      shown_error(row.largest_error(study.quantities)),
                                      is_on_front ? "yes" : "")
                        : fmt::format("{:<{}}  {}", row.name(), width, row.status));
  }
  for (const std::string &line : describe_orders(results))
    lines.push_back(line);
  lines.push_back(results.cheapest ? fmt::format("Cheapest run with no error above {}: {}, {:.3g} s",
                                                 study.tolerance, results.rows[*results.cheapest].name(),
                                                 results.rows[*results.cheapest].run_time)
                                   : fmt::format("No run has all its errors below {}", study.tolerance));
  return lines;
}
} // namespace signorini
