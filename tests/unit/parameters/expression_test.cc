// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/parameters/expression.h"

#include "signorini/base/exceptions.h"
#include "signorini/parameters/body_expressions.h"
#include "signorini/parameters/mesh_parameters.h"
#include "signorini/parameters/strings.h"

#include <gtest/gtest.h>

namespace signorini
{
namespace
{
TEST(Expression, HasSpaceTimeAndPi)
{
  EXPECT_DOUBLE_EQ(Expression("x + 10*y + 100*z + 1000*t").value({1., 2., 3.}, 4.), 4321.);
  EXPECT_NEAR(Expression("sin(pi*t)").value({}, 0.5), 1., 1e-14);
  EXPECT_DOUBLE_EQ(Expression("if(t >= 1, max(x, 2), -1)").value({}, 1.), 2.);
}

TEST(Expression, KnowsTheFunctionsOfTheManual)
{
  for (const std::string &call : Expression::functions())
    EXPECT_TRUE(std::isfinite(Expression(call).value({.5, .5, 0.}, 0.)) ||
                std::isfinite(Expression(call).value({2., .5, 0.}, 0.)))
        << call;
  EXPECT_DOUBLE_EQ(Expression("log(exp(2))").value({}, 0.), 2.);
  EXPECT_DOUBLE_EQ(Expression("t > 1 && x <= 0 || y != 0 ? 2^3 : -1").value({0., 0., 0.}, 2.), 8.);
  for (const std::string formula : {"PI", "1,5", "unknown(x)"})
    EXPECT_THROW(Expression{formula}, InputError) << formula;
}

TEST(Expression, RefusesWhatWouldBeMisread)
{
  for (const std::string formula :
       {"1,000", "2*(1,000)", "", "sin(", "u", "x = 1", "1; 2", "rand()", "sin(1, 2)"})
    EXPECT_THROW(Expression{formula}, InputError) << formula;
}

TEST(Expression, KnowsItsVariables)
{
  EXPECT_TRUE(Expression("max(0, z)").uses("z"));
  EXPECT_TRUE(Expression("2*z^2").uses("z"));
  EXPECT_FALSE(Expression("x + y + t").uses("z"));
  EXPECT_FALSE(Expression("exp(x)").uses("t"));
}

TEST(Strings, NumbersAreWholeAndFinite)
{
  EXPECT_EQ(parse_number("+1.5e3").value(), 1500.);
  for (const std::string text : {"", "nan", "inf", "-inf", "1,5", "1 m", "1e999", "0x10", "--1", "+-1"})
    EXPECT_FALSE(parse_number(text)) << text;
  EXPECT_FALSE(parse_integer("2.0"));
}

TEST(BoundaryPoints, LieOnTheBoundary)
{
  MeshParameters box;
  const std::vector<Triple> top = boundary_points(box, 3, "top");
  EXPECT_EQ(top.size(), 4u);
  for (const Triple &point : top)
    EXPECT_EQ(point[2], 1.);
  EXPECT_EQ(boundary_points(box, 2, "left").size(), 2u);
  MeshParameters ball;
  ball.shape = MeshParameters::Shape::ball;
  ball.part = MeshParameters::Part::orthant;
  EXPECT_EQ(boundary_points(ball, 3, "surface").size(), 3u);
  EXPECT_EQ(boundary_points(ball, 3, "x").size(), 2u);
}

TEST(Placement, ScalesRotatesAndShifts)
{
  PlacementParameters placement;
  placement.shift = {1., 0., 0.};
  placement.rotation_angle = 90.;
  placement.scale = 2.;
  const Triple placed = place(placement, {1., 0., 5.});
  EXPECT_NEAR(placed[0], 1., 1e-14);
  EXPECT_NEAR(placed[1], 2., 1e-14);
  EXPECT_NEAR(placed[2], 10., 1e-14);
}
} // namespace
} // namespace signorini
