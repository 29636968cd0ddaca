// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/parameters/value_range.h"

#include "signorini/parameters/strings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>

namespace signorini
{
namespace
{
bool is_name(const std::string &text)
{
  return !text.empty() &&
         std::all_of(text.begin(), text.end(),
                     [](const char character)
                     {
                       const auto byte = static_cast<unsigned char>(character);
                       return byte < 128 && (std::isalnum(byte) != 0 || character == '_' || character == '-');
                     });
}

bool are_names(const std::string &text)
{
  const std::vector<std::string> names = split(text, ',');
  return std::all_of(names.begin(), names.end(), is_name) &&
         std::set<std::string>(names.begin(), names.end()).size() == names.size();
}

bool in_bounds(const ValueRange &range, const double value)
{
  return (range.lower_excluded ? value > range.lower : value >= range.lower) &&
         (range.upper_excluded ? value < range.upper : value <= range.upper);
}

bool is_component(const ValueRange &range, const std::string &text)
{
  if (range.kind == ValueRange::Kind::integer)
  {
    const auto value = parse_integer(text);
    return value && in_bounds(range, static_cast<double>(*value));
  }
  const auto value = parse_number(text);
  return value && in_bounds(range, *value);
}

std::string describe_bounds(const ValueRange &range)
{
  const ValueRange unbounded;
  std::string result;
  if (range.kind == ValueRange::Kind::integer)
    return fmt::format(" from {} to {}", range.lower, range.upper);
  if (range.lower > unbounded.lower)
    result += fmt::format(" {} {:g}", range.lower_excluded ? ">" : "≥", range.lower);
  if (range.upper < unbounded.upper)
    result += fmt::format("{} {} {:g}", result.empty() ? "" : " and", range.upper_excluded ? "<" : "≤",
                          range.upper);
  return result;
}

std::string describe_components(const ValueRange &range)
{
  const bool integer = range.kind == ValueRange::Kind::integer;
  const std::string bounds = describe_bounds(range);
  if (range.max_components == 1)
    return (integer ? "an integer" : "a number") + bounds;
  const std::string count =
      range.min_components == range.max_components
          ? fmt::format("{}", range.max_components)
          : fmt::format("{} {} {}", range.min_components,
                        range.max_components == range.min_components + 1 ? "or" : "to", range.max_components);
  return fmt::format("{} {}{} separated by commas", count, integer ? "integers" : "numbers", bounds);
}

ValueRange of_kind(const ValueRange::Kind kind)
{
  ValueRange range;
  range.kind = kind;
  return range;
}
} // namespace

bool ValueRange::contains(const std::string &value) const
{
  switch (kind)
  {
  case Kind::text:
    return !value.empty();
  case Kind::names:
    return are_names(value);
  case Kind::boolean:
    return value == "true" || value == "false";
  case Kind::choice:
    return std::find(choices.begin(), choices.end(), value) != choices.end();
  default:
    break;
  }
  if (std::find(choices.begin(), choices.end(), value) != choices.end())
    return true;
  const std::vector<std::string> parts = split(value, ',');
  return parts.size() >= min_components && parts.size() <= max_components &&
         std::all_of(parts.begin(), parts.end(),
                     [this](const std::string &part) { return is_component(*this, part); });
}

std::string ValueRange::description() const
{
  switch (kind)
  {
  case Kind::text:
    return "any text";
  case Kind::names:
    return "different names of letters, digits, _ and -, separated by commas";
  case Kind::boolean:
    return "true or false";
  case Kind::choice:
    return "one of " + join(choices, ", ");
  default:
    return describe_components(*this) + (choices.empty() ? "" : ", or " + join(choices, ", "));
  }
}

ValueRange any_text()
{
  return {};
}
ValueRange any_names()
{
  return of_kind(ValueRange::Kind::names);
}
ValueRange true_or_false()
{
  return of_kind(ValueRange::Kind::boolean);
}
ValueRange any_number()
{
  return of_kind(ValueRange::Kind::number);
}

ValueRange one_of(const std::vector<std::string> &choices)
{
  ValueRange range = of_kind(ValueRange::Kind::choice);
  range.choices = choices;
  return range;
}

ValueRange number_from(const double lower)
{
  ValueRange range = any_number();
  range.lower = lower;
  return range;
}

ValueRange number_above(const double lower)
{
  ValueRange range = number_from(lower);
  range.lower_excluded = true;
  return range;
}

ValueRange positive_number()
{
  ValueRange range = number_from(1e-30);
  range.upper = 1e30;
  return range;
}

ValueRange positive_length()
{
  ValueRange range = number_from(1e-12);
  range.upper = 1e12;
  return range;
}

ValueRange number_from_up_to(const double lower, const double upper)
{
  ValueRange range = number_from(lower);
  range.upper = upper;
  return range;
}

ValueRange number_above_up_to(const double lower, const double upper)
{
  ValueRange range = number_above(lower);
  range.upper = upper;
  return range;
}

ValueRange number_between(const double lower, const double upper)
{
  ValueRange range = number_above_up_to(lower, upper);
  range.upper_excluded = true;
  return range;
}

ValueRange integer_from(const long lower, const long upper)
{
  ValueRange range = of_kind(ValueRange::Kind::integer);
  range.lower = static_cast<double>(lower);
  range.upper = static_cast<double>(upper);
  return range;
}

ValueRange or_word(ValueRange range, const std::string &word)
{
  range.choices.push_back(word);
  return range;
}

ValueRange list_of(ValueRange range, const unsigned int min_components, const unsigned int max_components)
{
  range.min_components = min_components;
  range.max_components = max_components;
  return range;
}
} // namespace signorini
