// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/parameters/strings.h"

#include <charconv>
#include <cmath>
#include <sstream>

namespace signorini
{
namespace
{
constexpr const char *white_space = " \t\r\n\v\f";

template <typename Value>
std::optional<Value> parse(const std::string &text)
{
  Value value{};
  const bool sign = text.size() > 1 && text[0] == '+' && text[1] != '-';
  const char *const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data() + (sign ? 1 : 0), end, value);
  if (error != std::errc() || stop != end)
    return {};
  return value;
}
} // namespace

std::string trim(const std::string &text)
{
  const std::size_t begin = text.find_first_not_of(white_space);
  return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(white_space) + 1 - begin);
}

std::string collapse_spaces(const std::string &text)
{
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;)
    words.push_back(word);
  return join(words, " ");
}

std::vector<std::string> split(const std::string &text, const char separator)
{
  std::vector<std::string> parts;
  if (trim(text).empty())
    return parts;
  std::size_t begin = 0;
  for (std::size_t end = text.find(separator); end != std::string::npos; end = text.find(separator, begin))
  {
    parts.push_back(trim(text.substr(begin, end - begin)));
    begin = end + 1;
  }
  parts.push_back(trim(text.substr(begin)));
  return parts;
}

std::string join(const std::vector<std::string> &parts, const std::string &separator)
{
  std::string result;
  for (const std::string &part : parts)
    result += (&part == parts.data() ? "" : separator) + part;
  return result;
}

std::optional<double> parse_number(const std::string &text)
{
  const std::optional<double> value = parse<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<long> parse_integer(const std::string &text)
{
  return parse<long>(text);
}
} // namespace signorini
