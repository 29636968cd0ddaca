// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/base/exceptions.h"

#include <algorithm>
#include <cctype>
#include <utility>

namespace signorini
{
Complaint::Complaint(std::string sentence) : what(std::move(sentence)) {}

Complaint &Complaint::at(const std::string &place)
{
  where = place;
  return *this;
}

Complaint &Complaint::found(const std::string &text)
{
  value = text;
  return *this;
}

Complaint &Complaint::expected(const std::string &range)
{
  allowed = range;
  return *this;
}

Complaint &Complaint::did_you_mean(const std::string &name)
{
  nearest = name;
  return *this;
}

Complaint &Complaint::advise(const std::string &step)
{
  next_step = step;
  return *this;
}

std::string Complaint::text() const
{
  std::string result = where.empty() ? what : where + ": " + what;
  const auto append =
      [&result](const std::string &label, const std::string &part, const std::string &end = "")
  {
    if (!part.empty())
      result += "\n  " + label + part + end;
  };
  append("value:   ", value);
  append("allowed: ", allowed);
  append("did you mean '", nearest, "'?");
  append("next:    ", next_step);
  return result;
}

ProgramError::ProgramError(const Complaint &report, const int number)
    : std::runtime_error(report.text()), parts(report), code(number)
{
}

NumericalError::NumericalError(const Complaint &report) : ProgramError(report, 1) {}
NumericalError::NumericalError(const std::string &what) : NumericalError(Complaint(what)) {}
InputError::InputError(const Complaint &report) : ProgramError(report, 2) {}
InputError::InputError(const std::string &what) : InputError(Complaint(what)) {}
FileError::FileError(const Complaint &report) : ProgramError(report, 3) {}
FileError::FileError(const std::string &what) : FileError(Complaint(what)) {}

namespace
{
bool is_same_letter(const char a, const char b)
{
  return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
}

/// At the beginning of both.
std::size_t count_common_letters(const std::string &first, const std::string &second)
{
  const auto end = std::mismatch(first.begin(), first.end(), second.begin(), second.end(), is_same_letter);
  return end.first - first.begin();
}
} // namespace

unsigned int edit_distance(const std::string &first, const std::string &second)
{
  const std::size_t n_columns = second.size() + 1;
  std::vector<unsigned int> before(n_columns), above(n_columns), row(n_columns);
  for (std::size_t j = 0; j < n_columns; ++j)
    row[j] = static_cast<unsigned int>(j);
  for (std::size_t i = 1; i <= first.size(); ++i)
  {
    before.swap(above);
    above.swap(row);
    row[0] = static_cast<unsigned int>(i);
    for (std::size_t j = 1; j < n_columns; ++j)
    {
      const unsigned int replacement = is_same_letter(first[i - 1], second[j - 1]) ? 0 : 1;
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + replacement});
      if (i > 1 && j > 1 && is_same_letter(first[i - 1], second[j - 2]) &&
          is_same_letter(first[i - 2], second[j - 1]))
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row.back();
}

std::string nearest_name(const std::string &name, const std::vector<std::string> &candidates)
{
  std::string nearest;
  unsigned int smallest = 0;
  for (const std::string &candidate : candidates)
  {
    const unsigned int distance = edit_distance(name, candidate);
    const bool related = 3 * distance <= 2 * std::max(name.size(), candidate.size()) ||
                         count_common_letters(name, candidate) >= 3;
    if (related && (nearest.empty() || distance < smallest))
    {
      nearest = candidate;
      smallest = distance;
    }
  }
  return nearest;
}
} // namespace signorini
