// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/base/exceptions.h"
#include "signorini/parameters/declarations.h"
#include "signorini/parameters/parameters.h"

#include <string>
#include <utility>
#include <vector>

namespace signorini
{
/// The visible names of the values of an enum.
template <typename Value>
using NameTable = std::vector<std::pair<std::string, Value>>;

template <typename Value>
std::vector<std::string> names_in(const NameTable<Value> &table)
{
  std::vector<std::string> names;
  for (const auto &entry : table)
    names.push_back(entry.first);
  return names;
}

/// Reads the entries of one subsection, or their defaults. Names and values must have been checked before.
class SectionReader
{
public:
  SectionReader(const ParameterText &parameter_text, const Declarations &declarations,
                const std::string &path, unsigned int n_components);

  /// Whether the file gives the entry a value.
  bool given(const std::string &key) const;
  std::string value(const std::string &key) const;
  double number(const std::string &key) const;
  unsigned int integer(const std::string &key) const;
  bool boolean(const std::string &key) const;
  /// Up to three integers; the missing ones are one.
  std::array<unsigned int, 3> integers(const std::string &key) const;
  /// A vector; throws InputError if it has a third component other than zero in two dimensions.
  Triple vector(const std::string &key) const;
  /// One formula a component, separated by ';'; throws InputError for another number of them.
  std::vector<std::string> formulas(const std::string &key) const;

  template <typename Value>
  Value choice(const std::string &key, const NameTable<Value> &table) const
  {
    const std::string name = value(key);
    for (const auto &entry : table)
      if (entry.first == name)
        return entry.second;
    throw InputError(complain(key, "unknown choice"));
  }

  /// Where the entry stands; for an absent one its subsection.
  std::string place(const std::string &key) const;
  /// A complaint about an entry, with its place and value.
  Complaint complain(const std::string &key, const std::string &what) const;
  /// A complaint about the subsection, with its place.
  Complaint complain(const std::string &what) const;
  const std::string &path() const { return section; }

private:
  const ParameterText &text;
  const Declarations &in_use;
  std::string section;
  unsigned int dimension;
};
} // namespace signorini
