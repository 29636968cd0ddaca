// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh_text.h"

using namespace signorini;
using namespace signorini::test;

namespace
{
const std::string head = R"(*HEADING
 ** no comment, but part of the heading
** a comment
*Node, NSET=ALL
 1, 0., 0., 0.
 2, 1., 0., 0.
 3, 0., 1., 0.
 4, 0., 0., 1.
 5, 1., 1., 1.
)";

const std::string both = head + R"(*ELEMENT, Type=C3D4,
 ELSET=Body
10, 1, 2, 3,
4
20, 2, 3, 4, 5
*Solid section, elset=Body, material=steel
*Elset, elset=half, generate
 20, 30, 10
)";
} // namespace

TEST(AbaqusFile, SurfacesAndSetsAreNames)
{
  const SimplexMesh mesh = read_text(".inp", both + R"(*Surface, name=Floor, type=element
 10, S1
*NSET, NSET=roof
 4, 3
 5
*elset, ELSET=other
half, 10
*Nset, nset=overlapping
roof, 2
*STEP
*STATIC
)");
  expect_sound(mesh);
  EXPECT_EQ(mesh.cells.size(), 2u);
  EXPECT_NEAR(volume_of(mesh), .5, 1e-15);
  EXPECT_EQ(mesh.region_names, (std::vector<std::string>{"half", "other", "Body"}));
  EXPECT_EQ(mesh.regions, (std::vector<unsigned int>{1, 0}));
  // The set of all nodes is no boundary, nor one whose faces have a name.
  EXPECT_EQ(mesh.boundary_names, (std::vector<std::string>{"Floor", "roof", "rest"}));
  EXPECT_EQ(n_faces(mesh), (std::vector<std::size_t>{1, 1, 4}));
  for (const SimplexMesh::Face &face : mesh.faces)
    for (const unsigned int vertex : face.vertices)
    {
      EXPECT_TRUE(face.boundary != 0 || mesh.vertices[vertex][2] == 0.);
    }
}

TEST(AbaqusFile, TheSetOfAllNodesIsNoBoundary)
{
  EXPECT_EQ(read_text(".inp", both).boundary_names, std::vector<std::string>{"rest"});
  EXPECT_EQ(read_text(".inp", both + "*NSET, NSET=floor\n1, 2, 3\n").boundary_names,
            (std::vector<std::string>{"floor", "rest"}));
}

TEST(AbaqusFile, FacesOfElementsAreNumberedAsThere)
{
  // S1 to S4 of the first tetrahedron: the plane each lies in.
  const std::vector<Triple> normals{{0., 0., 1.}, {0., 1., 0.}, {1., 1., 1.}, {1., 0., 0.}};
  for (unsigned int side = 0; side < 4; ++side)
  {
    const SimplexMesh mesh =
        read_text(".inp", head + "*ELEMENT, TYPE=C3D4\n10, 1, 2, 3, 4\n*SURFACE, NAME=side\n10, S" +
                              std::to_string(side + 1) + "\n");
    ASSERT_EQ(mesh.boundary_names.front(), "side");
    for (const SimplexMesh::Face &face : mesh.faces)
      if (face.boundary == 0)
        for (const unsigned int vertex : face.vertices)
        {
          const Triple &x = mesh.vertices[vertex];
          EXPECT_EQ(x[0] * normals[side][0] + x[1] * normals[side][1] + x[2] * normals[side][2],
                    side == 2 ? 1. : 0.);
        }
  }
}

TEST(AbaqusFile, FaceElementsAreBoundaries)
{
  const SimplexMesh mesh = read_text(".inp", both + R"(*ELEMENT, TYPE=S3, ELSET=Surface1
30, 1, 2, 3
31, 3, 4, 5
*ELEMENT, TYPE=T3D2, ELSET=Lines
40, 1, 2
*ELSET, ELSET=Floor
30
*ELSET, ELSET=Roof
31
)");
  EXPECT_EQ(mesh.cells.size(), 2u);
  EXPECT_EQ(mesh.boundary_names, (std::vector<std::string>{"Floor", "Roof", "rest"}));
}

TEST(AbaqusFile, TwoDimensions)
{
  const SimplexMesh mesh = read_text(".inp", R"(*NODE
1, 0, 0
2, 1, 0
3, 0, 1
4, 1, 1
*ELEMENT, TYPE=CPE3, ELSET=sheet
1, 1, 2, 3
2, 2, 4, 3
*SURFACE, NAME=outside
sheet
)",
                                     2);
  expect_sound(mesh);
  EXPECT_NEAR(volume_of(mesh), 1., 1e-15);
  EXPECT_EQ(mesh.boundary_names, std::vector<std::string>{"outside"});
  EXPECT_EQ(mesh.faces.size(), 4u);
}

TEST(AbaqusFile, BrokenTextIsRefusedWithItsLine)
{
  const auto refused_as = [](const std::string &text, const std::string &message)
  {
    EXPECT_NE(refusal(".inp", text).find(message), std::string::npos) << message << "\nbut:\n"
                                                                      << refusal(".inp", text);
  };
  refused_as("", "no elements");
  refused_as(both + "*ELEMENT, TYPE=C3D8\n1,2,3,4,5,1,2,3,4\n",
             ".inp:18: the mesh has elements that are no simplices");
  refused_as(both + "*INCLUDE, INPUT=other.inp\n", "*INCLUDE is not followed");
  refused_as(both + "*SURFACE, NAME=a\n10, S5\n", "S1 to S4");
  refused_as(both + "*SURFACE, NAME=a\nnone, S1\n", "no set of elements of this name");
  refused_as(both + "*NSET, NSET=a\n99\n", "no node of this number");
  refused_as(both + "*ELEMENT, TYPE=C3D4\n10, 1, 2, 3, 4\n", "element 10");
  refused_as(both + "*ELEMENT, TYPE=C3D4\n11, 1, 2, 3, 7\n", "node 7");
  refused_as(both + "*ELEMENT, TYPE=C3D4\n11, 1, 2, 3", "cut off");
  refused_as(both + "*ELEMENT, TYPE=C3D4\n11, 1, 2, 3\n*STEP\n", "an element lacks nodes");
  refused_as(both + "*NODE\n5, 0, 0, 0\n", "node 5");
  refused_as(both + "*NODE\n6, 0, zero, 0\n", "no coordinate");
  refused_as(both + "*PART, NAME=a\n*PART, NAME=b\n", "several parts");
  refused_as(both + "*INSTANCE, NAME=a\n1, 0, 0\n", "moved by its instance");
  refused_as(both + "*SURFACE, NAME=a\n10, S1\n*SURFACE, NAME=b\nBody\n", "a face belongs to two boundaries");
}
