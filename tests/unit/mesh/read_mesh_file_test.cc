// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh_text.h"

#include "signorini/mesh/file_mesh.h"

using namespace signorini;
using namespace signorini::test;

namespace
{
// Two tetrahedra on a common face; their volumes are 1/6 and 1/3.
const std::vector<std::string> nodes{"0 0 0", "1 0 0", "0 1 0", "0 0 1", "1 1 1"};
const std::string skin = "2 2 2 1 1 2 3", first = "4 2 1 1 1 2 3 4", second = "4 2 4 2 2 3 4 5";

std::vector<std::string> with(std::vector<std::string> lines, const std::string &line)
{
  lines.push_back(line);
  return lines;
}

const char *const msh_41 = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
2
2 2 "skin"
3 1 "core"
$EndPhysicalNames
$Entities
0 0 1 1
1 0 0 0 1 1 0 1 2 0
1 0 0 0 1 1 1 1 1 1 1
$EndEntities
$Nodes
1 5 1 5
3 1 0 5
1
2
3
4
5
0 0 0
1 0 0
0 1 0
0 0 1
1 1 1
$EndNodes
$Elements
2 3 1 3
2 1 2 1
1 1 2 3
3 1 4 2
2 1 2 3 4
3 2 3 4 5
$EndElements
)";

const char *const vtk = R"(# vtk DataFile Version 2.0
two tetrahedra
ASCII
DATASET UNSTRUCTURED_GRID
POINTS 5 double
0 0 0
1 0 0
0 1 0
0 0 1
1 1 1
CELLS 2 10
4 0 1 2 3
4 1 2 3 4
CELL_TYPES 2
10
10
)";

std::string tetrahedron_of_ten(const unsigned int curved_edge, const bool is_abaqus)
{
  const std::array<Triple, 4> corners{{{0., 0., 0.}, {1., 0., 0.}, {0., 1., 0.}, {0., 0., 1.}}};
  std::vector<Triple> all(corners.begin(), corners.end());
  for (unsigned int edge = 0; edge < 6; ++edge)
  {
    all.push_back(midpoint(corners[edges_of_cell[edge][0]], corners[edges_of_cell[edge][1]]));
    if (edge == curved_edge)
      all.back()[0] += .125;
  }
  if (!is_abaqus)
    std::swap(all[8], all[9]);
  std::vector<std::string> lines;
  std::string text = "*Node\n", element = "1";
  for (std::size_t node = 0; node < 10; ++node)
  {
    const auto [x, y, z] = all[node];
    lines.push_back(std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z));
    text += std::to_string(node + 1) + ", " + std::to_string(x) + ", " + std::to_string(y) + ", " +
            std::to_string(z) + "\n";
    element += (is_abaqus ? ", " : " ") + std::to_string(node + 1);
  }
  return is_abaqus ? text + "*Element, type=C3D10\n" + element + "\n"
                   : msh_text(lines, {"11 2 1 1" + element.substr(1)});
}
} // namespace

TEST(MeshFile, IsReadInEveryFormat)
{
  const SimplexMesh gmsh_2 = read_text(".msh", msh_text(nodes, {skin, first, second}));
  const SimplexMesh gmsh_4 = read_text(".msh", msh_41);
  const SimplexMesh from_vtk = read_text(".vtk", vtk);
  for (const SimplexMesh &mesh : {gmsh_2, gmsh_4, from_vtk})
  {
    expect_sound(mesh);
    EXPECT_EQ(mesh.vertices.size(), 5u);
    EXPECT_EQ(mesh.cells.size(), 2u);
    EXPECT_EQ(mesh.faces.size(), 6u);
    EXPECT_NEAR(volume_of(mesh), .5, 1e-15);
    EXPECT_TRUE(mesh.edge_midpoints.empty());
  }
  for (const SimplexMesh &mesh : {gmsh_2, gmsh_4})
  {
    EXPECT_EQ(mesh.boundary_names, (std::vector<std::string>{"skin", "rest"}));
    EXPECT_EQ(n_faces(mesh), (std::vector<std::size_t>{1, 5}));
  }
  EXPECT_EQ(gmsh_2.region_names, (std::vector<std::string>{"core", "shell"}));
  EXPECT_EQ(gmsh_2.regions, (std::vector<unsigned int>{0, 1}));
  EXPECT_EQ(from_vtk.boundary_names, std::vector<std::string>{"rest"});
}

