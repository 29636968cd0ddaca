// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/mesh/abaqus_lines.h"

#include "signorini/mesh/file_content.h"

#include <algorithm>
#include <cctype>

namespace signorini
{
namespace
{
std::string trim(const std::string &text)
{
  const std::size_t first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

/// Between commas; a comma at the end opens no further field.
std::vector<std::string> fields_of(const std::string &line)
{
  std::vector<std::string> fields;
  for (std::size_t first = 0; first < line.size();)
  {
    const std::size_t end = std::min(line.find(',', first), line.size());
    fields.push_back(trim(line.substr(first, end - first)));
    first = end + 1;
  }
  return fields;
}

void take_options(const std::string &text, AbaqusLine &line)
{
  const std::vector<std::string> fields = fields_of(text);
  line.keyword = upper_case(fields.front());
  for (std::size_t i = 1; i < fields.size(); ++i)
  {
    const std::size_t equals = std::min(fields[i].find('='), fields[i].size());
    std::string value = equals == fields[i].size() ? "" : trim(fields[i].substr(equals + 1));
    if (value.size() > 1 && value.front() == '"' && value.back() == '"')
      value = value.substr(1, value.size() - 2);
    line.options[upper_case(trim(fields[i].substr(0, equals)))] = value;
  }
}
} // namespace

std::string upper_case(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(),
                 [](const unsigned char character) { return std::toupper(character); });
  return text;
}

std::string AbaqusLine::option(const std::string &name) const
{
  const auto found = options.find(name);
  return found == options.end() ? "" : found->second;
}

AbaqusLines::AbaqusLines(const std::string &path) : stream(read_content(path)) {}

bool AbaqusLines::next(AbaqusLine &line)
{
  std::string text;
  for (std::string physical; (text.empty() || text.back() == ',') && std::getline(stream, physical);)
  {
    ++number;
    const std::string part = trim(physical);
    if (part.empty() || part.compare(0, 2, "**") == 0)
      continue;
    text += part;
    if (text[0] != '*')
      break;
  }
  line = {};
  line.number = number;
  if (!text.empty() && text[0] == '*')
    take_options(text, line);
  else
    line.fields = fields_of(text);
  return !text.empty();
}
} // namespace signorini
