// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/friction/slip_motion.h"

#include "facet_samples.h"

#include <gtest/gtest.h>

namespace signorini::contact
{
namespace
{
using testing::Dice;

template <typename Dimension>
class SlipMotionTest : public ::testing::Test
{
};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(SlipMotionTest, Dimensions);

/// A slip whose target turns, and whose normal then is another one than the turned one.
template <int dim>
struct CarriedSlip
{
  explicit CarriedSlip(Dice &dice)
  {
    motion.turn = dice.rotation<dim>();
    slip.normal = dice.rotation<dim>() * SpatialVector<dim>::Unit(0);
    slip.elastic = dice.point<dim>(-1., 1.);
    slip.elastic -= slip.normal.dot(slip.elastic) * slip.normal;
    motion.normal = (motion.turn * slip.normal + .5 * dice.point<dim>(-1., 1.)).normalized();
  }

  SlipMotion<dim> motion;
  PointSlip<dim> slip;
};

/// Coming round a curve costs nothing: the elastic energy is that of the slip's length.
TYPED_TEST(SlipMotionTest, CarriedSlipsKeepTheirLength)
{
  constexpr int dim = TypeParam::value;
  Dice dice(6);
  for (unsigned int trial = 0; trial < 50; ++trial)
  {
    const CarriedSlip<dim> carried(dice);
    const SpatialVector<dim> now = carried.motion.carry(carried.slip);
    EXPECT_NEAR(now.norm(), carried.slip.elastic.norm(), 1e-12);
    EXPECT_NEAR(now.dot(carried.motion.normal), 0., 1e-12);
  }
}

TYPED_TEST(SlipMotionTest, SlipsTurnWithTheirTarget)
{
  constexpr int dim = TypeParam::value;
  Dice dice(7);
  for (unsigned int trial = 0; trial < 50; ++trial)
  {
    CarriedSlip<dim> carried(dice);
    carried.motion.normal = carried.motion.turn * carried.slip.normal;
    EXPECT_LT((carried.motion.carry(carried.slip) - carried.motion.turn * carried.slip.elastic).norm(),
              1e-12);
    carried.slip.normal.setZero(); // it did not touch
    EXPECT_EQ(carried.motion.carry(carried.slip).norm(), 0.);
  }
}

TYPED_TEST(SlipMotionTest, IncrementIsWhatTheTargetDoesNotDo)
{
  constexpr int dim = TypeParam::value;
  Dice dice(8);
  for (unsigned int trial = 0; trial < 50; ++trial)
  {
    SlipMotion<dim> motion = CarriedSlip<dim>(dice).motion;
    motion.before = dice.point<dim>(-1., 1.);
    motion.shift = dice.point<dim>(-1., 1.);
    SpatialVector<dim> slid = dice.point<dim>(-1., 1.);
    motion.now = motion.turn * motion.before + motion.shift + slid;
    slid -= motion.normal.dot(slid) * motion.normal;
    EXPECT_LT((motion.find_increment() - slid).norm(), 1e-12);
  }
}
} // namespace
} // namespace signorini::contact
