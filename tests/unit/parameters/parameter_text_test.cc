// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/parameters/parameter_text.h"

#include "signorini/base/exceptions.h"

#include <gtest/gtest.h>

namespace signorini
{
namespace
{
/// The message with which a text is refused; empty if it is accepted.
std::string fault_of(const std::string &content)
{
  try
  {
    scan_parameter_text(content, "a.prm");
  }
  catch (const InputError &error)
  {
    return error.what();
  }
  return "";
}

TEST(ParameterText, KeepsPathKeyValueAndLine)
{
  const ParameterText text = scan_parameter_text("# comment\n"
                                                 "set Bodies = ball # and more\n"
                                                 "\n"
                                                 "subsection Body ball\n"
                                                 "  subsection   Material\r\n"
                                                 "\tset Young's   modulus=1e6\n"
                                                 "  end\n"
                                                 "end\n",
                                                 "a.prm");
  ASSERT_EQ(text.entries.size(), 2u);
  EXPECT_EQ(text.value("", "Bodies"), "ball");
  const ParameterEntry *const entry = text.find("Body ball/Material", "Young's modulus");
  ASSERT_NE(entry, nullptr);
  EXPECT_EQ(entry->value, "1e6");
  EXPECT_EQ(entry->where(), "a.prm:6");
  EXPECT_EQ(text.where("Body ball/Material"), "a.prm:5");
  EXPECT_EQ(text.names_below("", "Body "), std::vector<std::string>{"Body ball"});
}

TEST(ParameterText, JoinsContinuedLines)
{
  const ParameterText text =
      scan_parameter_text("set a = 1, \\\n   2, \\ # comment\n   3\nset b = x=y\n", "a.prm");
  EXPECT_EQ(text.value("", "a"), "1, 2, 3");
  EXPECT_EQ(text.find("", "b")->line, 4);
  EXPECT_EQ(text.value("", "b"), "x=y");
}

TEST(ParameterText, IgnoresAByteOrderMark)
{
  EXPECT_EQ(fault_of("\xEF\xBB\xBFset a = 1\n"), "");
}

TEST(ParameterText, SameKeyInOtherSubsectionIsNoDuplicate)
{
  EXPECT_EQ(fault_of("set a = 1\nsubsection s\n set a = 1\nend\n"), "");
}

TEST(ParameterText, RefusesWhatItDoesNotUnderstand)
{
  EXPECT_NE(fault_of("").find("no entries"), std::string::npos);
  EXPECT_NE(fault_of("set a = 1\nset a = 2\n").find("a.prm:2: key 'a' is set twice"), std::string::npos);
  EXPECT_NE(fault_of("subsection s\nset a = 1\n").find("a.prm:1: subsection 's' is not closed"),
            std::string::npos);
  EXPECT_NE(fault_of("set a = 1\nend\n").find("a.prm:2: 'end' without"), std::string::npos);
  EXPECT_NE(fault_of("set a = 1\nhello\n").find("a.prm:2: this line"), std::string::npos);
  EXPECT_NE(fault_of("set a = 1\nend of it\n").find("a.prm:2: this line"), std::string::npos);
  EXPECT_NE(fault_of(std::string("\0\x01\x7f", 3)).find(R"('?)"), std::string::npos);
}

TEST(ParameterText, OverridesReplaceAndAdd)
{
  ParameterText text = scan_parameter_text("set a = 1\n", "a.prm");
  apply_override(text, "a=2");
  apply_override(text, "Body ball/Material/Young's modulus = 3");
  EXPECT_EQ(text.entries.size(), 2u);
  EXPECT_EQ(text.value("", "a"), "2");
  EXPECT_EQ(text.value("Body ball/Material", "Young's modulus"), "3");
  EXPECT_NE(text.find_subsection("Body ball"), nullptr);
  EXPECT_EQ(text.find("", "a")->where(), "--set 'a=2'");
  EXPECT_THROW(apply_override(text, "a"), InputError);
  EXPECT_THROW(apply_override(text, "a/=1"), InputError);
}

TEST(ParameterText, MissingFileIsAFileError)
{
  EXPECT_THROW(read_parameter_text("no/such/file.prm"), FileError);
  EXPECT_THROW(read_parameter_text("/"), FileError);
}
} // namespace
} // namespace signorini
