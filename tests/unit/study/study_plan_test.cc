// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/study/study_plan.h"

#include "signorini/base/exceptions.h"
#include "signorini/parameters/read_parameters.h"

#include <gtest/gtest.h>

#include <set>

namespace signorini
{
namespace
{
const std::string block = R"(
set Bodies = block
set Obstacles = floor
subsection Body block
  subsection Mesh
    set Refinements = 1
  end
  subsection Material
    set Young's modulus = 1e6
    set Poisson's ratio = 0.3
    set Density = 1
  end
  subsection Support top
    set x = 0
    set y = 0
    set z = 0
  end
end
subsection Obstacle floor
end
subsection Contact
end
)";

std::vector<StudyRun> plan(const std::string &rest)
{
  const ParameterText text = scan_parameter_text(block + rest, "block.prm");
  return plan_study(text, read_parameters(text), 1);
}

const StudyRun &named(const std::vector<StudyRun> &runs, const char *name)
{
  for (const StudyRun &run : runs)
    if (run.name() == name)
      return run;
  throw std::out_of_range(name);
}

TEST(StudyPlan, IsTheProductOfTheLists)
{
  const std::vector<StudyRun> runs =
      plan("subsection Quasi-static\nend\nsubsection Adaptivity\nset Refine share = 0.4\nend\n"
           "subsection Study\nset Uniform refinements = 1, 0\nset Adaptive cycles = 3\n"
           "set Degrees = 1, 2\nset Penalty factors = 10, 1e3\n"
           "set Linear solvers = direct, cg amg\nset Repeats = 2\nend\n");
  EXPECT_EQ(runs.size(), 3u * 2 * 2 * 2 * 2);
  std::set<std::string> names;
  for (const StudyRun &run : runs)
    names.insert(run.name());
  EXPECT_EQ(names.size(), runs.size());
  EXPECT_EQ(runs.front().name(), "uniform-0_degree-1_alpha-10_solver-direct_repeat-1");
  EXPECT_EQ(runs[1].name(), "uniform-0_degree-1_alpha-10_solver-direct_repeat-2");
  for (std::size_t i = 1; i < runs.size(); ++i)
    EXPECT_GE(runs[i].cost, runs[i - 1].cost);

  const StudyRun &uniform = named(runs, "uniform-1_degree-2_alpha-1e3_solver-cg-amg_repeat-2");
  EXPECT_EQ(uniform.parameters.bodies.at(0).mesh.refinements, 2u);
  EXPECT_FALSE(uniform.parameters.adaptivity);
  EXPECT_EQ(uniform.parameters.degree, 2u);
  EXPECT_EQ(uniform.parameters.contact->penalty_factor, 1000.);
  EXPECT_EQ(std::get<QuasiStaticParameters>(uniform.parameters.solver).linear_solver,
            QuasiStaticParameters::LinearSolver::cg_amg);
  EXPECT_FALSE(uniform.parameters.study);
  EXPECT_EQ(uniform.parameters.output.directory, "output/block/runs/" + uniform.name());
  EXPECT_EQ(uniform.parameters.output.n_fields, 0u);

  const StudyRun &adaptive = named(runs, "adaptive-3_degree-1_alpha-10_solver-direct_repeat-1");
  EXPECT_EQ(adaptive.parameters.bodies.at(0).mesh.refinements, 1u);
  EXPECT_EQ(adaptive.parameters.adaptivity->max_cycles, 3u);
  EXPECT_EQ(adaptive.parameters.adaptivity->refine_share, 0.4);
  EXPECT_EQ(adaptive.parameters.adaptivity->max_n_dofs, 1000000u);
}

TEST(StudyPlan, ScalesBothStepFactorsAndKeepsTheMeshOfTheFile)
{
  const std::vector<StudyRun> runs =
      plan("subsection Explicit\nset Bulk step factor = 0.8\nend\nsubsection Output\n"
           "set Number of fields = 3\nend\nsubsection Study\nset Step factors = 1, 0.5\nend\n");
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_EQ(runs[0].name(), "step-1_repeat-1");
  const auto &run = std::get<ExplicitParameters>(runs[1].parameters.solver);
  EXPECT_EQ(run.bulk_step_factor, 0.4);
  EXPECT_EQ(run.contact_step_factor, 0.25);
  EXPECT_EQ(runs[1].parameters.bodies.at(0).mesh.refinements, 1u);
  EXPECT_EQ(runs[1].parameters.output.n_fields, 3u);
}

TEST(StudyPlan, LeavesOutWhatIsTooLarge)
{
  const std::vector<StudyRun> runs = plan("subsection Quasi-static\nend\nsubsection Study\n"
                                          "set Uniform refinements = 0, 3\nset Maximum dofs = 1000\nend\n");
  EXPECT_TRUE(runs[0].left_out.empty());
  EXPECT_NE(runs[1].left_out.find("more than Study/Maximum dofs = 1000"), std::string::npos);
}

TEST(StudyPlan, SaysWhichListIsWrong)
{
  try
  {
    plan("subsection Quasi-static\nend\nsubsection Study\nset Linear solvers = direct, cgamg\nend\n");
    FAIL();
  }
  catch (const InputError &error)
  {
    EXPECT_EQ(error.complaint().where, "block.prm:26");
    EXPECT_EQ(error.complaint().value, "'cgamg'");
    EXPECT_EQ(error.complaint().nearest, "cg amg");
  }
}
} // namespace
} // namespace signorini
