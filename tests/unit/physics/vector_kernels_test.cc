// SPDX-License-Identifier: LGPL-2.1-or-later
#include "built_scene.h"

#include "signorini/physics/batch_order.h"
#include "signorini/physics/batched_force.h"

#include <cmath>
#include <set>

using namespace signorini;
using namespace signorini::test;

namespace
{
/// Distorted cells of both shapes, more of each than fill whole batches, and hanging nodes.
template <int dim>
std::vector<BodyParameters> make_two_laws(Model ball_model, Model cube_model)
{
  BodyParameters ball = make_ball("ball", .8, 1);
  ball.placement.shift = {3., -1., .5};
  ball.placement.rotation_angle = 35.;
  ball.placement.rotation_axis = {1., .3, -.2};
  ball.material = make_material(ball_model, .3);
  BodyParameters cube = make_graded_cube();
  cube.placement.shift = {-4., 0., 0.};
  cube.material = make_material(cube_model, .45);
  BodyParameters box = make_simplex_box("box", dim, {1., 1.5, .8}, {3, 2, 2});
  box.placement = ball.placement;
  box.placement.shift = {-8., 1., 0.};
  box.material = cube.material;
  return {ball, box, cube};
}

/// Calls `action(kernel, cell, geometry, u)` for every cell, one at a time.
template <int dim, typename Action>
void for_each_kernel(const BuiltScene<dim> &built, const Vector &displacement, const Action &action)
{
  const CellTable<dim> &cells = built.discretization.cells;
  for (unsigned int cell = 0; cell < cells.n_cells; ++cell)
  {
    std::vector<double> u(cells.n_cell_dofs(cell));
    for (unsigned int i = 0; i < u.size(); ++i)
      u[i] = displacement.local_element(cells.cell_dofs(cell)[i]);
    const MaterialParameters &material = built.scene.materials[cells.bodies[cell]];
    const double E = material.youngs_modulus, nu = material.poissons_ratio;
    const double shear = E / (2. * (1. + nu)), bulk = E / (3. * (1. - 2. * nu));
    CellKernel<dim, LinearElastic<dim>> linear({shear, bulk}, 1);
    CellKernel<dim, NeoHookean<dim>> neo_hookean({shear, bulk}, 1);
    if (material.model == Model::linear_elastic)
      action(linear, cell, geometry_of(cells, cell), u.data());
    else
      action(neo_hookean, cell, geometry_of(cells, cell), u.data());
  }
}

template <int dim>
Vector force_by_cells(const BuiltScene<dim> &built, const Vector &displacement)
{
  const CellTable<dim> &cells = built.discretization.cells;
  Vector force = built.discretization.make_vector();
  for_each_kernel(built, displacement,
                  [&](auto &kernel, unsigned int cell, const CellGeometry &geometry, const double *u)
                  {
                    std::vector<double> cell_force(cells.n_cell_dofs(cell), 0.);
                    kernel.add_force(geometry, u, cell_force.data());
                    for (unsigned int i = 0; i < cell_force.size(); ++i)
                      force.local_element(cells.cell_dofs(cell)[i]) += cell_force[i];
                  });
  return force;
}

template <int dim>
std::vector<const VectorKernels<dim> *> list_kernels()
{
  unsigned int n = 0;
  const VectorKernels<dim> *const *first = all_vector_kernels<dim>(n);
  return {first, first + n};
}

template <typename T>
class VectorKernel : public testing::Test
{
};
TYPED_TEST_SUITE(VectorKernel, LinearCases);

TYPED_TEST(VectorKernel, ForcesAreThoseOfSingleCells)
{
  constexpr int dim = TypeParam::dim;
  for (const auto &[one, other] : {std::pair(Model::neo_hookean, Model::linear_elastic),
                                   std::pair(Model::linear_elastic, Model::neo_hookean)})
  {
    const BuiltScene<dim> built(make_two_laws<dim>(one, other), 1);
    // Also where forces are small differences of large terms.
    for (const double amplitude : {.04, 1e-7})
    {
      const Vector u = built.random_vector(amplitude);
      const Vector expected = force_by_cells(built, u);
      for (const VectorKernels<dim> *kernels : list_kernels<dim>())
      {
        const BatchedForce<dim> batched(built.scene.materials, built.discretization, *kernels);
        Vector force = built.discretization.make_vector();
        for (unsigned int time = 0; time < 2; ++time) // it must not remember the first
        {
          force = 0.;
          batched.add_force(u, force);
          force -= expected;
          EXPECT_LT(force.linfty_norm(), 2e-14 * expected.linfty_norm()) << kernels->instruction_set;
        }
      }
    }
  }
}

TYPED_TEST(VectorKernel, EnergiesAreThoseOfSingleCells)
{
  constexpr int dim = TypeParam::dim;
  for (const Model model : {Model::neo_hookean, Model::linear_elastic})
  {
    const BuiltScene<dim> built(make_two_laws<dim>(model, model), 1);
    for (const double amplitude : {.04, 1e-7})
    {
      const Vector u = built.random_vector(amplitude);
      double expected = 0.;
      for_each_kernel(built, u,
                      [&](auto &kernel, unsigned int, const CellGeometry &geometry, const double *nodal)
                      { expected += kernel.energy(geometry, nodal); });
      for (const VectorKernels<dim> *kernels : list_kernels<dim>())
      {
        const BatchedForce<dim> batched(built.scene.materials, built.discretization, *kernels);
        // What both lose where energies of first order cancel.
        const double round_off = 1e-15 / amplitude;
        EXPECT_NEAR(batched.energy(u) / expected, 1., 1e-14 + round_off) << kernels->instruction_set;
      }
    }
  }
}

TYPED_TEST(VectorKernel, StretchesAreThoseOfSingleCells)
{
  constexpr int dim = TypeParam::dim;
  BuiltScene<dim> built(make_two_laws<dim>(Model::neo_hookean, Model::linear_elastic), 1);
  const Vector u = built.random_vector(.04);
  const CellTable<dim> &cells = built.discretization.cells;
  for (const VectorKernels<dim> *kernels : list_kernels<dim>())
  {
    const BatchedForce<dim> batched(built.scene.materials, built.discretization, *kernels);
    std::vector<typename BatchedForce<dim>::Stretch> stretches(cells.n_cells);
    batched.compute_stretches(u, stretches);
    const CellKernel<dim, LinearElastic<dim>> kernel({1., 1.}, 1);
    for (unsigned int cell = 0; cell < cells.n_cells; ++cell)
    {
      std::vector<double> nodal(cells.n_cell_dofs(cell));
      for (unsigned int i = 0; i < nodal.size(); ++i)
        nodal[i] = u.local_element(cells.cell_dofs(cell)[i]);
      const auto expected = kernel.mean_stretch(geometry_of(cells, cell), nodal.data());
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = i; j < dim; ++j)
        {
          const unsigned int entry = i == j ? i : dim + i + j - 1;
          EXPECT_NEAR(stretches[cell][entry], expected(i, j), 1e-14 * (1. + expected.norm()));
        }
    }
  }
}

