// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

namespace signorini
{
/// `set key = value` where it stands.
struct ParameterEntry
{
  std::string path; ///< names of the enclosing subsections joined by '/'; empty at the top level
  std::string key;
  std::string value;
  std::string file; ///< or, for an override on the command line, its quotation
  int line = 0;     ///< 0 for an override

  std::string where() const; ///< `file:line`, or the override
};

/// `subsection name` where it stands (where it was opened first).
struct ParameterSubsection
{
  std::string path; ///< including its own name
  std::string file;
  int line = 0;

  std::string name() const;   ///< last part of the path
  std::string parent() const; ///< path without the last part
  std::string where() const;
};

/// A parameter file taken apart: nothing is known yet about which names are valid.
struct ParameterText
{
  std::string file; ///< as given by the user; "-" is standard input
  std::vector<ParameterEntry> entries;
  std::vector<ParameterSubsection> subsections;

  /// Null if absent.
  const ParameterEntry *find(const std::string &path, const std::string &key) const;
  const ParameterSubsection *find_subsection(const std::string &path) const;
  /// Value of an entry; `fallback` if it is absent.
  std::string value(const std::string &path, const std::string &key, const std::string &fallback = "") const;
  /// Where a subsection stands; for the top level or an absent one the file.
  std::string where(const std::string &path) const;
  /// Where an entry stands; for an absent one its subsection.
  std::string where(const std::string &path, const std::string &key) const;
  /// Last names of the subsections directly below `path` that start with `prefix`.
  std::vector<std::string> names_below(const std::string &path, const std::string &prefix = "") const;
};

/// Join two parts of a path by '/'.
std::string join_path(const std::string &path, const std::string &name);

/// Name of a parameter file in messages.
std::string display_name(const std::string &file);

/// Read a parameter file, or standard input for "-" (rank 0 reads and broadcasts; collective).
///
/// The syntax is that of dealii::ParameterHandler: `subsection NAME`, `set KEY = VALUE`, `end`, `include
/// FILE` (relative to the including file), `#` starts a comment, a backslash at the end of a line continues
/// it. Throws InputError for a duplicate key or subsection, an empty file, unbalanced subsections, any other
/// line, and a missing or circular include; as read_input_file() if the file itself cannot be read.
ParameterText read_parameter_text(const std::string &file);

/// The same for text in memory; `file` is its name in messages.
ParameterText scan_parameter_text(const std::string &content, const std::string &file);

/// Put an entry into the text, instead of the one there of that name; its subsections are added where they
/// are missing.
void set_entry(ParameterText &text, const ParameterEntry &entry);

/// Take a subsection with all that stands in it out of the text; it may be absent.
void remove_subsection(ParameterText &text, const std::string &path);

/// Apply "Section/Subsection/Key=value" as though it stood in the file; replaces the entry there.
/// Throws InputError if it has no such form. Whether its name is valid is found by read_parameters().
void apply_override(ParameterText &text, const std::string &override_text);
} // namespace signorini
