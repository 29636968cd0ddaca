// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/study/study_row.h"

#include <optional>
#include <string>
#include <vector>

namespace signorini
{
/// Straight line through points in log-log: error ∝ x^order.
struct OrderFit
{
  double order = 0.;
  double standard_error = 0.; ///< of the order
  double r_squared = 0.;      ///< share of the variance of log(error) explained; 1 if there is none
  unsigned int n_points = 0;
};

/// Least squares over the points whose x and error are positive and finite. Nothing unless they have three
/// different x at least.
std::optional<OrderFit> fit_order(const std::vector<double> &x, const std::vector<double> &errors);

/// How an error falls along one list of a study, everything else held.
struct ObservedOrder
{
  std::string quantity;
  std::string variable;             ///< of which the error is a power, such as "1/alpha"
  std::vector<StudySetting> others; ///< what was held
  OrderFit fit;
};

/// Orders of all quantities, wherever three runs or more differ in one list only: in h by levels of uniform
/// refinement, in n_dofs^(-1/dim) along both kinds of mesh, in 1/α and in the time step.
std::vector<ObservedOrder> find_orders(const std::vector<StudyRow> &rows, unsigned int dimension);
} // namespace signorini
