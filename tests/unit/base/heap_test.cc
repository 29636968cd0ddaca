// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/base/heap.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

namespace signorini
{
namespace
{
TEST(Heap, TellsWhatIsAllocatedAndFreed)
{
  const std::size_t before = heap_in_use();
  if (before == 0)
    GTEST_SKIP() << "the C library does not tell";
  for (const std::size_t size : {100'000ul, 100'000'000ul}) // below and above what is mapped by itself
  {
    auto memory = std::make_unique<std::vector<char>>(size);
    EXPECT_GE(heap_in_use(), before + size);
    EXPECT_LE(heap_in_use(), before + size + 10'000); // what the test itself takes
    memory.reset();
    EXPECT_LE(heap_in_use(), before + 10'000);
  }
}
} // namespace
} // namespace signorini
