// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/friction/friction.h"

#include "law_suites.h"

namespace signorini::test
{
inline constexpr double never_slides = 1e6; // coefficient of friction

/// How the obstacle of Target::plane lies, and a way along it.
template <int dim>
struct PlaneDirections
{
  PlaneDirections()
  {
    normal[0] = .1;
    normal.normalize();
    along = RandomVectors<dim>(7).vector(1.);
    along = (along - normal.dot(along) * normal).normalized();
  }

  SpatialVector<dim> normal = SpatialVector<dim>::Unit(dim - 1), along; ///< unit vectors
};

/// A scene in contact with its friction, at rest.
template <int dim>
struct Rubbing
{
  Rubbing(const PotentialScene<dim> &the_scene, double coefficient,
          contact::SlidUnder slid_under = contact::SlidUnder::mean_traction)
      : scene(the_scene), potential(scene.make_potential()), friction(potential, coefficient, slid_under)
  {
    move_to(scene.positions);
    friction.commit();
  }

  /// Tries a step to these positions.
  void move_to(const Positions<dim> &x)
  {
    potential.update(x);
    potential.evaluate(x);
    friction.evaluate(scene.zeros());
  }

  Positions<dim> forces() const { return compute_forces(friction, scene.positions.size()); }

  /// What a body does to itself cancels, and is not among the pairs.
  SpatialVector<dim> resultant() const
  {
    const contact::PairForces<dim> pairs = friction.pair_forces();
    if (scene.target == Target::itself)
    {
      EXPECT_TRUE(pairs.bodies.empty());
      return SpatialVector<dim>::Zero();
    }
    return pairs.bodies.empty() ? pairs.obstacles.begin()->second : pairs.bodies.begin()->second;
  }

  /// Σ A p over all points.
  double total_pressure() const
  {
    double sum = 0.;
    potential.for_each_overlap_above(
        0., [&](const auto &near) { sum += near.pair.area * potential.total_pressure(near, scene.zeros()); });
    return sum;
  }

  PotentialScene<dim> scene;
  contact::ContactPotential<dim> potential;
  contact::Friction<dim> friction;
};

/// Deformed at random, with feet that wander, but so little that no point slides.
template <int dim>
Positions<dim> stir(const Positions<dim> &x, unsigned int seed)
{
  RandomVectors<dim> random(seed);
  return shifted<dim>(x, random.field(x.size(), .003), 1.);
}

/// Laws of friction, on all scenes whose points stay.
class FrictionLaws : public SurfaceLaws
{
};
} // namespace signorini::test
