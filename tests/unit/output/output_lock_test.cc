// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/output/output_lock.h"

#include "signorini/base/exceptions.h"

#include <gtest/gtest.h>

#include <filesystem>

using namespace signorini;

namespace
{
TEST(OutputLock, KeepsOthersOutWhileItLivesAndLeavesNothing)
{
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "signorini_output_lock";
  std::filesystem::remove_all(folder);
  {
    const OutputLock lock(folder.string());
    EXPECT_THROW(OutputLock(folder.string()), FileError);
  }
  EXPECT_NO_THROW(OutputLock(folder.string()));
  EXPECT_TRUE(std::filesystem::is_empty(folder));
  std::filesystem::remove_all(folder);
}
} // namespace
