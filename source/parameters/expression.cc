// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/parameters/expression.h"

#include "signorini/base/exceptions.h"
#include "signorini/parameters/strings.h"

#include <deal.II/base/function_parser.h>
#include <deal.II/base/numbers.h>

#include <cctype>
#include <iostream>
#include <regex>
#include <sstream>
#include <vector>

namespace signorini
{
namespace
{
bool is_word(const char character)
{
  return std::isalnum(static_cast<unsigned char>(character)) != 0 || character == '_';
}

/// Commas are allowed directly inside the parentheses of a function call only.
bool has_stray_comma(const std::string &formula)
{
  std::vector<bool> is_call;
  char previous = ' ';
  for (const char character : formula)
  {
    if (character == '(')
      is_call.push_back(is_word(previous));
    else if (character == ')' && !is_call.empty())
      is_call.pop_back();
    else if (character == ',' && (is_call.empty() || !is_call.back()))
      return true;
    if (character != ' ' && character != '\t')
      previous = character;
  }
  return false;
}

void reject(const std::string &formula, const std::string &fault, const std::string &next_step)
{
  throw InputError(Complaint("the expression " + fault).found("'" + formula + "'").advise(next_step));
}

void check_silent_mistakes(const std::string &formula)
{
  if (formula.find(';') != std::string::npos)
    reject(formula, "has a ';'", "give one formula");
  if (has_stray_comma(formula))
    reject(formula, "has a comma outside a function call",
           "write decimals with a point, and 1000 instead of 1,000");
  if (std::regex_search(formula, std::regex("(^|[^=<>!])=([^=]|$)")))
    reject(formula, "has an assignment", "compare with ==, or write a formula of x, y, z, t");
  if (std::regex_search(formula, std::regex("\\brand(_seed)?\\b")))
    reject(formula, "uses random numbers", "a run must be repeatable: use a formula of x, y, z, t");
}

/// Keeps deal.II from printing the fault itself, on every rank.
class SilentErrorStream
{
public:
  SilentErrorStream() : original(std::cerr.rdbuf(ignored.rdbuf())) {}
  ~SilentErrorStream() { std::cerr.rdbuf(original); }
  SilentErrorStream(const SilentErrorStream &) = delete;
  SilentErrorStream &operator=(const SilentErrorStream &) = delete;

private:
  std::ostringstream ignored;
  std::streambuf *original;
};

/// The sentence of muParser inside a deal.II exception.
std::string parser_message(const dealii::ExceptionBase &error)
{
  std::ostringstream stream;
  error.print_info(stream);
  std::smatch sentence;
  const std::string text = stream.str();
  return std::regex_search(text, sentence, std::regex("parser said: *<?([^\\n>]*)")) ? sentence[1].str()
                                                                                     : trim(text);
}
} // namespace

Expression::Expression(const std::string &formula)
    : text(formula), parser(std::make_shared<dealii::FunctionParser<3>>(1))
{
  check_silent_mistakes(formula);
  try
  {
    const SilentErrorStream silence;
    parser->initialize("x,y,z,t", formula, {{"pi", dealii::numbers::PI}}, true);
    parser->value(dealii::Point<3>());
  }
  catch (const dealii::ExceptionBase &error)
  {
    throw InputError(Complaint("the expression cannot be understood: " + parser_message(error))
                         .found("'" + formula + "'")
                         .expected("a muParser formula of x, y, z, t, pi, such as 0.1*sin(2*pi*t)")
                         .advise("correct the formula"));
  }
}

double Expression::value(const Triple &x, const double t) const
{
  parser->set_time(t);
  return parser->value(dealii::Point<3>(x[0], x[1], x[2]));
}

const std::vector<std::string> &Expression::functions()
{
  static const std::vector<std::string> calls{
      "if(t < 1, x, y)", "abs(x)",  "sign(x)", "min(x, y)", "max(x, y)", "sum(x, y)", "avg(x, y)",
      "sqrt(x)",         "exp(x)",  "ln(x)",   "log(x)",    "log2(x)",   "log10(x)",  "pow(x, 2)",
      "sin(x)",          "cos(x)",  "tan(x)",  "cot(x)",    "sec(x)",    "csc(x)",    "asin(x)",
      "acos(x)",         "atan(x)", "sinh(x)", "cosh(x)",   "tanh(x)",   "asinh(x)",  "acosh(x)",
      "atanh(x)",        "erfc(x)", "rint(x)", "floor(x)",  "ceil(x)",   "int(x)"};
  return calls;
}

bool Expression::uses(const std::string &variable) const
{
  return std::regex_search(text, std::regex("\\b" + variable + "\\b"));
}
} // namespace signorini
