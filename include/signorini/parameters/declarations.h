// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/parameters/parameter_text.h"
#include "signorini/parameters/value_range.h"

#include <string>
#include <vector>

namespace signorini
{
/// A valid entry of the parameter file.
struct Declaration
{
  std::string path;
  std::string key;
  ValueRange range;
  std::string default_value; ///< empty: none, the entry may be absent unless it is required
  std::string unit;          ///< SI; empty if it has none
  std::string text;          ///< one sentence
  bool required = false;
};

/// A valid subsection of the parameter file.
struct DeclaredSubsection
{
  std::string path;
  std::string text;
};

/// All valid subsections and entries, in the order in which they are printed.
struct Declarations
{
  std::vector<DeclaredSubsection> subsections;
  std::vector<Declaration> entries;

  const Declaration *find(const std::string &path, const std::string &key) const;
  bool has_subsection(const std::string &path) const;
};

/// Declares the entries of one subsection.
class SubsectionDeclaration
{
public:
  SubsectionDeclaration(Declarations &all, const std::string &subsection, const std::string &text);
  void add(const std::string &key, const ValueRange &range, const std::string &default_value,
           const std::string &unit, const std::string &text);
  void add_required(const std::string &key, const ValueRange &range, const std::string &unit,
                    const std::string &text);

private:
  Declarations &declarations;
  std::string path;
};

/// What is declared.
enum class Extent
{
  everything, ///< all that could stand in the file: what names are checked against, and the manual
  in_use      ///< subsections that are present, with the entries that belong to the shapes and cases chosen
};

/// What the declarations depend on.
struct DeclarationScope
{
  const ParameterText &text;
  Extent extent;
  unsigned int dimension;

  bool includes(const std::string &path) const;
  /// Whether the entries belonging to `choice` of the entry `key` are declared.
  bool chosen(const std::string &path, const std::string &key, const std::string &choice,
              const std::string &default_choice) const;
  /// The first two or all components of "x, y, z".
  std::string components(const std::string &three) const;
  /// A vector: `dimension` to three numbers.
  ValueRange vector() const;
};

/// Throws InputError if the text has a name that is not declared, or a value out of its range.
void check_names_and_values(const ParameterText &text, const Declarations &everything);

/// Throws InputError for an entry that does not belong to the shape or case chosen, and for a required one
/// that is absent.
void check_presence(const ParameterText &text, const Declarations &in_use);
} // namespace signorini