TEST(MeshFile, RegionsChooseTheBody)
{
  const std::string text = msh_text(nodes, {skin, first, second, "2 2 7 5 2 3 4"});
  EXPECT_EQ(read_text(".msh", text).boundary_names, (std::vector<std::string>{"skin", "rest"}));
  const SimplexMesh shell = read_text(".msh", text, 3, {"shell"});
  EXPECT_EQ(shell.vertices.size(), 4u);
  EXPECT_NEAR(volume_of(shell), 1. / 3., 1e-15);
  // The face between the regions lies outside now, and its group has no name but its number.
  EXPECT_EQ(shell.boundary_names, (std::vector<std::string>{"7", "rest"}));
  const std::string unknown = refusal(".msh", text, 3, {"shel"});
  EXPECT_NE(unknown.find("no such region"), std::string::npos);
  EXPECT_NE(unknown.find("did you mean 'shell'"), std::string::npos);
}

TEST(MeshFile, MiddleNodesBelongToTheirEdges)
{
  for (const bool is_abaqus : {false, true})
    for (unsigned int edge = 0; edge < 6; ++edge)
    {
      const SimplexMesh mesh = read_text(is_abaqus ? ".inp" : ".msh", tetrahedron_of_ten(edge, is_abaqus));
      ASSERT_EQ(mesh.edge_midpoints.size(), 1u) << edge;
      const auto &[ends, middle] = *mesh.edge_midpoints.begin();
      EXPECT_EQ(ends, (std::pair<unsigned int, unsigned int>(
                          std::minmax(edges_of_cell[edge][0], edges_of_cell[edge][1]))));
      EXPECT_NEAR(distance(middle, midpoint(mesh.vertices[ends.first], mesh.vertices[ends.second])), .125,
                  1e-15);
    }
}

TEST(MeshFile, CellsAllInvertedAreTurned)
{
  const SimplexMesh mesh = read_text(".msh", msh_text(nodes, {"4 2 1 1 2 1 3 4", "4 2 1 1 3 2 4 5"}));
  expect_sound(mesh);
  EXPECT_NEAR(volume_of(mesh), .5, 1e-15);
  // In two dimensions each part may have a sense of its own; middle nodes stay with their edges.
  const SimplexMesh plane =
      read_text(".msh",
                msh_text({"0 0 0", "2 0 0", "2 2 0", "0 2 0", "1 -.25 0", "2 1 0", "1 1 0"},
                         {"2 2 1 1 1 3 4", "9 2 1 2 2 1 3 5 7 6"}),
                2);
  expect_sound(plane);
  ASSERT_EQ(plane.edge_midpoints.size(), 1u);
  EXPECT_EQ(plane.edge_midpoints.begin()->second, (Triple{1., -.25, 0.}));
}

TEST(MeshFile, TurnedTetrahedraKeepTheirMiddleNodes)
{
  std::string text = tetrahedron_of_ten(3, true);
  // The first two nodes exchanged, and the middle nodes of the edges with them.
  const std::string element = "1, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10";
  text.replace(text.find(element), element.size(), "1, 2, 1, 3, 4, 5, 7, 6, 9, 8, 10");
  const SimplexMesh mesh = read_text(".inp", text);
  expect_sound(mesh);
  ASSERT_EQ(mesh.edge_midpoints.size(), 1u);
  EXPECT_EQ(mesh.edge_midpoints.begin()->second, (Triple{.125, 0., .5}));
}

