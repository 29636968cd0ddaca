// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/parameters/parameters.h"

#include <memory>
#include <string>
#include <vector>

namespace dealii
{
template <int dim>
class FunctionParser;
}

namespace signorini
{
/// A muParser formula of x, y, z and t, with the constant pi and deal.II's additional functions (if, pow,
/// erfc, …). Not safe to share between threads.
class Expression
{
public:
  /// Throws InputError, without a place, if the formula has a syntax error, or is one that muParser would
  /// silently misread: a comma outside a function call (1,000 would be 0), an assignment, several formulas,
  /// random numbers.
  explicit Expression(const std::string &formula);

  /// Value at a point in space and time. May be NaN or infinite.
  double value(const Triple &x, double t) const;

  /// Whether the formula has this variable: x, y, z or t.
  bool uses(const std::string &variable) const;

  const std::string &formula() const { return text; }

  /// A call of every function that formulas may use, for the manual.
  static const std::vector<std::string> &functions();

private:
  std::string text;
  std::shared_ptr<dealii::FunctionParser<3>> parser;
};
} // namespace signorini
