// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace signorini
{
/// What a user is told when something is wrong. Empty parts are left out of the text.
struct Complaint
{
  std::string what;      ///< one sentence without a full stop
  std::string where;     ///< file:line, or a cell and its coordinates
  std::string value;     ///< what was found
  std::string allowed;   ///< the range or the names that are allowed
  std::string nearest;   ///< the valid name nearest to the one given
  std::string next_step; ///< what to do about it

  explicit Complaint(std::string sentence);
  Complaint &at(const std::string &place);
  Complaint &found(const std::string &text);
  Complaint &expected(const std::string &range);
  Complaint &did_you_mean(const std::string &name);
  Complaint &advise(const std::string &step);
  /// All parts, one a line: `where: what`, then the indented rest.
  std::string text() const;
};

/// Anything that ends the program with a message of its own and an exit code.
class ProgramError : public std::runtime_error
{
public:
  ProgramError(const Complaint &report, int number);
  int exit_code() const { return code; }
  const Complaint &complaint() const { return parts; }

private:
  Complaint parts;
  int code;
};

/// A calculation that failed: exit code 1.
class NumericalError : public ProgramError
{
public:
  explicit NumericalError(const Complaint &report);
  explicit NumericalError(const std::string &what);
};

/// Input that cannot be run: exit code 2.
class InputError : public ProgramError
{
public:
  explicit InputError(const Complaint &report);
  explicit InputError(const std::string &what);
};

/// A file or directory that cannot be read or written: exit code 3.
class FileError : public ProgramError
{
public:
  explicit FileError(const Complaint &report);
  explicit FileError(const std::string &what);
};

/// Number of insertions, deletions, replacements and swaps of neighbours that turn one text into the other,
/// upper and lower case taken as equal.
unsigned int edit_distance(const std::string &first, const std::string &second);

/// The candidate with the smallest edit distance to `name`; empty if none shares even a third with it, or its
/// first three letters.
std::string nearest_name(const std::string &name, const std::vector<std::string> &candidates);
} // namespace signorini