TYPED_TEST(VectorKernel, CellsInsideOutHaveNoForce)
{
  constexpr int dim = TypeParam::dim;
  const BuiltScene<dim> built(make_two_laws<dim>(Model::neo_hookean, Model::neo_hookean), 1);
  // Mirrored: every volume is negative.
  Vector u = built.discretization.make_vector();
  for (const OwnedNode<dim> &node : built.discretization.owned_nodes)
    u.local_element(node.dofs[0]) = -2. * node.position[0];
  built.discretization.distribute(u);
  for (const VectorKernels<dim> *kernels : list_kernels<dim>())
  {
    const BatchedForce<dim> batched(built.scene.materials, built.discretization, *kernels);
    Vector force = built.discretization.make_vector();
    batched.add_force(u, force);
    for (const OwnedNode<dim> &node : built.discretization.owned_nodes)
      EXPECT_TRUE(std::isnan(force.local_element(node.dofs[0]))) << kernels->instruction_set;
  }
}

TEST(BatchOrder, NeighboursAreNotInOneBatch)
{
  // Six tetrahedra around the long diagonal of each cube, all with the same first and last node.
  std::vector<unsigned int> nodes;
  constexpr unsigned int n_cubes = 40, n_lanes = 8;
  for (unsigned int cube = 0; cube < n_cubes; ++cube)
    for (unsigned int i = 0; i < 6; ++i)
      for (const unsigned int node : {0u, 1u + i, 1u + (i + 1) % 6, 7u})
        nodes.push_back(10 * cube + node);
  const std::vector<unsigned int> order = make_batch_order(nodes, 4, n_lanes);
  ASSERT_EQ(order.size(), 6 * n_cubes);
  EXPECT_EQ(std::set<unsigned int>(order.begin(), order.end()).size(), order.size());
  unsigned int n_together = 0;
  for (unsigned int batch = 0; batch < order.size() / n_lanes; ++batch)
  {
    std::set<unsigned int> first_nodes;
    for (unsigned int lane = 0; lane < n_lanes; ++lane)
      first_nodes.insert(nodes[4 * order[batch * n_lanes + lane]]);
    n_together += n_lanes - static_cast<unsigned int>(first_nodes.size());
  }
  EXPECT_LE(n_together, 24u); // the last, that no others are left for
}

TEST(BatchOrder, CellsWithoutCommonPlacesStayInOrder)
{
  std::vector<unsigned int> nodes;
  for (unsigned int cell = 0; cell < 20; ++cell)
    for (const unsigned int node : {cell, cell + 1, cell + 21, cell + 22})
      nodes.push_back(node);
  const std::vector<unsigned int> order = make_batch_order(nodes, 4, 4);
  for (unsigned int i = 0; i < 20; ++i)
    EXPECT_EQ(order[i], i);
}
} // namespace
