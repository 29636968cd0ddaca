// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/study/observed_order.h"

#include "signorini/parameters/strings.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>

namespace signorini
{
namespace
{
using Factor = StudyParameters::Factor;

/// A variable that a list of the study changes.
struct Variable
{
  Factor factor;
  std::string name;
  std::function<double(const StudyRow &, const std::string &)> value; ///< of a row and its list's value
};

double numeric(const std::string &value)
{
  return parse_number(value).value_or(StudyRow::none);
}

std::vector<Variable> variables(const unsigned int dimension)
{
  const auto by_dofs = [dimension](const StudyRow &row, const std::string &)
  { return std::pow(row.n_dofs, -1. / dimension); };
  const std::string dofs = dimension == 2 ? "n_dofs^(-1/2)" : "n_dofs^(-1/3)";
  return {{Factor::uniform_refinements, "h",
           [](const StudyRow &, const std::string &level) { return std::exp2(-numeric(level)); }},
          {Factor::uniform_refinements, dofs + " of uniform meshes", by_dofs},
          {Factor::adaptive_cycles, dofs + " of adaptive meshes", by_dofs},
          {Factor::penalty_factor, "1/alpha",
           [](const StudyRow &, const std::string &alpha) { return 1. / numeric(alpha); }},
          {Factor::step_factor, "time step",
           [](const StudyRow &, const std::string &step) { return numeric(step); }}};
}

/// Rows that agree in all settings but the factor, with their values of the variable, by these settings.
struct Series
{
  std::vector<const StudyRow *> rows;
  std::vector<double> x;
};

std::map<std::vector<StudySetting>, Series> find_series(const std::vector<StudyRow> &rows,
                                                        const Variable &variable)
{
  std::map<std::vector<StudySetting>, Series> all;
  for (const StudyRow &row : rows)
  {
    std::vector<StudySetting> others = row.settings;
    const auto own = std::find_if(others.begin(), others.end(),
                                  [&](const StudySetting &other) { return other.first == variable.factor; });
    if (own == others.end())
      continue;
    const double x = variable.value(row, own->second);
    others.erase(own);
    Series &series = all[others];
    series.rows.push_back(&row);
    series.x.push_back(x);
  }
  return all;
}

std::vector<std::string> quantities_of(const std::vector<StudyRow> &rows)
{
  for (const StudyRow &row : rows)
    if (!row.errors.empty())
    {
      std::vector<std::string> names;
      for (const StudyError &error : row.errors)
        names.push_back(error.quantity);
      return names;
    }
  return {};
}
} // namespace

std::optional<OrderFit> fit_order(const std::vector<double> &x, const std::vector<double> &errors)
{
  std::vector<double> log_x, log_error;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (std::isfinite(x[i]) && std::isfinite(errors[i]) && x[i] > 0. && errors[i] > 0.)
    {
      log_x.push_back(std::log(x[i]));
      log_error.push_back(std::log(errors[i]));
    }
  const auto n = static_cast<Eigen::Index>(log_x.size());
  if (std::set<double>(log_x.begin(), log_x.end()).size() < 3)
    return {};
  const Eigen::Map<const Eigen::VectorXd> all_x(log_x.data(), n), all_y(log_error.data(), n);
  // About their means, both columns of the system are orthogonal.
  const Eigen::VectorXd centred_x = all_x.array() - all_x.mean(), centred_y = all_y.array() - all_y.mean();
  OrderFit fit;
  fit.n_points = static_cast<unsigned int>(n);
  fit.order = centred_x.dot(centred_y) / centred_x.squaredNorm();
  const double residual = (centred_y - fit.order * centred_x).squaredNorm();
  const double variance = centred_y.squaredNorm();
  fit.standard_error = std::sqrt(residual / static_cast<double>(n - 2) / centred_x.squaredNorm());
  fit.r_squared = variance > 0. ? 1. - residual / variance : 1.;
  return fit;
}

std::vector<ObservedOrder> find_orders(const std::vector<StudyRow> &rows, const unsigned int dimension)
{
  std::vector<ObservedOrder> orders;
  for (const std::string &quantity : quantities_of(rows))
    for (const Variable &variable : variables(dimension))
      for (const auto &[others, series] : find_series(rows, variable))
      {
        std::vector<double> errors;
        for (const StudyRow *const row : series.rows)
          errors.push_back(row->error(quantity));
        if (const std::optional<OrderFit> fit = fit_order(series.x, errors))
          orders.push_back({quantity, variable.name, others, *fit});
      }
  return orders;
}
} // namespace signorini
