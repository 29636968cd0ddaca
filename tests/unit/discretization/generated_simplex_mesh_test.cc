// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/discretization/generated_simplex_mesh.h"

#include "signorini/discretization/body_mesh.h"
#include "signorini/discretization/surface_distance.h"
#include "signorini/mesh/geometry_file.h"
#include "signorini/parameters/mesh_parameters.h"

#include "mesh/mesh_text.h"

#include <gmsh.h>

#include <cmath>
#include <map>
#include <set>

using namespace signorini;
using namespace signorini::test;

namespace
{
constexpr double pi = 3.14159265358979323846;
using Part = MeshParameters::Part;

MeshParameters tetrahedra(const MeshParameters::Shape shape, const double size)
{
  MeshParameters mesh;
  mesh.shape = shape;
  mesh.cell_type = MeshParameters::CellType::tetrahedra;
  mesh.element_size = size;
  return mesh;
}

MeshParameters ball(const double radius, const double size, const Part part = Part::whole)
{
  MeshParameters mesh = tetrahedra(MeshParameters::Shape::ball, size);
  mesh.radius = radius;
  mesh.part = part;
  return mesh;
}

SimplexMesh generate(const MeshParameters &mesh, const unsigned int dimension, const unsigned int degree = 1)
{
  return make_simplex_body_mesh(mesh, dimension, degree);
}

double norm(const Triple &x)
{
  return distance(x, {});
}

std::set<std::pair<unsigned int, unsigned int>> edges_of(const SimplexMesh &mesh)
{
  std::set<std::pair<unsigned int, unsigned int>> edges;
  for (const auto &cell : mesh.cells)
    for (unsigned int v = 0; v <= mesh.dimension; ++v)
      for (unsigned int w = 0; w < v; ++w)
        edges.insert(std::minmax(cell[v], cell[w]));
  return edges;
}

/// Of the edges' lengths over the sizes at their midpoints.
double median_length(const SimplexMesh &mesh, const SizeField &size)
{
  std::vector<double> lengths;
  for (const auto &[a, b] : edges_of(mesh))
    lengths.push_back(distance(mesh.vertices[a], mesh.vertices[b]) /
                      size(midpoint(mesh.vertices[a], mesh.vertices[b])));
  std::nth_element(lengths.begin(), lengths.begin() + lengths.size() / 2, lengths.end());
  return lengths[lengths.size() / 2];
}

double worst_quality(const SimplexMesh &mesh)
{
  double worst = 1.;
  for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
    worst = std::min(worst, radius_ratio(corners_of(mesh, cell), mesh.dimension));
  return worst;
}

/// All its boundaries are there, and their faces lie on them.
void expect_boundaries(const SimplexMesh &mesh, const MeshParameters &parameters)
{
  std::vector<std::string> expected = boundary_names(parameters, mesh.dimension), found = mesh.boundary_names;
  std::sort(expected.begin(), expected.end());
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, expected);
  for (const SimplexMesh::Face &face : mesh.faces)
    for (unsigned int v = 0; v < mesh.dimension; ++v)
    {
      const Triple &x = mesh.vertices[face.vertices[v]];
      const std::string &name = mesh.boundary_names[face.boundary];
      const double off = mesh.dimension == 3
                             ? distance_to_boundary<3>(parameters, name, dealii::Point<3>(x[0], x[1], x[2]))
                             : distance_to_boundary<2>(parameters, name, dealii::Point<2>(x[0], x[1]));
      EXPECT_LT(off, 1e-12 * (1. + norm(x)));
    }
}
} // namespace

TEST(GeneratedSimplexMesh, BoxesHaveTheirVolumeAndBoundaries)
{
  MeshParameters box = tetrahedra(MeshParameters::Shape::box, .3);
  box.lower_corner = {1000., -1., 2.};
  box.upper_corner = {1001., 1., 2.5};
  const SimplexMesh solid = generate(box, 3);
  expect_sound(solid);
  expect_boundaries(solid, box);
  EXPECT_NEAR(volume_of(solid), 1., 1e-10);
  box.lower_corner[2] = box.upper_corner[2] = 0.;
  const SimplexMesh sheet = generate(box, 2);
  expect_sound(sheet);
  expect_boundaries(sheet, box);
  EXPECT_NEAR(volume_of(sheet), 2., 1e-10);
  EXPECT_EQ(sheet.cells.front()[3], 0u);
}

