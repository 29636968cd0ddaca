// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/simulation/command_line.h"

#include "signorini/base/exceptions.h"

#include <gtest/gtest.h>

namespace signorini
{
namespace
{
CommandLine parse(std::vector<const char *> arguments)
{
  arguments.insert(arguments.begin(), "signorini");
  return parse_command_line(static_cast<int>(arguments.size()), arguments.data());
}

TEST(CommandLine, TakesOptionsInAnyOrder)
{
  const CommandLine line = parse(
      {"--set", "Body ball/Material/Density=1", "--validate", "a.prm", "--set=b=2", "--output", "there"});
  EXPECT_EQ(line.file, "a.prm");
  EXPECT_TRUE(line.validate);
  EXPECT_EQ(line.overrides, (std::vector<std::string>{"Body ball/Material/Density=1", "b=2"}));
  EXPECT_EQ(line.output.value(), "there");
  EXPECT_FALSE(line.quiet);
}

TEST(CommandLine, StandardInput)
{
  EXPECT_EQ(parse({"--quiet", "-"}).file, "-");
}

TEST(CommandLine, Resume)
{
  EXPECT_TRUE(parse({"a.prm", "--resume"}).resume);
  EXPECT_FALSE(parse({"a.prm"}).resume);
}

TEST(CommandLine, FormatIsOptional)
{
  EXPECT_EQ(parse({"--parameters"}).parameters_format.value(), "prm");
  EXPECT_EQ(parse({"--parameters=md"}).parameters_format.value(), "md");
  EXPECT_EQ(parse({"--parameters", "a.prm"}).file, "a.prm");
}

TEST(CommandLine, AnswersHelpAndVersion)
{
  EXPECT_NE(parse({"--help"}).answer.find("--validate"), std::string::npos);
  EXPECT_EQ(parse({"--version"}).answer.compare(0, 9, "signorini"), 0);
}

TEST(CommandLine, RefusesWhatItDoesNotKnow)
{
  EXPECT_THROW(parse({}), InputError);
  EXPECT_THROW(parse({"a.prm", "b.prm"}), InputError);
  EXPECT_THROW(parse({"a.prm", "--set"}), InputError);
  EXPECT_THROW(parse({"--parameters=xml"}), InputError);
  try
  {
    parse({"a.prm", "--qiet"});
    FAIL();
  }
  catch (const InputError &error)
  {
    EXPECT_EQ(error.complaint().nearest, "--quiet");
  }
}
} // namespace
} // namespace signorini
