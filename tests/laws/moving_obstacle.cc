// SPDX-License-Identifier: LGPL-2.1-or-later
// A contact potential whose obstacle moves.
#include "potential_scene.h"

#include <gtest/gtest.h>

using namespace signorini;
using namespace signorini::contact;
using namespace signorini::test;

namespace
{
template <int dim>
ObstaclePlaces<dim> place_at(double time, const SpatialVector<dim> &shift,
                             const SpatialVector<dim> &velocity = SpatialVector<dim>::Zero())
{
  return {time, {shift}, {velocity}};
}

template <int dim>
PotentialScene<dim> make_scene_with_sphere()
{
  return PotentialScene<dim>(Case{dim, 1, Target::sphere, Integration::face_quadrature});
}

template <typename Dimension>
class MovingObstacle : public testing::Test
{
};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(MovingObstacle, Dimensions);

TYPED_TEST(MovingObstacle, ActsLikeBodiesThatMoveTheOtherWay)
{
  constexpr int dim = TypeParam::value;
  const PotentialScene<dim> scene = make_scene_with_sphere<dim>();
  const SpatialVector<dim> shift = .02 * SpatialVector<dim>::Ones();
  ContactPotential<dim> moving = scene.make_potential(), fixed = scene.make_potential();
  moving.update(scene.positions);
  moving.move_obstacles(place_at<dim>(1., shift));
  moving.update(scene.positions);
  moving.evaluate(scene.positions);
  const Positions<dim> moved_back = scene.moved(-shift);
  fixed.update(moved_back);
  fixed.evaluate(moved_back);
  ASSERT_GT(fixed.energy(), 0.);
  EXPECT_NEAR(moving.energy(), fixed.energy(), 1e-12 * fixed.energy());
  EXPECT_LT(norm(shifted<dim>(compute_forces<dim>(moving, moved_back.size()),
                              compute_forces<dim>(fixed, moved_back.size()), -1.)),
            1e-11 * norm<dim>(compute_forces<dim>(fixed, moved_back.size())));
}

TYPED_TEST(MovingObstacle, ForceOnBodiesIsTheSlopeOfTheEnergyInItsShift)
{
  constexpr int dim = TypeParam::value;
  constexpr double step = 1e-6;
  const PotentialScene<dim> scene = make_scene_with_sphere<dim>();
  ContactPotential<dim> potential = scene.make_potential();
  potential.update(scene.positions);
  const SpatialVector<dim> force = potential.obstacle_forces(scene.zeros()).conservative[0];
  SpatialVector<dim> sum = SpatialVector<dim>::Zero();
  for (const auto &of_node : compute_forces<dim>(potential, scene.positions.size()))
    sum += of_node;
  EXPECT_LT((force - sum).norm(), 1e-12 * sum.norm());
  double time = 0.;
  const auto energy_at = [&](const SpatialVector<dim> &shift)
  {
    potential.move_obstacles(place_at<dim>(time += 1., shift));
    potential.evaluate(scene.positions);
    return potential.energy();
  };
  for (unsigned int d = 0; d < dim; ++d)
  {
    const SpatialVector<dim> shift = step * SpatialVector<dim>::Unit(d);
    EXPECT_NEAR((energy_at(shift) - energy_at(-shift)) / (2. * step), force[d], 1e-5 * force.norm());
  }
}

TYPED_TEST(MovingObstacle, PairsStayCompleteOnALongWay)
{
  constexpr int dim = TypeParam::value;
  const PotentialScene<dim> scene = make_scene_with_sphere<dim>();
  const SpatialVector<dim> start = 3. * SpatialVector<dim>::Unit(0);
  ContactPotential<dim> potential = scene.make_potential();
  double largest = 0.;
  unsigned int n_stale = 0;
  for (unsigned int i = 0; i <= 100; ++i)
  {
    const ObstaclePlaces<dim> places = place_at<dim>(i, (1. - .01 * i) * start);
    potential.move_obstacles(places);
    n_stale += potential.is_stale(scene.positions) ? 1 : 0;
    potential.update(scene.positions);
    potential.evaluate(scene.positions);
    ContactPotential<dim> fresh = scene.make_potential();
    fresh.move_obstacles(places);
    fresh.update(scene.positions);
    EXPECT_NEAR(potential.energy(), fresh.energy(), 1e-12 * fresh.energy());
    const auto bound = bound_stiffness(potential, scene.positions.size()),
               fresh_bound = bound_stiffness(fresh, scene.positions.size());
    for (std::size_t node = 0; node < bound.size(); ++node)
      EXPECT_NEAR(bound[node], fresh_bound[node], 1e-10 * fresh_bound[node]);
    largest = std::max(largest, fresh.energy());
  }
  EXPECT_GT(largest, 0.);
  EXPECT_EQ(potential.n_searches(), n_stale);
  EXPECT_GT(n_stale, 3u);
  EXPECT_LT(n_stale, 60u);
}

TYPED_TEST(MovingObstacle, DampsTheMotionSeenFromIt)
{
  constexpr int dim = TypeParam::value;
  const PotentialScene<dim> scene = make_scene_with_sphere<dim>();
  const SpatialVector<dim> velocity = SpatialVector<dim>::Constant(.3);
  const Positions<dim> of_nodes(scene.positions.size(), velocity);
  Positions<dim> forces = scene.zeros(), seen_forces = scene.zeros();
  ContactPotential<dim> potential = scene.make_potential();
  potential.update(scene.positions);
  const double power = potential.add_damping_forces(of_nodes, forces);
  ASSERT_GT(power, 0.);
  potential.move_obstacles(place_at<dim>(1., SpatialVector<dim>::Zero(), velocity));
  potential.evaluate(scene.positions);
  EXPECT_LT(potential.add_damping_forces(of_nodes, seen_forces), 1e-20 * power);
  EXPECT_LT(norm<dim>(seen_forces), 1e-14 * norm<dim>(forces));
  potential.move_obstacles(place_at<dim>(2., SpatialVector<dim>::Zero(), -velocity));
  potential.evaluate(scene.positions);
  seen_forces = scene.zeros();
  EXPECT_NEAR(potential.add_damping_forces(scene.zeros(), seen_forces), power, 1e-12 * power);
  SpatialVector<dim> sum = SpatialVector<dim>::Zero();
  for (const auto &force : seen_forces)
    sum += force;
  EXPECT_LT((potential.obstacle_forces(scene.zeros()).damping[0] - sum).norm(), 1e-12 * sum.norm());
}

TYPED_TEST(MovingObstacle, RemembersThePlaceBefore)
{
  constexpr int dim = TypeParam::value;
  const PotentialScene<dim> scene = make_scene_with_sphere<dim>();
  const SpatialVector<dim> step = .01 * SpatialVector<dim>::Ones();
  ContactPotential<dim> potential = scene.make_potential();
  potential.move_obstacles(place_at<dim>(5., step));
  potential.update(scene.positions);
  EXPECT_EQ(potential.obstacle_places().shifts[0], step);
  EXPECT_EQ(potential.obstacle_places_before().shifts[0], step);
  for (unsigned int call = 0; call < 2; ++call) // a second one at the same time changes nothing
  {
    potential.move_obstacles(place_at<dim>(6., 3. * step));
    EXPECT_EQ(potential.obstacle_places().shifts[0], SpatialVector<dim>(3. * step));
    EXPECT_EQ(potential.obstacle_places_before().shifts[0], step);
  }
}
} // namespace
