// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <limits>
#include <string>
#include <vector>

namespace signorini
{
/// Which values an entry may have.
struct ValueRange
{
  enum class Kind
  {
    text,    ///< anything but nothing
    names,   ///< distinct names of letters, digits, _ and -, separated by commas
    boolean, ///< true or false
    choice,  ///< one of a list of names
    integer,
    number
  };
  Kind kind = Kind::text;
  double lower = -std::numeric_limits<double>::max();
  double upper = std::numeric_limits<double>::max();
  bool lower_excluded = false;
  bool upper_excluded = false;
  unsigned int min_components = 1; ///< integers and numbers: how many, separated by commas
  unsigned int max_components = 1;
  std::vector<std::string> choices; ///< numbers: words that may stand instead

  bool contains(const std::string &value) const;
  std::string description() const;
};

/// Ranges by the names they are declared with.
ValueRange any_text();
ValueRange any_names();
ValueRange true_or_false();
ValueRange one_of(const std::vector<std::string> &choices);
ValueRange any_number();
ValueRange number_above(double lower);
/// A positive number whose products with its like stay within the range of floating point.
ValueRange positive_number();
/// A positive length: cubes of it must not vanish against anything.
ValueRange positive_length();
ValueRange number_from(double lower);
/// Both ends excluded.
ValueRange number_between(double lower, double upper);
/// Both ends included.
ValueRange number_from_up_to(double lower, double upper);
/// Lower end excluded.
ValueRange number_above_up_to(double lower, double upper);
ValueRange integer_from(long lower, long upper);
/// `range`, or a word instead.
ValueRange or_word(ValueRange range, const std::string &word);
/// `range` for each of min to max components separated by commas.
ValueRange list_of(ValueRange range, unsigned int min_components, unsigned int max_components);
} // namespace signorini
