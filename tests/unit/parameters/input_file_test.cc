// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/parameters/input_file.h"

#include "signorini/base/exceptions.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

using namespace signorini;

namespace
{
class InputFile : public testing::Test
{
protected:
  void TearDown() override { std::filesystem::remove(file); }
  void write(const std::string &content) const { std::ofstream(file) << content; }

  const std::string file = testing::TempDir() + "signorini_input_file.prm";
};

TEST_F(InputFile, IsReadToItsEnd)
{
  const std::string content(200000, 'a');
  write(content);
  EXPECT_EQ(read_input_file(file), content);
  write("");
  EXPECT_EQ(read_input_file(file), "");
}

TEST_F(InputFile, IsRefusedIfItIsADeviceOrTooLarge)
{
  EXPECT_THROW(read_input_file("/dev/zero"), InputError);
  write(std::string((16 << 20) + 1, ' '));
  EXPECT_THROW(read_input_file(file), InputError);
}

TEST_F(InputFile, IsAFileErrorIfItCannotBeRead)
{
  EXPECT_THROW(read_input_file("/proc/self/mem"), FileError);
  EXPECT_THROW(read_input_file(testing::TempDir()), FileError);
  EXPECT_THROW(read_input_file(file + ".absent"), FileError);
}
} // namespace
