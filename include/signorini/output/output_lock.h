// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

namespace signorini
{
/// Keeps other runs out of an output directory for as long as this object lives, and leaves nothing there.
/// The end of the program, however it comes, ends it too.
class OutputLock
{
public:
  /// Makes the directory if need be. Throws FileError if it cannot, or if another run has the directory.
  explicit OutputLock(const std::string &directory);
  ~OutputLock();
  OutputLock(const OutputLock &) = delete;
  OutputLock &operator=(const OutputLock &) = delete;

private:
  int descriptor;
};
} // namespace signorini
