// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/simulation/size_estimate.h"

#include "signorini/discretization/generated_simplex_mesh.h"
#include "signorini/discretization/scene_mesh.h"

#include <gtest/gtest.h>

using namespace signorini;

namespace
{
Parameters with_body(const MeshParameters &mesh, unsigned int dimension)
{
  Parameters parameters;
  parameters.dimension = dimension;
  parameters.bodies.resize(1);
  parameters.bodies[0].mesh = mesh;
  return parameters;
}

template <int dim>
double n_cells(const Parameters &parameters)
{
  return static_cast<double>(make_scene_mesh<dim>(parameters.bodies, MPI_COMM_SELF)->n_global_active_cells());
}
} // namespace

TEST(SizeEstimate, CountsRegularMeshesExactly)
{
  MeshParameters mesh;
  mesh.cells = {4, 4, 4};
  mesh.refinements = 1;
  const SizeEstimate cube = estimate_size(with_body(mesh, 3), 1);
  EXPECT_NEAR(cube.n_cells, 512., 1e-6);
  EXPECT_NEAR(cube.n_dofs, 3. * 9. * 9. * 9., 1e-6);

  for (const auto part :
       {MeshParameters::Part::whole, MeshParameters::Part::half, MeshParameters::Part::orthant})
  {
    mesh.shape = MeshParameters::Shape::ball;
    mesh.part = part;
    EXPECT_NEAR(estimate_size(with_body(mesh, 2), 1).n_cells, n_cells<2>(with_body(mesh, 2)), 1e-6);
    EXPECT_NEAR(estimate_size(with_body(mesh, 3), 1).n_cells, n_cells<3>(with_body(mesh, 3)), 1e-6);
  }
  mesh.shape = MeshParameters::Shape::cylinder;
  EXPECT_NEAR(estimate_size(with_body(mesh, 3), 1).n_cells, n_cells<3>(with_body(mesh, 3)), 1e-6);
}

TEST(SizeEstimate, IsNearForGradedMeshes)
{
  MeshParameters mesh;
  mesh.shape = MeshParameters::Shape::ball;
  mesh.part = MeshParameters::Part::orthant;
  mesh.grading = MeshParameters::Grading{{0., 0., 1.}, {}, 0.05, 4};
  const double ball = n_cells<3>(with_body(mesh, 3));
  EXPECT_LT(estimate_size(with_body(mesh, 3), 1).n_cells, 2. * ball);
  EXPECT_GT(estimate_size(with_body(mesh, 3), 1).n_cells, 0.3 * ball);

  MeshParameters box;
  box.cells = {4, 4, 4};
  box.grading = MeshParameters::Grading{{}, "top", 0.02, 3};
  const double graded_box = n_cells<3>(with_body(box, 3));
  EXPECT_LT(estimate_size(with_body(box, 3), 1).n_cells, 2. * graded_box);
  EXPECT_GT(estimate_size(with_body(box, 3), 1).n_cells, 0.3 * graded_box);
}

/// Resident memory after set-up of explicit runs of a cube of 40 cells along an edge, on one rank.
TEST(SizeEstimate, IsNearTheMemoryOfExplicitRuns)
{
  const auto estimate = [](MeshParameters::CellType type, unsigned int degree)
  {
    MeshParameters mesh;
    mesh.cell_type = type;
    mesh.cells = {10, 10, 10};
    mesh.refinements = 2;
    Parameters parameters = with_body(mesh, 3);
    parameters.degree = degree;
    parameters.solver = ExplicitParameters();
    return estimate_size(parameters, 1).memory;
  };
  constexpr double share = 0.25;
  EXPECT_NEAR(estimate(MeshParameters::CellType::hexahedra, 1), 396e6, share * 396e6);
  EXPECT_NEAR(estimate(MeshParameters::CellType::hexahedra, 2), 936e6, share * 936e6);
  EXPECT_NEAR(estimate(MeshParameters::CellType::tetrahedra, 1), 689e6, share * 689e6);
  EXPECT_NEAR(estimate(MeshParameters::CellType::tetrahedra, 2), 1045e6, share * 1045e6);
}

/// The volume potential holds the simplices of all cells on every rank.
TEST(SizeEstimate, VolumePotentialCostsMemoryOnEveryRank)
{
  MeshParameters mesh;
  mesh.cells = {4, 4, 4};
  const auto memory_of_simplices =
      [&mesh](unsigned int dimension, unsigned int n_ranks, unsigned int n_bodies)
  {
    Parameters parameters = with_body(mesh, dimension);
    parameters.bodies.resize(n_bodies, parameters.bodies[0]);
    parameters.contact.emplace();
    const double without = estimate_size(parameters, n_ranks).memory;
    parameters.contact->potential = ContactParameters::Potential::volume;
    return estimate_size(parameters, n_ranks).memory - without;
  };
  const double of_hexahedra = memory_of_simplices(3, 1, 2);
  EXPECT_GT(of_hexahedra, 2. * 64. * 24. * 100.); // less than its positions would take is wrong
  EXPECT_NEAR(memory_of_simplices(3, 8, 2) / of_hexahedra, 8., 1e-9);
  EXPECT_NEAR(memory_of_simplices(2, 1, 2) / of_hexahedra, 16. * 4. / (64. * 24.), 1e-9);
  EXPECT_EQ(memory_of_simplices(3, 8, 1), 0.);
  mesh.cell_type = MeshParameters::CellType::tetrahedra;
  EXPECT_NEAR(memory_of_simplices(3, 1, 2) / of_hexahedra, 6. / 24., 1e-9);
}

TEST(SizeEstimate, IsNearForTetrahedra)
{
  MeshParameters box;
  box.cell_type = MeshParameters::CellType::tetrahedra;
  box.element_size = .2;
  box.refinements = 1;
  for (const unsigned int dimension : {2u, 3u})
  {
    const SimplexMesh mesh = make_simplex_body_mesh(box, dimension, 1);
    const SizeEstimate size = estimate_size(with_body(box, dimension), 1);
    EXPECT_NEAR(size.n_cells / mesh.cells.size(), 1., .3);
    EXPECT_NEAR(size.n_dofs / (dimension * mesh.vertices.size()), 1., .4);
  }
  box.refinements = 0;
  box.mesh_of_file = std::make_shared<const SimplexMesh>(make_simplex_body_mesh(box, 3, 1));
  EXPECT_EQ(estimate_size(with_body(box, 3), 1).n_cells, box.mesh_of_file->cells.size());
}
