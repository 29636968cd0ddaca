// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/base/exceptions.h"

#include <gtest/gtest.h>

namespace signorini
{
namespace
{
TEST(EditDistance, CountsChanges)
{
  EXPECT_EQ(edit_distance("", ""), 0u);
  EXPECT_EQ(edit_distance("floor", ""), 5u);
  EXPECT_EQ(edit_distance("floor", "flor"), 1u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(edit_distance("Density", "density"), 0u);
  EXPECT_EQ(edit_distance("flaot", "float"), 1u);
}

TEST(NearestName, FindsTheMostSimilar)
{
  EXPECT_EQ(nearest_name("Densty", {"Degree", "Density", "Model"}), "Density");
  EXPECT_EQ(nearest_name("botom", {"top", "bottom", "left"}), "bottom");
  EXPECT_EQ(nearest_name("Tets", {"hexahedra", "tetrahedra"}), "tetrahedra");
}

TEST(NearestName, IsEmptyWithoutASimilarOne)
{
  EXPECT_EQ(nearest_name("xyz", {"Density", "Model"}), "");
  EXPECT_EQ(nearest_name("anything", {}), "");
  EXPECT_EQ(nearest_name("te", {"hexahedra", "tetrahedra"}), "");
}

TEST(Complaint, LeavesOutEmptyParts)
{
  EXPECT_EQ(Complaint("it is wrong").at("a.prm:3").expected("> 0").text(),
            "a.prm:3: it is wrong\n  allowed: > 0");
}

TEST(ProgramError, HasAnExitCode)
{
  EXPECT_EQ(NumericalError("x").exit_code(), 1);
  EXPECT_EQ(InputError("x").exit_code(), 2);
  EXPECT_EQ(FileError("x").exit_code(), 3);
}
} // namespace
} // namespace signorini
