// SPDX-License-Identifier: LGPL-2.1-or-later
#include "built_scene.h"

#include "signorini/base/exceptions.h"
#include "signorini/discretization/scene_mesh.h"

#include <deal.II/base/mpi.h>

using namespace signorini;
using namespace signorini::test;

namespace
{
constexpr std::array all_parts{MeshParameters::Part::whole, MeshParameters::Part::half,
                               MeshParameters::Part::orthant};

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

BodyParameters make_graded_ball(MeshParameters::Part part, unsigned int dim)
{
  BodyParameters ball = make_ball("ball", 1., 1);
  ball.mesh.part = part;
  Triple pole{};
  pole[dim - 1] = 1.;
  return graded(ball, pole, 7, .025);
}

template <typename T>
class HexahedraOnRanks : public testing::Test
{
};
TYPED_TEST_SUITE(HexahedraOnRanks, LinearCases);

/// Every level coarsens the parts of the mesh that a rank gives away, and builds others in their place.
TYPED_TEST(HexahedraOnRanks, AreTheSameHoweverOftenTheyChangeRanks)
{
  constexpr int dim = TypeParam::dim;
  for (const MeshParameters::Part part : all_parts)
  {
    const BodyParameters ball = make_graded_ball(part, dim);
    const auto shared = make_scene_mesh<dim>({ball}, MPI_COMM_WORLD);
    const auto alone = make_scene_mesh<dim>({ball}, MPI_COMM_SELF);
    std::map<dealii::CellId, dealii::Point<dim>> corners;
    for (const auto &cell : alone->active_cell_iterators())
      corners[cell->id()] = cell->vertex(cell->n_vertices() - 1);
    EXPECT_EQ(shared->n_global_active_cells(), corners.size());
    double farthest = 0.;
    for (const auto &cell : shared->active_cell_iterators())
      if (!cell->is_artificial())
        farthest = std::max(farthest, corners.at(cell->id()).distance(cell->vertex(cell->n_vertices() - 1)));
    EXPECT_LT(farthest, 1e-12) << "part " << static_cast<int>(part);
  }
}

/// What deal.II need not cope with: a face that runs along one of its lines against the direction of that
/// line.
TEST(MeshesOnRanks, LinesRunOneWayForAllCells)
{
  using Shape = MeshParameters::Shape;
  for (const Shape shape : {Shape::box, Shape::ball, Shape::cylinder})
    for (const MeshParameters::Part part : all_parts)
    {
      BodyParameters body = make_ball("body", 1., 0);
      body.mesh.shape = shape;
      body.mesh.part = part;
      body.mesh.upper_corner = {1., 1., 1.};
      body.mesh.cells = {2, 2, 2};
      body.mesh.length = 2.;
      const auto mesh = make_scene_mesh<3>({body}, MPI_COMM_SELF);
      for (const auto &face : mesh->active_face_iterators())
        for (const unsigned int line : face->line_indices())
          EXPECT_TRUE(face->line_orientation(line)) << face->center();
    }
}
} // namespace
