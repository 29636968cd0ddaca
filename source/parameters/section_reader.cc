// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/parameters/section_reader.h"

#include "signorini/parameters/strings.h"

#include <fmt/format.h>

#include <algorithm>

namespace signorini
{
SectionReader::SectionReader(const ParameterText &parameter_text, const Declarations &declarations,
                             const std::string &path, const unsigned int n_components)
    : text(parameter_text), in_use(declarations), section(path), dimension(n_components)
{
}

bool SectionReader::given(const std::string &key) const
{
  return !text.value(section, key).empty();
}

std::string SectionReader::value(const std::string &key) const
{
  const Declaration *const declaration = in_use.find(section, key);
  return text.value(section, key, declaration != nullptr ? declaration->default_value : "");
}

double SectionReader::number(const std::string &key) const
{
  return parse_number(value(key)).value();
}

unsigned int SectionReader::integer(const std::string &key) const
{
  return static_cast<unsigned int>(parse_integer(value(key)).value());
}

bool SectionReader::boolean(const std::string &key) const
{
  return value(key) == "true";
}

std::array<unsigned int, 3> SectionReader::integers(const std::string &key) const
{
  std::array<unsigned int, 3> result{{1, 1, 1}};
  const std::vector<std::string> parts = split(value(key), ',');
  for (std::size_t c = 0; c < parts.size(); ++c)
    result[c] = static_cast<unsigned int>(parse_integer(parts[c]).value());
  return result;
}

Triple SectionReader::vector(const std::string &key) const
{
  Triple result{};
  const std::vector<std::string> parts = split(value(key), ',');
  for (std::size_t c = 0; c < parts.size(); ++c)
    result[c] = parse_number(parts[c]).value();
  if (dimension == 2 && result[2] != 0.)
    throw InputError(
        complain(key, fmt::format("the third component of '{}' is not zero in two dimensions", key))
            .expected("2 or 3 numbers separated by commas, the third 0")
            .advise("the second component is the vertical one, or set Dimension = 3"));
  return result;
}

std::vector<std::string> SectionReader::formulas(const std::string &key) const
{
  const std::vector<std::string> parts = split(value(key), ';');
  const bool complete =
      std::none_of(parts.begin(), parts.end(), [](const auto &part) { return part.empty(); });
  if (parts.size() != dimension || !complete)
    throw InputError(
        complain(key, fmt::format("'{}' needs {} formulas, not {}", key, dimension, parts.size()))
            .expected(fmt::format("{} formulas separated by ';'", dimension))
            .advise(dimension == 3 ? "write for example 0; 0; -1e6*t" : "write for example 0; -1e6*t"));
  return parts;
}

std::string SectionReader::place(const std::string &key) const
{
  return text.where(section, key);
}

Complaint SectionReader::complain(const std::string &key, const std::string &what) const
{
  const ParameterEntry *const entry = text.find(section, key);
  const std::string shown = value(key);
  return Complaint(what)
      .at(place(key))
      .found(fmt::format("{} = {}{}", join_path(section, key), shown.empty() ? "nothing" : shown,
                         entry != nullptr ? "" : " (default)"));
}

Complaint SectionReader::complain(const std::string &what) const
{
  return Complaint(what).at(text.where(section));
}
} // namespace signorini
