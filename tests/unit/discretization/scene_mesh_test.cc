// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/discretization/scene_mesh.h"

#include "signorini/base/exceptions.h"

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

using namespace signorini;

namespace
{
unsigned int this_rank()
{
  return dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
}

BodyParameters make_ball_of_tetrahedra()
{
  BodyParameters body;
  body.name = "ball";
  body.mesh.shape = MeshParameters::Shape::ball;
  body.mesh.cell_type = MeshParameters::CellType::tetrahedra;
  body.mesh.element_size = .5;
  return body;
}

/// Ranks that would make other meshes get that of the first one, with all that is in it.
TEST(MeshesOnRanks, AreThatOfTheFirst)
{
  const BodyParameters body = make_ball_of_tetrahedra();
  const auto size_of_body = [](unsigned int)
  { return [](const Triple &) { return this_rank() == 0 ? .5 : .25; }; };
  const auto placed = place_simplex_meshes<3>({body}, 2, MPI_COMM_WORLD, size_of_body);
  const auto alone = place_simplex_meshes<3>({body}, 2, MPI_COMM_SELF,
                                             [](unsigned int) { return [](const Triple &) { return .5; }; });
  ASSERT_EQ(placed.size(), 1u);
  const SimplexMesh &mesh = placed[0].mesh, &expected = alone[0].mesh;
  EXPECT_EQ(placed[0].body, alone[0].body);
  EXPECT_EQ(mesh.dimension, expected.dimension);
  EXPECT_EQ(mesh.vertices, expected.vertices);
  EXPECT_EQ(mesh.cells, expected.cells);
  EXPECT_EQ(mesh.regions, expected.regions);
  EXPECT_EQ(mesh.region_names, expected.region_names);
  EXPECT_EQ(mesh.boundary_names, expected.boundary_names);
  EXPECT_FALSE(expected.edge_midpoints.empty());
  EXPECT_EQ(mesh.edge_midpoints, expected.edge_midpoints);
  ASSERT_EQ(mesh.faces.size(), expected.faces.size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
  {
    EXPECT_EQ(mesh.faces[f].vertices, expected.faces[f].vertices);
    EXPECT_EQ(mesh.faces[f].boundary, expected.faces[f].boundary);
  }
}

TEST(MeshesOnRanks, FailTogether)
{
  const auto fail = [](unsigned int) -> SizeField { throw FileError("the size is gone"); };
  EXPECT_THROW(place_simplex_meshes<3>({make_ball_of_tetrahedra()}, 1, MPI_COMM_WORLD, fail), FileError);
}
} // namespace
