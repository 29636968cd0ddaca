// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/output/earlier_output.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

using namespace signorini;

namespace
{
namespace files = std::filesystem;

class EarlierOutput : public testing::Test
{
protected:
  void SetUp() override
  {
    files::remove_all(folder);
    files::create_directories(folder / "solution_0001.vtu.d");
    for (const char *slot : {"0", "1"})
      files::create_directories(folder / "checkpoint" / slot);
    for (const std::string &name : own)
      std::ofstream(folder / name) << "of the program";
    for (const std::string &name : others)
      std::ofstream(folder / name) << "of the user";
  }
  void TearDown() override { files::remove_all(folder); }

  bool exists(const std::string &name) const { return files::exists(folder / name); }

  const files::path folder = files::path(testing::TempDir()) / "signorini_earlier_output";
  const std::vector<std::string> own{"summary.json",          "profile.csv",        "report.html",
                                     "report_energy.png",     "study.csv",          "report_error_time.png",
                                     "solution.pvd",          "solution_0012.pvtu", "solution_0012.0.vtu",
                                     "solution_12345.13.vtu", "checkpoint/last",    "checkpoint/0/rank_0",
                                     "checkpoint/1/rank_12"};
  const std::vector<std::string> others{
      "energy.png", "report.html~",  "my_solution_0001.0.vtu", "solution.vtu",
      "notes.txt",  "report_2.html", "report_mine.png",        "checkpoint/1/notes.txt"};
};

TEST_F(EarlierOutput, GoesAndNothingElse)
{
  std::ofstream(folder / "log.txt") << "a run";
  std::ofstream(folder / "parameters.prm") << "a run";
  remove_earlier_output(folder.string());
  for (const std::string &name : own)
    EXPECT_FALSE(exists(name)) << name;
  for (const std::string &name : others)
    EXPECT_TRUE(exists(name)) << name;
  EXPECT_TRUE(exists("log.txt"));
  EXPECT_TRUE(exists("solution_0001.vtu.d"));
  EXPECT_FALSE(exists("checkpoint/0"));
}

TEST_F(EarlierOutput, StaysWhereNoRunWas)
{
  remove_earlier_output(folder.string());
  for (const std::string &name : own)
    EXPECT_TRUE(exists(name)) << name;
  remove_earlier_output((folder / "absent").string());
}
} // namespace
