// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/study/study_row.h"

#include "signorini/base/version.h"
#include "signorini/parameters/print_parameters.h"

#include <fmt/format.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

namespace signorini
{
namespace study_row_test
{
using Factor = StudyParameters::Factor;

class StudyRowTest : public testing::Test
{
protected:
  void SetUp() override
  {
    std::filesystem::create_directories(directory);
    run.settings = {{Factor::degree, "2"}};
    run.parameters.output.directory = directory;
    run.text = scan_parameter_text("set Bodies = a", "a.prm");
    study.quantities = {"approach", "radius"};
  }
  void TearDown() override { std::filesystem::remove_all(directory); }

  void write(const std::string &name, const std::string &content) const
  {
    std::ofstream(directory + "/" + name) << content;
  }
  void write_summary(const std::string &status, unsigned int n_ranks = 2) const
  {
    write("summary.json", fmt::format(R"({{"version": "{}", "status": "{}", "reason": "why", "n_cells": 8,
      "n_dofs": 81, "n_steps": 1, "n_iterations": 7, "n_ranks": {},
      "run_time": {{"total": 3.0, "sections": {{"output": 1.0, "set-up": 0.5}}}}, "memory_peak_mb": 100,
      "contact": {{"alpha": 10, "effective_stiffness": 1e9}}, "estimate": {{"discretization": 0.2, "contact": null}},
      "errors": [{{"quantity": "approach", "computed": 0.95, "exact": 1, "relative_error": -0.05}},
                 {{"quantity": "radius", "computed": 2.02, "exact": 2, "relative_error": 0.01}}]}})",
                                      program_version(), status, n_ranks));
  }

  const std::string directory = testing::TempDir() + "signorini_study_row";
  StudyRun run;
  StudyParameters study;
};

TEST_F(StudyRowTest, ComesFromTheSummary)
{
  write_summary("ok");
  const StudyRow row = read_row(run, study);
  EXPECT_EQ(row.name(), "degree-2");
  EXPECT_EQ(row.n_dofs, 81u);
  EXPECT_EQ(row.run_time, 2.); // without output
  EXPECT_EQ(row.total_time, 3.);
  EXPECT_EQ(row.core_seconds(), 4.);
  EXPECT_EQ(row.alpha, 10.);
  EXPECT_EQ(row.error("approach"), 0.05);
  EXPECT_EQ(row.error("estimated discretization"), 0.2);
  EXPECT_TRUE(std::isnan(row.error("estimated contact"))); // JSON's null
  EXPECT_EQ(row.largest_error(study.quantities), 0.05);
  EXPECT_TRUE(std::isnan(row.largest_error({"approach", "estimated contact"})));
}

TEST_F(StudyRowTest, TakesOffTheModelError)
{
  write_summary("ok");
  study.model_errors = {{"approach", -0.045}};
  EXPECT_NEAR(read_row(run, study).error("approach"), 0.005, 1e-15);
  EXPECT_EQ(read_row(run, study).error("radius"), 0.01);
}

TEST_F(StudyRowTest, OfAFailedRunHasNoErrors)
{
  write_summary("failed");
  EXPECT_EQ(read_row(run, study).reason, "why");
  EXPECT_TRUE(read_row(run, study).errors.empty());
  write("summary.json", "{\"status\": \"ok\"");
  EXPECT_EQ(read_row(run, study).status, "failed");
  std::filesystem::remove(directory + "/summary.json");
  EXPECT_NE(read_row(run, study).reason.find("cannot be read"), std::string::npos);
}

TEST_F(StudyRowTest, IsOfAFinishedRunIfNothingHasChanged)
{
  EXPECT_FALSE(is_finished(run, 2));
  {
    std::ofstream file(directory + "/parameters.prm");
    write_parameters_used(run.text, file);
  }
  EXPECT_FALSE(is_finished(run, 2));
  write_summary("ok");
  EXPECT_TRUE(is_finished(run, 2));
  EXPECT_FALSE(is_finished(run, 1));
  run.text = scan_parameter_text("set Bodies = a\nset Degree = 2", "a.prm");
  EXPECT_FALSE(is_finished(run, 2));
  run.text = scan_parameter_text("set Bodies = a", "a.prm");
  write_summary("interrupted");
  EXPECT_FALSE(is_finished(run, 2));
  write("summary.json", "[1");
  EXPECT_FALSE(is_finished(run, 2));
}

StudyRow row(const std::string &value, double run_time, double error, const std::string &status = "ok")
{
  StudyRow result;
  result.settings = {{Factor::degree, value}};
  result.status = status;
  result.run_time = run_time;
  result.errors = {{"q", 0., 0., error}};
  return result;
}

TEST(MergeRepeats, KeepsTheFastestThatEndedWell)
{
  const std::vector<StudyRow> merged = merge_repeats(
      {row("1", 3., 0.1), row("1", 2., 0.1), row("1", 1., 0.1, "failed"), row("2", 1., 0.1, "failed")});
  ASSERT_EQ(merged.size(), 2u);
  EXPECT_EQ(merged[0].run_time, 2.);
  EXPECT_EQ(merged[1].status, "failed");
}

TEST(ParetoFront, HasWhatNoOtherRunBeats)
{
  const std::vector<StudyRow> rows{row("a", 4., 0.01),
                                   row("b", 1., 0.1),
                                   row("c", 2., 0.2),
                                   row("d", 2., -0.05),
                                   row("e", 2., 0.05),
                                   row("f", 5., 0.01),
                                   row("g", 3., StudyRow::none),
                                   row("h", StudyRow::none, 0.001)};
  EXPECT_EQ(find_pareto_front(rows, {"q"}), (std::vector<std::size_t>{1, 3, 0}));
  EXPECT_TRUE(find_pareto_front({}, {"q"}).empty());
}
} // namespace study_row_test
} // namespace signorini
