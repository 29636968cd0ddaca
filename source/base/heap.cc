// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/base/heap.h"

#include <malloc.h>

namespace signorini
{
std::size_t heap_in_use()
{
  const struct mallinfo2 all = mallinfo2();
  return all.uordblks + all.hblkhd; // in arenas, and mapped one by one
}
} // namespace signorini
