// SPDX-License-Identifier: LGPL-2.1-or-later
// One free simplex between two fixed ones, in explicit steps: what the volume potential stores it gives back.
#include "potential_scene.h"
#include "volume_scene.h"

#include <gtest/gtest.h>

#include <memory>

using namespace signorini;
using namespace signorini::contact;
using namespace signorini::test;

namespace
{
/// The flight of the middle one of three simplices along the last axis: nodes of mass 1/2 held together by
/// springs along the edges. Face to face with the one below, it meets the corner of the one above with its
/// own.
template <int dim>
class Collision
{
public:
  static constexpr unsigned int n = dim + 1;
  static constexpr double gap = .1, mass = .5;

  Collision(double penalty_factor, double spring_stiffness) : spring(spring_stiffness)
  {
    for (unsigned int body = 0; body < 3; ++body)
    {
      Simplex<dim> simplex;
      simplex.body = body;
      simplex.youngs_modulus = 1e3;
      for (unsigned int a = 0; a <= dim; ++a)
      {
        SpatialVector<dim> x = SpatialVector<dim>::Zero();
        if (a > 0)
          x[a - 1] = 1.;
        if (body != 1)
          x[dim - 1] *= -1.;
        if (body == 1)
          x[dim - 1] += gap;
        if (body == 2)
          x += SpatialVector<dim>::Constant(.05) + (1.95 + 2. * gap) * SpatialVector<dim>::Unit(dim - 1);
        simplex.vertices[a] = volume.n_nodes();
        volume.reference_positions.push_back(x);
      }
      volume.simplices.push_back(simplex);
    }
    volume.n_bodies = 3;
    compute_heights(volume);
    VolumePotentialSettings settings;
    settings.penalty_factor = penalty_factor;
    potential = std::make_unique<VolumePotential<dim>>(volume, settings);
    positions = volume.reference_positions;
  }

  /// The largest energy of the rigid way from 0 to `end`.
  double barrier(double end)
  {
    double largest = 0.;
    for (unsigned int i = 0; i <= 2000; ++i)
    {
      auto x = volume.reference_positions;
      for (unsigned int a = n; a < 2 * n; ++a)
        x[a][dim - 1] += end * i / 2000.;
      potential->update(x);
      potential->evaluate(x);
      largest = std::max(largest, potential->energy());
    }
    return largest;
  }

  struct Flight
  {
    double energy_error = 0.;          ///< largest, over the energy
    double largest_way = 0., way = 0.; ///< of its first node [m]
  };

  /// Velocity Verlet. Without springs the simplex is rigid and does not turn.
  Flight fly(double velocity, double time_step, double duration)
  {
    positions = volume.reference_positions;
    Positions<dim> velocities(3 * n, SpatialVector<dim>::Zero());
    for (unsigned int a = n; a < 2 * n; ++a)
      velocities[a][dim - 1] = velocity;
    Flight flight;
    double energy = 0.;
    auto forces = update_forces(energy);
    const double first_energy = energy + .5 * mass * dot<dim>(velocities, velocities);
    for (double time = 0.; time < duration; time += time_step)
    {
      velocities = shifted<dim>(velocities, forces, .5 * time_step / mass);
      positions = shifted<dim>(positions, velocities, time_step);
      forces = update_forces(energy);
      velocities = shifted<dim>(velocities, forces, .5 * time_step / mass);
      const double error = energy + .5 * mass * dot<dim>(velocities, velocities) - first_energy;
      flight.energy_error = std::max(flight.energy_error, std::abs(error) / first_energy);
      flight.way = positions[n][dim - 1] - volume.reference_positions[n][dim - 1];
      flight.largest_way = std::max(flight.largest_way, std::abs(flight.way));
    }
    return flight;
  }

private:
  /// Forces on the middle one, those of the springs included.
  Positions<dim> update_forces(double &energy)
  {
    potential->update(positions);
    potential->evaluate(positions);
    energy = potential->energy();
    Positions<dim> all(3 * n, SpatialVector<dim>::Zero()), forces = all;
    potential->add_forces(all);
    SpatialVector<dim> mean = SpatialVector<dim>::Zero();
    for (unsigned int a = n; a < 2 * n; ++a)
      mean += all[a] / n;
    for (unsigned int a = n; a < 2 * n; ++a)
      forces[a] = spring > 0.
                      ? all[a]
                      : mean.dot(SpatialVector<dim>::Unit(dim - 1)) * SpatialVector<dim>::Unit(dim - 1);
    for (unsigned int a = n; a < 2 * n; ++a)
      for (unsigned int b = n; b < a; ++b)
      {
        const SpatialVector<dim> edge = positions[b] - positions[a];
        const double stretch =
            edge.norm() - (volume.reference_positions[b] - volume.reference_positions[a]).norm();
        energy += .5 * spring * stretch * stretch;
        forces[a] += spring * stretch * edge.normalized();
        forces[b] -= spring * stretch * edge.normalized();
      }
    return forces;
  }

  double spring; ///< [N/m]
  ContactVolume<dim> volume;
  std::unique_ptr<VolumePotential<dim>> potential;
  Positions<dim> positions;
};

template <typename Dimension>
class VolumeCollision : public testing::Test
{
};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(VolumeCollision, Dimensions);

/// Soft contact lets it through, stiff one throws it to and fro: the energy stays to the order of the
/// integrator.
TYPED_TEST(VolumeCollision, KeepsTheEnergyToSecondOrder)
{
  constexpr int dim = TypeParam::value;
  for (const double penalty_factor : {1e-3, 1e1, 1e4})
  {
    Collision<dim> collision(penalty_factor, 100.);
    const double time_step = .05 / std::sqrt(1e3 + 2e3 * penalty_factor);
    const auto coarse = collision.fly(-1., time_step, .6);
    const auto fine = collision.fly(-1., .25 * time_step, .6);
    EXPECT_LT(coarse.energy_error, 2e-4) << penalty_factor;
    EXPECT_LT(fine.energy_error, coarse.energy_error / 6.) << penalty_factor;
    EXPECT_EQ(fine.largest_way > .2, penalty_factor < 1.) << penalty_factor;
  }
}

/// The barrier is the largest energy on the way: just below it the body bounces, just above it passes.
TYPED_TEST(VolumeCollision, PassesOrBouncesAsTheBarrierSays)
{
  constexpr int dim = TypeParam::value;
  for (const double penalty_factor : {1e-3, 1e4})
    for (const double direction : {-1., 1.})
    {
      Collision<dim> collision(penalty_factor, 0.);
      const double barrier = collision.barrier(2.5 * direction);
      for (const double share : {.98, 1.02})
      {
        const double velocity = std::sqrt(2. * share * barrier / (collision.n * collision.mass));
        const double duration = 6. / velocity; // the way over the top is slow
        const double way = collision.fly(direction * velocity, duration / 4000., duration).way;
        EXPECT_EQ(way * direction > 2.3, share > 1.) << penalty_factor << " " << direction << " " << way;
      }
    }
}
} // namespace
