// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/study/observed_order.h"

#include <gtest/gtest.h>

#include <cmath>

namespace signorini
{
namespace
{
using Factor = StudyParameters::Factor;

TEST(FitOrder, FindsAPower)
{
  std::vector<double> x, errors;
  for (const double h : {0.5, 0.25, 0.125, 0.0625})
  {
    x.push_back(h);
    errors.push_back(7. * std::pow(h, 1.5));
  }
  const OrderFit fit = fit_order(x, errors).value();
  EXPECT_NEAR(fit.order, 1.5, 1e-12);
  EXPECT_NEAR(fit.standard_error, 0., 1e-7);
  EXPECT_NEAR(fit.r_squared, 1., 1e-12);
  EXPECT_EQ(fit.n_points, 4u);
}

TEST(FitOrder, SaysHowFarPointsScatter)
{
  // log2: x = 0, 1, 2 and y = 0, 2, 1: the slope is 1/2, the residuals −1/2, 1, −1/2, with one degree of
  // freedom.
  const OrderFit fit = fit_order({1., 2., 4.}, {1., 4., 2.}).value();
  EXPECT_NEAR(fit.order, 0.5, 1e-12);
  EXPECT_NEAR(fit.r_squared, 0.25, 1e-12);
  EXPECT_NEAR(fit.standard_error, std::sqrt(1.5 / 2.), 1e-12);
}

TEST(FitOrder, LeavesOutWhatHasNoLogarithm)
{
  const double nan = StudyRow::none;
  const OrderFit fit = fit_order({1., 2., 4., 8., nan}, {1., 2., 0., 8., 3.}).value();
  EXPECT_EQ(fit.n_points, 3u);
  EXPECT_NEAR(fit.order, 1., 1e-12);
  EXPECT_FALSE(fit_order({1., 2., 4.}, {1., nan, 4.}));
}

TEST(FitOrder, NeedsThreePlaces)
{
  EXPECT_FALSE(fit_order({}, {}));
  EXPECT_FALSE(fit_order({1., 2.}, {1., 2.}));
  EXPECT_FALSE(fit_order({1., 1., 2., 2.}, {1., 2., 3., 4.}));
}

TEST(FitOrder, TakesErrorsThatDoNotFall)
{
  const OrderFit fit = fit_order({1., 2., 4.}, {3., 3., 3.}).value();
  EXPECT_EQ(fit.order, 0.);
  EXPECT_EQ(fit.r_squared, 1.);
}

/// Error 2^−level/α of a run with 4^level dofs.
StudyRow row(const std::string &level, const std::string &alpha)
{
  StudyRow result;
  result.settings = {{Factor::uniform_refinements, level}, {Factor::penalty_factor, alpha}};
  result.status = "ok";
  result.n_dofs = static_cast<unsigned int>(std::pow(4., std::stod(level)));
  const double error = alpha == "auto" ? 1. : std::exp2(-std::stod(level)) / std::stod(alpha);
  result.errors = {{"q", 1. - error, 1., -error}};
  return result;
}

TEST(FindOrders, HoldsAllListsButOne)
{
  std::vector<StudyRow> rows;
  for (const std::string level : {"0", "1", "2"})
    for (const std::string alpha : {"1", "10", "1e2", "auto"})
      rows.push_back(row(level, alpha));
  const std::vector<ObservedOrder> orders = find_orders(rows, 2);
  unsigned int n_in_h = 0, n_in_dofs = 0, n_in_alpha = 0;
  for (const ObservedOrder &order : orders)
  {
    n_in_h += order.variable == "h" ? 1 : 0;
    n_in_dofs += order.variable == "n_dofs^(-1/2) of uniform meshes" ? 1 : 0;
    n_in_alpha += order.variable == "1/alpha" ? 1 : 0;
    EXPECT_EQ(order.quantity, "q");
    EXPECT_EQ(order.fit.n_points, 3u) << order.variable;
    const bool is_auto = order.others == std::vector<StudySetting>{{Factor::penalty_factor, "auto"}};
    EXPECT_NEAR(order.fit.order, is_auto ? 0. : 1., 1e-12) << order.variable;
  }
  EXPECT_EQ(n_in_h, 4u);
  EXPECT_EQ(n_in_dofs, 4u);
  EXPECT_EQ(n_in_alpha, 3u); // "auto" is no place on the axis
  EXPECT_EQ(orders.size(), 11u);
}
} // namespace
} // namespace signorini
