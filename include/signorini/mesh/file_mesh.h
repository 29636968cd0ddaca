// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/base/triple.h"

#include <array>
#include <string>
#include <vector>

namespace signorini
{
/// What a mesh file says, or a mesh generator has made, before it is checked. Only tetrahedra and triangles
/// in three dimensions, triangles and edges in two.
struct FileMesh
{
  /// Corners first; of a quadratic cell then the middle nodes of the edges 01, 12, 20, in 3-D 03, 13, 23.
  struct Cell
  {
    std::array<unsigned int, 10> nodes{};
    unsigned int n_nodes = 0;
    unsigned int block = 0; ///< cells of one block are numbered in the same sense
    std::size_t number = 0; ///< in the file
  };
  using FaceVertices = std::array<unsigned int, 3>; ///< the first `dimension` count, the rest is 0

  struct Region
  {
    std::string name;
    std::vector<unsigned int> cells; ///< may belong to other regions as well
  };

  /// A set of faces, inner ones too, or of nodes, which stands for the outer faces all of whose vertices are
  /// in it.
  struct Boundary
  {
    std::string name;
    std::vector<FaceVertices> faces;
    std::vector<unsigned int> nodes;
    bool is_surface =
        true; ///< else a set made for some other purpose: names a boundary if no face is named yet
  };

  std::string file; ///< for messages
  unsigned int dimension = 3;
  std::vector<Triple> nodes; ///< [m]
  std::vector<Cell> cells;
  std::vector<Region> regions;
  std::vector<Boundary> boundaries; ///< the first that has a face has the better claim to it

  unsigned int n_corners() const { return dimension + 1; }
};

/// Local numbers of the end vertices of the edges of a tetrahedron, in the order of the middle nodes above;
/// a triangle has the first three.
constexpr std::array<std::array<unsigned int, 2>, 6> edges_of_cell{
    {{{0, 1}}, {{1, 2}}, {{2, 0}}, {{0, 3}}, {{1, 3}}, {{2, 3}}}};
} // namespace signorini
