// SPDX-License-Identifier: LGPL-2.1-or-later
// Feet that are kept from step to step are those that a search without a past finds.
#include "box_surface.h"
#include "signorini/contact/potential/contact_potential.h"

#include <gtest/gtest.h>

using namespace signorini;
using namespace signorini::contact;
using namespace signorini::test;

namespace
{
/// What a potential says at some positions.
template <int dim>
struct Answer
{
  double energy;
  unsigned int n_touching;
  Positions<dim> forces;
  std::vector<double> stiffness, damping; ///< bounds of row sums, of all within a skin

  explicit Answer(const ContactPotential<dim> &potential)
      : energy(potential.energy()), n_touching(potential.measure().n_active),
        forces(potential.positions().size(), SpatialVector<dim>::Zero()), stiffness(forces.size(), 0.),
        damping(forces.size(), 0.)
  {
    potential.add_forces(forces);
    potential.add_row_sum_bounds(stiffness, damping);
  }

  void expect_same(const Answer &other) const
  {
    EXPECT_EQ(n_touching, other.n_touching);
    EXPECT_NEAR(energy, other.energy, 1e-11 * energy);
    double largest = 0.;
    for (const auto &force : forces)
      largest = std::max(largest, force.norm());
    for (std::size_t node = 0; node < forces.size(); ++node)
    {
      EXPECT_LE((forces[node] - other.forces[node]).norm(), 1e-10 * largest) << "node " << node;
      EXPECT_NEAR(stiffness[node], other.stiffness[node], 1e-10 * (1. + stiffness[node])) << "node " << node;
    }
  }
};

/// A box that turns, trembles and slides over another one, half a skin from it at times and into it at
/// others, while both fly.
template <int dim>
struct SlidingBox
{
  ContactSurface<dim> surface;
  Positions<dim> tremble;

  SlidingBox(unsigned int degree, FacetType type)
  {
    BoxSurfaceBuilder<dim> builder;
    for (unsigned int i = 0; i < 2; ++i)
    {
      BoxBody<dim> box;
      box.n_faces = 3;
      box.degree = degree;
      box.type = type;
      box.corner[dim - 1] = i;
      builder.add(box);
    }
    surface = builder.surface;
    RandomVectors<dim> random(7);
    tremble = random.field(surface.n_nodes(), 1.);
  }

  Positions<dim> at(double time) const
  {
    Positions<dim> x = surface.reference_positions;
    for (std::size_t node = 0; node < x.size(); ++node)
    {
      if (x[node][dim - 1] > 1. || (x[node][dim - 1] == 1. && node >= x.size() / 2))
      {
        const double slope = .02 * std::sin(9. * time);
        x[node][dim - 1] += slope * x[node][0] + .02 * std::cos(23. * time) - .005;
        x[node][0] += .8 * time - slope * (x[node][dim - 1] - 1.);
      }
      x[node][dim - 1] += .3 * time;
      x[node] += .004 * std::sin(40. * time + static_cast<double>(node)) * tremble[node];
    }
    return x;
  }
};

template <int dim>
void expect_kept_feet_to_be_found(unsigned int degree, FacetType type)
{
  constexpr unsigned int n_looks = 60, n_steps_between = 10;
  const SlidingBox<dim> box(degree, type);
  PotentialSettings settings;
  settings.damping_ratio = .1;
  ContactPotential<dim> kept(box.surface, {}, settings);
  unsigned int n_touching = 0, n_apart = 0;
  for (unsigned int step = 0; step < n_looks * n_steps_between; ++step)
  {
    const Positions<dim> x = box.at(static_cast<double>(step) / (n_looks * n_steps_between));
    kept.update(x);
    kept.evaluate(x);
    if (step % n_steps_between > 0)
      continue;
    ContactPotential<dim> fresh(box.surface, {}, settings);
    fresh.update(x);
    const Answer<dim> answer(kept);
    answer.expect_same(Answer<dim>(fresh));
    n_touching += answer.n_touching > 0;
    n_apart += answer.n_touching == 0;
  }
  EXPECT_GT(n_touching, n_looks / 4);
  EXPECT_GT(n_apart, n_looks / 10);
  EXPECT_LT(kept.pair_list().n_renewals(), n_looks / 2);
}
} // namespace

TEST(KeptFeet, AreFoundIn2D)
{
  expect_kept_feet_to_be_found<2>(1, FacetType::tensor_product);
  expect_kept_feet_to_be_found<2>(2, FacetType::tensor_product);
}

TEST(KeptFeet, AreFoundOnQuadrilaterals)
{
  expect_kept_feet_to_be_found<3>(1, FacetType::tensor_product);
}

TEST(KeptFeet, AreFoundOnTriangles)
{
  expect_kept_feet_to_be_found<3>(1, FacetType::triangle);
}

TEST(KeptFeet, AreFoundOnFacetsOfDegree2)
{
  expect_kept_feet_to_be_found<3>(2, FacetType::triangle);
}