TEST(GeneratedSimplexMesh, RoundShapesMissTheirVolumeByTheSquareOfTheSize)
{
  const auto missing = [](MeshParameters mesh, const unsigned int dimension, const double exact)
  {
    const SimplexMesh coarse = generate(mesh, dimension);
    expect_sound(coarse);
    expect_boundaries(coarse, mesh);
    mesh.refinements = 1;
    const double error = 1. - volume_of(coarse) / exact,
                 finer = 1. - volume_of(generate(mesh, dimension)) / exact;
    EXPECT_GT(finer, 0.);
    EXPECT_LT(error, .05);
    EXPECT_NEAR(std::log2(error / finer), 2., .3);
  };
  const double radius = 1e-3; // OpenCASCADE's own tolerance is 1e-7
  missing(ball(radius, .25 * radius), 2, pi * radius * radius);
  missing(ball(radius, .25 * radius, Part::orthant), 2, pi * radius * radius / 4.);
  const double volume = 4. / 3. * pi * std::pow(radius, 3);
  missing(ball(radius, .25 * radius), 3, volume);
  missing(ball(radius, .25 * radius, Part::half), 3, volume / 2.);
  missing(ball(radius, .25 * radius, Part::orthant), 3, volume / 8.);
  MeshParameters cylinder = tetrahedra(MeshParameters::Shape::cylinder, .25);
  cylinder.length = 3.;
  missing(cylinder, 3, 3. * pi);
}

TEST(GeneratedSimplexMesh, EdgesHaveTheLengthsAskedFor)
{
  for (const unsigned int dimension : {2u, 3u})
    for (MeshParameters mesh : {ball(2., .5), tetrahedra(MeshParameters::Shape::box, .2)})
    {
      EXPECT_NEAR(median_length(generate(mesh, dimension), make_size_field(mesh, dimension)), 1., .3);
      mesh.grading = MeshParameters::Grading{{0., 0., 0.}, {}, .05, 2};
      if (mesh.shape == MeshParameters::Shape::box)
        mesh.grading->boundary = "top";
      const SimplexMesh graded = generate(mesh, dimension);
      EXPECT_NEAR(median_length(graded, make_size_field(mesh, dimension)), 1., .3);
      EXPECT_GT(worst_quality(graded), dimension == 2 ? .4 : .15);
    }
}

TEST(GeneratedSimplexMesh, SizesDoubleWithTheDistance)
{
  MeshParameters mesh = ball(4., 1.);
  mesh.refinements = 1;
  mesh.grading = MeshParameters::Grading{{0., 0., 4.}, {}, .25, 2};
  const SizeField size = make_size_field(mesh, 3);
  EXPECT_DOUBLE_EQ(size({0., 0., 4.}), .125);
  EXPECT_DOUBLE_EQ(size({0., 0., 3.75}), .125);
  EXPECT_DOUBLE_EQ(size({0., 0., 3.5}), .25);
  EXPECT_DOUBLE_EQ(size({0., 0., 3.}), .5);
  EXPECT_DOUBLE_EQ(size({0., 0., -4.}), .5);
}

TEST(GeneratedSimplexMesh, MiddleNodesLieOnCurvedBoundaries)
{
  const double radius = 3.;
  for (const unsigned int dimension : {2u, 3u})
    for (const Part part : {Part::whole, Part::orthant})
    {
      const MeshParameters parameters = ball(radius, .8, part);
      const SimplexMesh mesh = generate(parameters, dimension, 2);
      std::set<std::pair<unsigned int, unsigned int>> on_surface;
      for (const SimplexMesh::Face &face : mesh.faces)
        for (unsigned int v = 0; v < dimension && mesh.boundary_names[face.boundary] == "surface"; ++v)
          for (unsigned int w = 0; w < v; ++w)
            on_surface.insert(std::minmax(face.vertices[v], face.vertices[w]));
      EXPECT_EQ(mesh.edge_midpoints.size(), on_surface.size());
      for (const auto &[ends, middle] : mesh.edge_midpoints)
      {
        EXPECT_TRUE(on_surface.count(ends)) << static_cast<int>(part);
        EXPECT_NEAR(norm(middle), radius, 1e-12 * radius);
      }
      EXPECT_TRUE(generate(parameters, dimension, 1).edge_midpoints.empty());
    }
}

TEST(GeneratedSimplexMesh, EdgesThatWouldFoldACellStayStraight)
{
  // A rod so coarse that the curved edges of its ends would fold cells.
  MeshParameters rod = tetrahedra(MeshParameters::Shape::cylinder, 1.);
  rod.radius = .1;
  const SimplexMesh mesh = generate(rod, 3, 2);
  expect_sound(mesh);
  expect_boundaries(mesh, rod);
}

TEST(GeneratedSimplexMesh, AShapeThatCannotBeMeshedIsRefused)
{
  const TemporaryFile file(".brep", "");
  {
    const GmshSession gmsh;
    gmsh::model::occ::addTorus(0., 0., 0., 1., .1);
    gmsh::model::occ::synchronize();
    gmsh::write(file.path);
  }
  MeshParameters parameters = tetrahedra(MeshParameters::Shape::file, 1.);
  parameters.file = file.path;
  EXPECT_THROW(generate(parameters, 3), InputError);
}

TEST(GeneratedSimplexMesh, IsTheSameEveryTime)
{
  const MeshParameters parameters = ball(1., .2);
  const SimplexMesh first = generate(parameters, 3), second = generate(parameters, 3);
  EXPECT_EQ(first.vertices, second.vertices);
  EXPECT_EQ(first.cells, second.cells);
}

