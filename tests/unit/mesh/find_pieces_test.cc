// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/mesh/find_pieces.h"

#include <gtest/gtest.h>

using namespace signorini;

TEST(FindPieces, CellsHangTogetherByCommonVertices)
{
  SimplexMesh mesh;
  mesh.dimension = 2;
  for (unsigned int v = 0; v < 9; ++v)
    mesh.vertices.push_back({v % 3 + 10. * (v / 3), v % 3 == 2 ? 1. : 0., 0.});
  // A single cell, then two that share only vertex 5.
  mesh.cells = {{0, 1, 2}, {3, 4, 5}, {7, 6, 5}};
  const std::vector<MeshPiece> pieces = find_pieces(mesh);
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_EQ(pieces[0].n_cells, 2u);
  EXPECT_EQ(pieces[1].n_cells, 1u);
  EXPECT_NEAR(pieces[1].place[0], 1., 1e-15);
  EXPECT_NEAR(pieces[1].place[1], 1. / 3., 1e-15);

  mesh.cells.push_back({8, 2, 6}); // joins both
  EXPECT_EQ(find_pieces(mesh).size(), 1u);
}
