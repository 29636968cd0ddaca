// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/base/exceptions.h"
#include "signorini/parameters/read_parameters.h"
#include "signorini/scene/scene.h"

#include <gtest/gtest.h>

using namespace signorini;

namespace
{
const std::string scene_text = R"(
set Bodies = block
subsection Body block
  subsection Mesh
  end
  subsection Material
    set Young's modulus = 1e6
    set Poisson's ratio = 0.3
  end
  subsection Support bottom
    set x = 0
    set z = if(t > 0.4 && t < 0.6, sqrt(-1), 0)
  end
  subsection Load top
    set Traction = 0; 0; if(t > 0.4 && t < 0.6, 1/(t - 0.5), 0)
  end
end
subsection Quasi-static
end
)";

/// The message of the error that a call throws.
template <typename Call>
std::string message_of(const Call &call)
{
  try
  {
    call();
  }
  catch (const InputError &error)
  {
    return error.what();
  }
  return "";
}
} // namespace

TEST(Scene, NamesTheLineOfAFormulaThatFailsDuringTheRun)
{
  const Scene<3> scene = make_scene<3>(read_parameters(scan_parameter_text(scene_text, "scene.prm")));
  const auto &support = scene.supports.at(1);
  const std::string of_support =
      message_of([&]() { evaluate(support.displacement, support.description, dealii::Point<3>(), 0.5); });
  EXPECT_NE(of_support.find("scene.prm:12: Body block/Support bottom/z is not a number"), std::string::npos)
      << of_support;
  EXPECT_NE(of_support.find("t = 0.5"), std::string::npos) << of_support;

  const auto &load = scene.loads.at(0);
  const std::string of_load =
      message_of([&]() { evaluate(load.traction[2], load.description, dealii::Point<3>(), 0.5); });
  EXPECT_NE(of_load.find("scene.prm:15: Body block/Load top/Traction is infinite"), std::string::npos)
      << of_load;
}

TEST(Scene, TellsAJumpOfAnObstacleFromAMotion)
{
  const auto find = [](const std::string &formula, double start, double end) {
    return ObstacleMotion<2>({formula, "0"}, "place", 1.).find_jump(start, end);
  };
  for (const std::string motion : {"0", "5*t", "sqrt(t)", "if(t < 0.5, 0, 1e3*(t - 0.5))", "sin(40*t)"})
    EXPECT_FALSE(find(motion, 0.3, 0.6)) << motion;
  const auto jump = find("t + if(t < 0.47, 0, 0.1)", 0.3, 0.6);
  ASSERT_TRUE(jump);
  EXPECT_NEAR(jump->time, 0.47, 1e-6);
  EXPECT_NEAR(jump->size, 0.1, 1e-6);
  EXPECT_FALSE(find("t + if(t < 0.47, 0, 0.1)", 0.5, 0.6));
}
