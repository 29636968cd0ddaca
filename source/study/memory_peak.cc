// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/study/memory_peak.h"

#include <fstream>

#include <malloc.h>

namespace signorini
{
bool reset_memory_peak()
{
  malloc_trim(0);
  // proc(5): 5 resets the peak of the resident set size.
  std::ofstream file("/proc/self/clear_refs");
  file << "5\n" << std::flush;
  return static_cast<bool>(file);
}
} // namespace signorini
