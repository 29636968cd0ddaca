// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/study/memory_peak.h"

#include <deal.II/base/utilities.h>

#include <gtest/gtest.h>

#include <memory>

namespace signorini
{
namespace
{
/// [MB]
double memory_peak()
{
  dealii::Utilities::System::MemoryStats memory;
  dealii::Utilities::System::get_memory_stats(memory);
  return static_cast<double>(memory.VmHWM) / 1024.;
}

TEST(MemoryPeak, ForgetsWhatWasFreed)
{
  if (!reset_memory_peak())
    GTEST_SKIP() << "the kernel does not allow it";
  const double before = memory_peak();
  constexpr std::size_t size = 200'000'000;
  {
    const std::unique_ptr<volatile char[]> block(new char[size]);
    for (std::size_t i = 0; i < size; i += 1024)
      block[i] = 1;
  }
  EXPECT_GT(memory_peak(), before + 150.);
  EXPECT_TRUE(reset_memory_peak());
  EXPECT_LT(memory_peak(), before + 50.);
}
} // namespace
} // namespace signorini
