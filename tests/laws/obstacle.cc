// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/scene/obstacle.h"

#include "box_surface.h"

#include <gtest/gtest.h>

#include <memory>

using namespace signorini;
using namespace signorini::test;

namespace
{
template <int dim>
std::vector<std::unique_ptr<Obstacle<dim>>> make_obstacles()
{
  std::vector<std::unique_ptr<Obstacle<dim>>> obstacles;
  SpatialVector<dim> point = SpatialVector<dim>::Constant(.1);
  SpatialVector<dim> normal = SpatialVector<dim>::Constant(.4);
  normal[0] = -3.;
  obstacles.push_back(std::make_unique<RigidPlane<dim>>("plane", point, normal));
  obstacles.push_back(std::make_unique<RigidSphere<dim>>("sphere", point, .7));
  return obstacles;
}

template <typename Dimension>
class ObstacleTest : public testing::Test
{
};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(ObstacleTest, Dimensions);

TYPED_TEST(ObstacleTest, NormalAndHessianAreTheDerivativesOfDepth)
{
  constexpr int dim = TypeParam::value;
  constexpr double step = 1e-5;
  RandomVectors<dim> random(1);
  for (const auto &obstacle : make_obstacles<dim>())
    for (unsigned int trial = 0; trial < 20; ++trial)
    {
      const SpatialVector<dim> x = random.vector(1.);
      const auto foot = obstacle->find_foot(x);
      EXPECT_NEAR(foot.normal.norm(), 1., 1e-14);
      for (unsigned int i = 0; i < dim; ++i)
      {
        const auto ahead = obstacle->find_foot(x + step * SpatialVector<dim>::Unit(i));
        const auto behind = obstacle->find_foot(x - step * SpatialVector<dim>::Unit(i));
        EXPECT_NEAR((ahead.depth - behind.depth) / (2. * step), -foot.normal[i], 1e-8);
        const SpatialVector<dim> difference = -(ahead.normal - behind.normal) / (2. * step);
        EXPECT_LT((difference - foot.depth_hessian.col(i)).norm(), 1e-7);
      }
    }
}

TYPED_TEST(ObstacleTest, MovesAsAWhole)
{
  constexpr int dim = TypeParam::value;
  RandomVectors<dim> random(5);
  const SpatialVector<dim> shift = random.vector(3.);
  for (const auto &obstacle : make_obstacles<dim>())
  {
    const auto moved = obstacle->moved(shift);
    EXPECT_EQ(moved->name(), obstacle->name());
    for (unsigned int trial = 0; trial < 5; ++trial)
    {
      const SpatialVector<dim> x = random.vector(1.);
      EXPECT_NEAR(moved->find_foot(x + shift).depth, obstacle->find_foot(x).depth, 1e-14);
      EXPECT_LT((moved->find_foot(x + shift).normal - obstacle->find_foot(x).normal).norm(), 1e-13);
    }
  }
}

TYPED_TEST(ObstacleTest, BatchAgreesWithSinglePoints)
{
  constexpr int dim = TypeParam::value;
  RandomVectors<dim> random(2);
  const auto points = random.field(9, 1.);
  for (const auto &obstacle : make_obstacles<dim>())
  {
    std::vector<typename Obstacle<dim>::Foot> feet(1);
    obstacle->find_feet(points, feet);
    ASSERT_EQ(feet.size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      EXPECT_EQ(feet[i].depth, obstacle->find_foot(points[i]).depth);
      EXPECT_EQ(feet[i].normal, obstacle->find_foot(points[i]).normal);
    }
  }
}

TYPED_TEST(ObstacleTest, DepthsOfKnownPoints)
{
  constexpr int dim = TypeParam::value;
  const SpatialVector<dim> up = SpatialVector<dim>::Unit(dim - 1);
  const RigidPlane<dim> plane("floor", 2. * up, 5. * up);
  EXPECT_DOUBLE_EQ(plane.find_foot(1.75 * up).depth, .25);
  EXPECT_DOUBLE_EQ(plane.find_foot(3. * up).depth, -1.);
  const RigidSphere<dim> sphere("ball", up, 2.);
  EXPECT_DOUBLE_EQ(sphere.find_foot(2.5 * up).depth, .5);
  const auto centre = sphere.find_foot(up);
  EXPECT_DOUBLE_EQ(centre.depth, 2.);
  EXPECT_TRUE(centre.normal.allFinite() && centre.depth_hessian.allFinite());
  EXPECT_DOUBLE_EQ(centre.normal.norm(), 1.);
}

TYPED_TEST(ObstacleTest, RejectsWhatIsNoObstacle)
{
  constexpr int dim = TypeParam::value;
  const SpatialVector<dim> zero = SpatialVector<dim>::Zero();
  EXPECT_THROW(RigidPlane<dim>("plane", zero, zero), std::invalid_argument);
  EXPECT_THROW(RigidSphere<dim>("sphere", zero, 0.), std::invalid_argument);
  EXPECT_THROW(RigidSphere<dim>("sphere", zero, -1.), std::invalid_argument);
}
} // namespace
