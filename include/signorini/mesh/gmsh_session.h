// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/base/exceptions.h"

#include <functional>
#include <string>

namespace signorini
{
/// Gmsh's library between its start and its end: an empty model, on one thread, silent, the same random
/// numbers each time, without the user's configuration files. One at a time in a process.
class GmshSession
{
public:
  GmshSession();
  ~GmshSession();
  GmshSession(const GmshSession &) = delete;
  GmshSession &operator=(const GmshSession &) = delete;

  /// Calls `work`; if Gmsh gives up, throws `complaint` as InputError with what Gmsh said.
  void run(const Complaint &complaint, const std::function<void()> &work) const;
};
} // namespace signorini
