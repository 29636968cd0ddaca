// SPDX-License-Identifier: LGPL-2.1-or-later
// What an iteration that looks for a balance holds of friction.
#include "rubbing.h"

using namespace signorini;
using namespace signorini::contact;
using namespace signorini::test;

namespace
{
/// Boxes on a plane: what moves along it keeps its pressures.
template <int dim>
struct HeldOnPlane : PlaneDirections<dim>
{
  using PlaneDirections<dim>::normal, PlaneDirections<dim>::along;
  static constexpr double coefficient = .3;

  /// Comes from this far above where it is held.
  explicit HeldOnPlane(double height = 0.)
      : rubbing(PotentialScene<dim>({dim, 1, Target::plane, Integration::face_quadrature}), coefficient,
                SlidUnder::last_traction)
  {
    rubbing.potential.for_each_overlap_above(0., [&](const auto &near)
                                             { stiffness += near.pair.area * near.pair.stiffness; });
    if (height > 0.)
    {
      move(height * normal);
      rubbing.friction.commit();
      move(SpatialVector<dim>::Zero());
    }
  }

  void move(const SpatialVector<dim> &way) { rubbing.move_to(rubbing.scene.moved(way)); }

  Rubbing<dim> rubbing;
  double stiffness = 0.; ///< of all points that touch [N/m]
};

template <typename Dimension>
class FrictionHold : public testing::Test
{
};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(FrictionHold, Dimensions);

constexpr double far_way = .1; // far beyond what sticks

/// Of an iteration that leaps from one direction of sliding to the other.
TYPED_TEST(FrictionHold, PointsThatTurnRoundStickUntilTheNextHold)
{
  constexpr int dim = TypeParam::value;
  HeldOnPlane<dim> held;
  auto &friction = held.rubbing.friction;
  const auto expect = [&](double force)
  { EXPECT_LT((held.rubbing.resultant() - force * held.along).norm(), 1e-12 * std::abs(force)); };
  const double limit = held.coefficient * held.rubbing.total_pressure();
  held.move(far_way * held.along);
  friction.hold();
  held.move(far_way * held.along);
  expect(-limit); // it slides on
  held.move(-far_way * held.along);
  expect(limit);
  friction.hold();
  held.move(-far_way * held.along);
  expect(held.stiffness * far_way);
  friction.hold();
  held.move(-far_way * held.along);
  expect(limit);
}

TYPED_TEST(FrictionHold, EndsWithTheRelease)
{
  constexpr int dim = TypeParam::value;
  HeldOnPlane<dim> held;
  for (const double side : {1., -1.})
  {
    held.move(side * far_way * held.along);
    held.rubbing.friction.hold();
  }
  held.rubbing.friction.release();
  held.move(-far_way * held.along);
  EXPECT_NEAR(held.rubbing.resultant().norm(), held.coefficient * held.rubbing.total_pressure(),
              1e-12 * held.stiffness * far_way);
}

/// Of points that stick, that slide, that are about to, and that are made to stick; that touched before, and
/// that come, so that only a share of their way counts.
TYPED_TEST(FrictionHold, ForcesAreTheGradientOfTheEnergyAtHeldPressures)
{
  constexpr int dim = TypeParam::value;
  for (const double height : {0., .15})
    for (const double distance : {1e-3, 1.5e-2, far_way})
      for (const bool does_turn_round : {false, true})
      {
        HeldOnPlane<dim> held(height);
        auto &friction = held.rubbing.friction;
        RandomVectors<dim> random(21);
        const auto random_along = [&](double size)
        {
          auto field = random.field(held.rubbing.scene.positions.size(), size);
          for (auto &vector : field)
            vector -= held.normal.dot(vector) * held.normal;
          return field;
        };
        const auto shake = random_along(.1 * distance);
        const auto position = [&](double side)
        { return shifted<dim>(held.rubbing.scene.moved(side * distance * held.along), shake, 1.); };
        if (does_turn_round)
        {
          held.rubbing.move_to(position(-1.));
          friction.hold();
        }
        const auto x = position(1.);
        held.rubbing.move_to(x);
        friction.hold();
        held.rubbing.move_to(x);
        const auto forces = held.rubbing.forces();
        EXPECT_GT(friction.held_energy(), 0.);
        for (unsigned int trial = 0; trial < 4; ++trial)
        {
          constexpr double step = 1e-7;
          const auto direction = random_along(1.);
          const auto energy_at = [&](double t)
          {
            held.rubbing.move_to(shifted<dim>(x, direction, t));
            return friction.held_energy();
          };
          const double slope = (energy_at(step) - energy_at(-step)) / (2. * step);
          EXPECT_NEAR(slope, -dot<dim>(forces, direction), 1e-6 * norm<dim>(forces));
        }
      }
}

/// The energy has the cones of the pressures that were held, whatever these are now.
TYPED_TEST(FrictionHold, KeepsThePressures)
{
  constexpr int dim = TypeParam::value;
  HeldOnPlane<dim> held;
  held.move(far_way * held.along);
  held.rubbing.friction.hold();
  const double energy = held.rubbing.friction.held_energy(), pressure = held.rubbing.total_pressure();
  held.move(far_way * held.along - .01 * held.normal);
  EXPECT_GT(held.rubbing.total_pressure(), 1.1 * pressure);
  EXPECT_NEAR(held.rubbing.friction.held_energy(), energy, 1e-10 * energy);
}
} // namespace
