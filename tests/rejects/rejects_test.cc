// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/base/exceptions.h"
#include "signorini/simulation/command_line.h"
#include "signorini/study/run_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

// Every parameter file of this folder must be refused by --validate, with the exit code and the message that
// its first comments state. All in one process, for starting the program takes longer than all that it
// checks.
namespace signorini
{
namespace
{
/// What the comments `# exit: CODE`, `# message: FRAGMENT` and `# option: ARGUMENT` of a file say.
struct Expectation
{
  explicit Expectation(const std::filesystem::path &file)
  {
    std::ifstream lines(file);
    for (std::string line; std::getline(lines, line);)
    {
      if (!line.empty() && line.back() == '\r')
        line.pop_back();
      const auto take = [&](const std::string &head, std::vector<std::string> &values)
      {
        if (line.compare(0, head.size(), head) == 0)
          values.push_back(line.substr(head.size()));
      };
      take("# exit: ", exit_codes);
      take("# message: ", messages);
      take("# option: ", options);
    }
  }

  std::vector<std::string> exit_codes, messages, options;
};

std::vector<std::filesystem::path> find_files()
{
  std::vector<std::filesystem::path> files;
  for (const auto &entry : std::filesystem::directory_iterator(SIGNORINI_REJECTS))
    if (entry.path().extension() == ".prm")
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

void validate(const std::filesystem::path &file, const std::vector<std::string> &options)
{
  std::vector<const char *> arguments{"signorini", "--validate", "--quiet"};
  for (const std::string &option : options)
    arguments.push_back(option.c_str());
  arguments.push_back(file.c_str());
  run_file(parse_command_line(static_cast<int>(arguments.size()), arguments.data()), MPI_COMM_WORLD);
}

class Rejects : public testing::TestWithParam<std::filesystem::path>
{
};

TEST_P(Rejects, File)
{
  const Expectation expected(GetParam());
  ASSERT_FALSE(expected.messages.empty()) << "the file expects no message";
  try
  {
    validate(GetParam(), expected.options);
    FAIL() << "the file was taken";
  }
  catch (const ProgramError &error)
  {
    const std::string said = error.what();
    for (const std::string &message : expected.messages)
      EXPECT_NE(said.find(message), std::string::npos) << "it lacks '" << message << "':\n" << said;
    EXPECT_EQ(expected.exit_codes, std::vector<std::string>{std::to_string(error.exit_code())});
  }
}

INSTANTIATE_TEST_SUITE_P(All, Rejects, testing::ValuesIn(find_files()),
                         [](const auto &file) { return file.param.stem().string(); });
} // namespace
} // namespace signorini
