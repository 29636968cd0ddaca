// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/scene/obstacle.h"

#include "box_surface.h"

#include <Eigen/Eigenvalues>

#include <gtest/gtest.h>

#include <limits>
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
  obstacles.push_back(std::make_unique<RigidCylinder<dim>>("cylinder", point, normal, .7));
  SpatialVector<dim> upper = SpatialVector<dim>::Constant(.5);
  upper[0] = .3;
  obstacles.push_back(std::make_unique<RigidBox<dim>>("box", -.4 * upper, upper));
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

TYPED_TEST(ObstacleTest, HessianHasNoPositiveEigenvalue)
{
  constexpr int dim = TypeParam::value;
  RandomVectors<dim> random(3);
  for (const auto &obstacle : make_obstacles<dim>())
    for (unsigned int trial = 0; trial < 40; ++trial)
    {
      const auto foot = obstacle->find_foot(random.vector(1.));
      const Eigen::SelfAdjointEigenSolver<SpatialTensor<dim>> solver(foot.depth_hessian);
      EXPECT_LT(solver.eigenvalues().maxCoeff(), 1e-12) << obstacle->name();
      EXPECT_LT((foot.depth_hessian - foot.depth_hessian.transpose()).norm(), 1e-12);
    }
}

TYPED_TEST(ObstacleTest, ReachesAsFarAsItsPointsAndIsAsDeepAsItsRoom)
{
  constexpr int dim = TypeParam::value;
  RandomVectors<dim> random(4);
  for (const auto &obstacle : make_obstacles<dim>())
  {
    const SpatialVector<dim> direction = random.vector(1.).normalized();
    double reach = -10., deepest = -10.;
    for (unsigned int trial = 0; trial < 20000; ++trial)
    {
      const SpatialVector<dim> x = random.vector(1.);
      const double depth = obstacle->find_foot(x).depth;
      deepest = std::max(deepest, depth);
      if (depth >= 0.)
        reach = std::max(reach, x.dot(direction));
    }
    EXPECT_GE(obstacle->reach(direction), reach) << obstacle->name();
    EXPECT_GE(obstacle->room(), deepest) << obstacle->name();
    const bool is_bounded = std::isfinite(obstacle->reach(direction));
    EXPECT_TRUE(!is_bounded || obstacle->room() < deepest + .1) << obstacle->name();
    EXPECT_TRUE(!is_bounded || obstacle->reach(direction) < reach + .2) << obstacle->name();
  }
}

TYPED_TEST(ObstacleTest, ReachesToInfinityOnlyWhereItHasNoEnd)
{
  constexpr int dim = TypeParam::value;
  const SpatialVector<dim> up = SpatialVector<dim>::Unit(dim - 1), across = SpatialVector<dim>::Unit(0);
  const RigidPlane<dim> plane("floor", 2. * up, 5. * up);
  EXPECT_DOUBLE_EQ(plane.reach(up), 2.);
  EXPECT_TRUE(std::isinf(plane.reach(-up)) && std::isinf(plane.reach(across)) && std::isinf(plane.room()));
  const RigidCylinder<dim> cylinder("roll", 3. * across, 2. * up, .5);
  EXPECT_DOUBLE_EQ(cylinder.reach(across), 3.5);
  EXPECT_DOUBLE_EQ(cylinder.reach(-across), -2.5);
  EXPECT_TRUE(std::isinf(cylinder.reach(up)) && std::isinf(cylinder.reach(-up)));
  EXPECT_DOUBLE_EQ(
      RigidBox<dim>("box", -up - across.cwiseAbs() - SpatialVector<dim>::Ones(), across + up).reach(across),
      1.);
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
  const SpatialVector<dim> across = SpatialVector<dim>::Unit(0);
  const RigidCylinder<dim> cylinder("roll", across, 3. * up, 2.);
  EXPECT_DOUBLE_EQ(cylinder.find_foot(1.5 * across + 7. * up).depth, 1.5);
  const auto on_axis = cylinder.find_foot(across + 7. * up);
  EXPECT_DOUBLE_EQ(on_axis.depth, 2.);
  EXPECT_NEAR(on_axis.normal.dot(up), 0., 1e-15);
  EXPECT_DOUBLE_EQ(on_axis.normal.norm(), 1.);
  EXPECT_TRUE(on_axis.depth_hessian.isZero());
}

TYPED_TEST(ObstacleTest, DepthsInAndAroundABox)
{
  constexpr int dim = TypeParam::value;
  const SpatialVector<dim> ones = SpatialVector<dim>::Ones(), across = SpatialVector<dim>::Unit(0),
                           up = SpatialVector<dim>::Unit(dim - 1);
  const RigidBox<dim> box("box", -ones, 2. * ones);
  EXPECT_DOUBLE_EQ(box.find_foot(.5 * ones + 1.25 * up).depth, .25);
  EXPECT_EQ(box.find_foot(.5 * ones + 1.25 * up).normal, up);
  EXPECT_DOUBLE_EQ(box.find_foot(-1.5 * up).depth, -.5);
  EXPECT_EQ(box.find_foot(-1.5 * up).normal, SpatialVector<dim>(-up));
  EXPECT_TRUE(box.find_foot(-1.5 * up).depth_hessian.isZero());
  const auto beside_edge = box.find_foot(2. * ones + 3. * across + 4. * up);
  EXPECT_DOUBLE_EQ(beside_edge.depth, -5.);
  EXPECT_LT((beside_edge.normal - .6 * across - .8 * up).norm(), 1e-15);
  EXPECT_DOUBLE_EQ(beside_edge.depth_hessian.trace(), -.2);
  // On the corner and on the diagonal inside, the first axis, its lower face first.
  EXPECT_DOUBLE_EQ(box.find_foot(-ones).depth, 0.);
  EXPECT_EQ(box.find_foot(-ones).normal, SpatialVector<dim>(-across));
  EXPECT_EQ(box.find_foot(1.5 * ones).normal, across);
  EXPECT_EQ(box.find_foot(.5 * ones).normal, SpatialVector<dim>(-across));
}

TYPED_TEST(ObstacleTest, RejectsWhatIsNoObstacle)
{
  constexpr int dim = TypeParam::value;
  const SpatialVector<dim> zero = SpatialVector<dim>::Zero();
  EXPECT_THROW(RigidPlane<dim>("plane", zero, zero), std::invalid_argument);
  EXPECT_THROW(RigidSphere<dim>("sphere", zero, 0.), std::invalid_argument);
  EXPECT_THROW(RigidSphere<dim>("sphere", zero, -1.), std::invalid_argument);
  const SpatialVector<dim> ones = SpatialVector<dim>::Ones(), across = SpatialVector<dim>::Unit(0);
  EXPECT_THROW(RigidCylinder<dim>("cylinder", zero, zero, 1.), std::invalid_argument);
  EXPECT_THROW(RigidCylinder<dim>("cylinder", zero, ones, 0.), std::invalid_argument);
  EXPECT_THROW(RigidBox<dim>("box", ones, zero), std::invalid_argument);
  EXPECT_THROW(RigidBox<dim>("box", zero, across), std::invalid_argument);
  EXPECT_THROW(RigidBox<dim>("box", zero, std::numeric_limits<double>::infinity() * ones),
               std::invalid_argument);
}
} // namespace
