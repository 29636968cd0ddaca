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