TEST(MeshFile, BrokenMeshesAreRefused)
{
  struct Case
  {
    std::vector<std::string> nodes, elements;
    std::string message;
  };
  std::vector<std::string> off = nodes, not_a_number = nodes;
  off[4] = ".3 .4 .3";
  not_a_number[4] = "nan 1 1";
  const std::vector<std::string> both{first, "4 2 1 1 2 3 4 5"};
  const std::vector<Case> cases{
      {nodes, {first, "4 2 1 1 3 2 4 5"}, "cell 2 at (0.5, 0.5, 0.5): a cell is inverted"},
      {off, both, "cell 2 at (0.325, 0.35, 0.325): a cell has no volume"},
      {nodes, {first, "4 2 1 1 2 3 4 4"}, "cell 2 at (0.25, 0.25, 0.5): a cell has the same node twice"},
      {with(nodes, "1 0 0"), {first, "4 2 1 1 6 3 4 5"}, "1 pair, for example at (1, 0, 0)"},
      {nodes, with(both, "4 2 1 1 1 2 3 4"), "cells 1 and 3 have the same corners"},
      {with(nodes, "2 2 2"), with(both, "4 2 1 1 2 3 4 6"), "3 cells, the second and third are cell 2"},
      {not_a_number, both, "no finite number"},
      {nodes, {skin}, "there is no tetrahedron"},
      {nodes, with(both, "6 2 1 1 1 2 3 4 5 5"), "Prism"},
      {nodes, {first, "4 2 1 1 2 3 4 9"}, "cannot be understood"},
      {nodes, {skin, "2 2 3 2 2 3 1", first}, "a face belongs to two boundaries"}};
  for (const Case &broken : cases)
    EXPECT_NE(refusal(".msh", msh_text(broken.nodes, broken.elements)).find(broken.message),
              std::string::npos)
        << broken.message << "\nbut:\n"
        << refusal(".msh", msh_text(broken.nodes, broken.elements));
  EXPECT_NE(refusal(".msh", msh_text(nodes, both), 2).find("three-dimensional"), std::string::npos);
  EXPECT_NE(refusal(".msh", msh_text({"0 0 0", "1 0 0", "0 1 .1"}, {"2 2 1 1 1 2 3"}), 2).find("plane z = 0"),
            std::string::npos);
}

TEST(MeshFile, FoldedQuadraticCellsAreRefused)
{
  std::string text = tetrahedron_of_ten(0, true);
  EXPECT_EQ(refusal(".inp", text), "");
  text.replace(text.find("0.625000"), 8, "0.850000"); // beyond three quarters of the edge
  EXPECT_NE(refusal(".inp", text).find("folded"), std::string::npos);
  // Sound at its corners, folded between them.
  const std::vector<std::string> six{"0 0 0", "1 0 0", "0 1 0", ".7 -.3 0", ".1 .1 0", "-.3 .9 0"};
  EXPECT_NE(refusal(".msh", msh_text(six, {"9 2 1 1 1 2 3 4 5 6"}), 2).find("folded"), std::string::npos);
}

TEST(MeshFile, BrokenTextIsRefused)
{
  const std::string good = msh_text(nodes, {first, second});
  const auto refused_as = [](const std::string &ending, const std::string &text, const std::string &message)
  {
    EXPECT_NE(refusal(ending, text).find(message), std::string::npos) << message << "\nbut:\n"
                                                                      << refusal(ending, text);
  };
  refused_as(".msh", "", "is empty");
  refused_as(".msh", "SystemCall \"false\";", "no mesh file");
  refused_as(".msh", good.substr(0, good.size() - 25), "no $EndElements");
  refused_as(".msh", good.substr(0, 150), "cut off");
  refused_as(".vtk", std::string(vtk).substr(0, 150), "cannot be understood");
  std::string text = good;
  text.replace(text.find("$Elements\n2"), 11, "$Elements\n1"); // Gmsh would leave out the second
  refused_as(".msh", text, "not as many entries");
  text = good;
  text.replace(text.find("$Nodes\n5"), 8, "$Nodes\n4"); // Gmsh would fall over
  refused_as(".msh", text, "not as many entries");
  text = good;
  text.replace(text.find("\n5 1 1 1"), 8, "\n4 1 1 1");
  refused_as(".msh", text, "node 4");
  EXPECT_THROW(read_mesh_file("/there/is/no.msh", 3), FileError);
  EXPECT_THROW(read_mesh_file("/tmp", 3), FileError);
}
