// SPDX-License-Identifier: LGPL-2.1-or-later
#include "built_scene.h"

#include "signorini/physics/dead_load.h"
#include "signorini/physics/momentum.h"

#include <numeric>

using namespace signorini;
using namespace signorini::test;

namespace
{
template <int dim>
double sum_of_weights(const Discretization<dim> &discretization)
{
  return std::accumulate(discretization.cells.weights.begin(), discretization.cells.weights.end(), 0.);
}

/// Σ over nodes of one component, checking that free entries are positive and hanging ones zero.
template <int dim>
double checked_total(const BuiltScene<dim> &built, const Vector &lumped, unsigned int component)
{
  double total = 0.;
  for (const OwnedNode<dim> &node : built.discretization.owned_nodes)
    total += lumped.local_element(node.dofs[component]);
  for (const unsigned int dof : built.free_dofs())
    EXPECT_GT(lumped.local_element(dof), 0.);
  for (const HangingDof &hanging : built.discretization.hanging_dofs)
    EXPECT_EQ(lumped.local_element(hanging.dof), 0.);
  return total;
}

template <typename T>
class LoadsAndMass : public testing::Test
{
};
TYPED_TEST_SUITE(LoadsAndMass, AllCases);

TYPED_TEST(LoadsAndMass, MassOfAGradedBoxIsDensityTimesVolume)
{
  constexpr int dim = TypeParam::dim;
  BodyParameters box = graded(make_box("box", {2., 1.5, 1.}, {3, 2, 2}), {2., 1.5, 1.}, 2);
  const double volume = 3.; // in both dimensions
  BuiltScene<dim> built({box}, TypeParam::degree);
  ASSERT_FALSE(built.discretization.hanging_dofs.empty());
  for (unsigned int d = 0; d < dim; ++d)
  {
    EXPECT_NEAR(checked_total(built, make_lumped_mass(built.scene.materials, built.discretization), d),
                box.material.density * volume, 1e-13 * volume);
    EXPECT_NEAR(checked_total(built, make_nodal_volume(built.discretization), d), volume, 1e-13 * volume);
  }
}

TYPED_TEST(LoadsAndMass, MassOfADistortedMeshIsDensityTimesVolume)
{
  constexpr int dim = TypeParam::dim;
  BodyParameters ball = graded(make_ball("ball", 1., 1), {1., 0., 0.}, 1, .3);
  BuiltScene<dim> built({ball, make_box("other", {-1., -1., -1.}, {1, 1, 1})}, TypeParam::degree,
                        [](Parameters &p)
                        {
                          p.bodies[1].mesh.lower_corner = {-2., -2., -2.};
                          p.bodies[1].material.density = 50.;
                        });
  ASSERT_FALSE(built.discretization.hanging_dofs.empty());
  const double volume = sum_of_weights(built.discretization);
  EXPECT_NEAR(checked_total(built, make_nodal_volume(built.discretization), 0), volume, 1e-12 * volume);
  const double mass = ball.material.density * (volume - 1.) + 50.;
  EXPECT_NEAR(checked_total(built, make_lumped_mass(built.scene.materials, built.discretization), 0), mass,
              1e-12 * mass);
}

/// Shares of a node in the mass of its element, in proportion to the diagonal of the consistent mass (Hinton,
/// Rock, Zienkiewicz 1976): of quadratic simplices ∫N² of a corner and of an edge are as 3 to 16.
TYPED_TEST(LoadsAndMass, SimplicesShareTheirMassAsTheDiagonalDoes)
{
  constexpr int dim = TypeParam::dim;
  const BodyParameters box = make_simplex_box("box", dim, {2., 1.5, 1.}, {1, 1, 1});
  const BuiltScene<dim> built({box}, TypeParam::degree);
  const bool is_linear = TypeParam::degree == 1;
  const double corner = is_linear  ? 1. / (dim + 1)
                        : dim == 2 ? 1. / 19.
                                   : 1. / 36.,
               edge = dim == 2 ? 16. / 57. : 4. / 27.;
  const CellTable<dim> &cells = built.discretization.cells;
  double volume_of_all = 0.;
  for (unsigned int cell = 0; cell < cells.n_cells; ++cell)
  {
    const double *weights = cells.cell_weights(cell), *shares = cells.cell_nodal_measures(cell);
    const double volume = std::accumulate(weights, weights + cells.n_points(cell), 0.);
    ASSERT_EQ(cells.n_nodes(cell), is_linear ? dim + 1u : (dim + 1u) * (dim + 2u) / 2u);
    for (unsigned int a = 0; a < cells.n_nodes(cell); ++a)
      EXPECT_NEAR(shares[a], (a <= dim ? corner : edge) * volume, 1e-13 * volume);
    volume_of_all += volume;
  }
  EXPECT_NEAR(volume_of_all, 3., 1e-13);
  EXPECT_NEAR(checked_total(built, make_lumped_mass(built.scene.materials, built.discretization), 0),
              box.material.density * 3., 1e-12);
}

template <int dim>
VectorAndMoment load_on(BuiltScene<dim> &built, double time = 0.)
{
  DeadLoad<dim> load(built.scene, built.discretization, WeightShares::lumped_mass);
  built.state.time = time;
  const Vector none = built.discretization.make_vector();
  return sum_over_nodes(built.discretization, none, built.force_of(load, none));
}

LoadParameters make_traction(const std::string &boundary, const std::array<std::string, 3> &traction)
{
  LoadParameters load;
  load.boundary = boundary;
  load.traction = traction;
  return load;
}

TYPED_TEST(LoadsAndMass, TractionOnAGradedFaceHasItsResultantAndMoment)
{
  constexpr int dim = TypeParam::dim;
  // Hanging nodes on the loaded face x = 2; its size is 1.5 (× 1).
  BodyParameters box = graded(make_box("box", {2., 1.5, 1.}, {3, 2, 2}), {2., 1.5, 1.}, 2);
  box.loads.push_back(make_traction("right", {{"3*t", "-2", "5"}}));
  BuiltScene<dim> built({make_box("unloaded", {-1., -1., -1.}, {1, 1, 1}), box}, TypeParam::degree,
                        [](Parameters &p) {
                          p.bodies[0].mesh.lower_corner = {-2., -2., -2.};
                        });
  const VectorAndMoment sums = load_on(built, .5);
  const double area = 1.5;
  const std::array<double, 3> force{1.5 * area, -2. * area, dim == 3 ? 5. * area : 0.},
      arm{2., .75, dim == 3 ? .5 : 0.};
  for (unsigned int d = 0; d < 3; ++d)
  {
    const unsigned int e = (d + 1) % 3, f = (d + 2) % 3;
    EXPECT_NEAR(sums.vector[d], force[d], 1e-12);
    EXPECT_NEAR(sums.moment[d], arm[e] * force[f] - arm[f] * force[e], 1e-12);
  }
}

TYPED_TEST(LoadsAndMass, LinearTractionIsIntegratedExactly)
{
  constexpr int dim = TypeParam::dim;
  BodyParameters box = make_box("box", {2., 1.5, 1.}, {1, 1, 1});
  box.loads.push_back(make_traction("right", {{"y", "0", "0"}}));
  BuiltScene<dim> built({box}, TypeParam::degree);
  const VectorAndMoment sums = load_on(built);
  EXPECT_NEAR(sums.vector[0], 1.5 * 1.5 / 2., 1e-13);
  EXPECT_NEAR(sums.moment[2], -1.5 * 1.5 * 1.5 / 3., 1e-13); // −∫ y² dA
}

TYPED_TEST(LoadsAndMass, GravityPullsAtTheCentreOfMass)
{
  constexpr int dim = TypeParam::dim;
  const BodyParameters box = graded(make_box("box", {2., 1.5, 1.}, {3, 2, 2}), {2., 1.5, 1.});
  BuiltScene<dim> built({box}, TypeParam::degree, [](Parameters &p) { p.gravity = {1., -9., 4.}; });
  const VectorAndMoment sums = load_on(built);
  const double mass = box.material.density * 3.;
  EXPECT_NEAR(sums.vector[0], mass, 1e-12);
  EXPECT_NEAR(sums.vector[1], -9. * mass, 1e-12);
  EXPECT_NEAR(sums.vector[2], dim == 3 ? 4. * mass : 0., 1e-12);
  EXPECT_NEAR(sums.moment[2], 1. * -9. * mass - .75 * mass, 1e-11);
}

TYPED_TEST(LoadsAndMass, EnergyIsMinusForceTimesDisplacement)
{
  constexpr int dim = TypeParam::dim;
  BodyParameters box = make_graded_cube();
  box.loads.push_back(make_traction("left", {{"3", "x+y", "5"}}));
  BuiltScene<dim> built({box}, TypeParam::degree, [](Parameters &p) { p.gravity = {1., -9., 4.}; });
  DeadLoad<dim> load(built.scene, built.discretization, WeightShares::lumped_mass);
  const Vector u = built.random_vector(.1);
  const Vector force = built.force_of(load, u);
  EXPECT_NEAR(load.energy(), -(force * u), 1e-12);
  expect_force_is_energy_gradient(built, load, u, 1e-3, 1e-10);
}
} // namespace