TEST(GeneratedSimplexMesh, ShapesComeFromFiles)
{
  for (const std::string ending : {".step", ".brep", ".stl"})
  {
    const TemporaryFile file(ending, "");
    {
      const GmshSession gmsh;
      gmsh::model::occ::addBox(0., 0., 0., 2., 1., 1.);
      gmsh::model::occ::synchronize();
      gmsh::model::mesh::generate(2);
      gmsh::write(file.path);
    }
    const double unit = ending == ".step" ? 1e-3 : 1.;
    MeshParameters parameters = tetrahedra(MeshParameters::Shape::file, .25 * unit);
    parameters.file = file.path;
    parameters.surface_of_file = std::make_shared<const SimplexMesh>(read_geometry_file(file.path, 3));
    parameters.grading = MeshParameters::Grading{{}, boundary_names(parameters, 3).front(), .1 * unit, 1};
    const SimplexMesh mesh = generate(parameters, 3);
    expect_sound(mesh);
    EXPECT_NEAR(volume_of(mesh), 2. * std::pow(unit, 3), 1e-9 * std::pow(unit, 3));
    EXPECT_EQ(mesh.boundary_names, boundary_names(parameters, 3));
    EXPECT_EQ(mesh.boundary_names.size(), ending == ".stl" ? 1u : 6u);
    EXPECT_EQ(mesh.region_names, std::vector<std::string>{"volume_1"});
    EXPECT_NEAR(median_length(mesh, make_size_field(parameters, 3)), 1., .3);
  }
}

TEST(GeneratedSimplexMesh, RegionsOfAShapeShareTheirFaces)
{
  const TemporaryFile file(".brep", "");
  {
    const GmshSession gmsh;
    gmsh::model::occ::addBox(0., 0., 0., 1., 1., 1.);
    gmsh::model::occ::addBox(1., 0., 0., 2., 1., 1.);
    gmsh::model::occ::synchronize();
    gmsh::write(file.path);
  }
  MeshParameters parameters = tetrahedra(MeshParameters::Shape::file, .5);
  parameters.file = file.path;
  const auto volume = [&](const std::vector<std::string> &regions, const std::size_t n_boundaries)
  {
    parameters.regions = regions;
    parameters.surface_of_file =
        std::make_shared<const SimplexMesh>(read_geometry_file(file.path, 3, regions));
    const SimplexMesh mesh = generate(parameters, 3);
    EXPECT_EQ(mesh.boundary_names, boundary_names(parameters, 3));
    EXPECT_EQ(mesh.boundary_names.size(), n_boundaries);
    return volume_of(mesh);
  };
  EXPECT_NEAR(volume({}, 10), 3., 1e-9);
  EXPECT_NEAR(volume({"volume_1"}, 6) + volume({"volume_2"}, 6), 3., 1e-9);
  EXPECT_THROW(read_geometry_file(file.path, 3, {"volume_3"}), InputError);
}

TEST(SurfaceDistance, IsThatOfTheNearestPoint)
{
  SimplexMesh mesh;
  mesh.vertices = {{0., 0., 0.}, {2., 0., 0.}, {0., 2., 0.}, {9., 9., 9.}};
  mesh.boundary_names = {"floor", "other"};
  mesh.faces = {{{0, 1, 2}, 0}, {{1, 2, 3}, 1}};
  const SurfaceDistance to_floor(mesh, "floor");
  EXPECT_DOUBLE_EQ(to_floor({.5, .5, -3.}), 3.);
  EXPECT_DOUBLE_EQ(to_floor({1., -1., 1.}), std::sqrt(2.));
  EXPECT_DOUBLE_EQ(to_floor({3., -1., 0.}), std::sqrt(2.));
  EXPECT_DOUBLE_EQ(to_floor({2., 2., 0.}), std::sqrt(2.));
  // A polygon of many edges: the nearest is found.
  SimplexMesh circle;
  circle.dimension = 2;
  circle.boundary_names = {"circle"};
  for (unsigned int i = 0; i < 200; ++i)
  {
    circle.vertices.push_back({std::cos(pi / 100. * i), std::sin(pi / 100. * i), 0.});
    circle.faces.push_back({{i, (i + 1) % 200, 0}, 0});
  }
  const SurfaceDistance to_circle(circle, "circle");
  for (const double angle : {.1, 1., 2., 3., 4., 5., 6.})
    for (const double radius : {.5, 3.})
      EXPECT_NEAR(to_circle({radius * std::cos(angle), radius * std::sin(angle), 0.}), std::abs(radius - 1.),
                  2e-4);
  mesh.dimension = 2;
  const SurfaceDistance to_edge(mesh, "floor");
  EXPECT_DOUBLE_EQ(to_edge({1., 1., 0.}), 1.);
}
