// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/base/triple.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace signorini
{
/// A mesh of tetrahedra (triangles in 2-D) as it comes from a file or a mesh generator: plain arrays, in the
/// coordinates of one body. Conforming; every cell has positive volume with its vertices in order,
/// det(x_1 − x_0, x_2 − x_0, x_3 − x_0) > 0.
struct SimplexMesh
{
  /// One outer face: an edge in 2-D.
  struct Face
  {
    std::array<unsigned int, 3> vertices{}; ///< the first `dimension` count
    unsigned int boundary = 0;              ///< index into `boundary_names`

    template <typename Archive>
    void serialize(Archive &archive, unsigned int)
    {
      archive &vertices &boundary;
    }
  };

  unsigned int dimension = 3;
  std::vector<Triple> vertices;                   ///< [m]
  std::vector<std::array<unsigned int, 4>> cells; ///< of each, the first dimension + 1 count
  std::vector<unsigned int> regions;              ///< [cell] → index into `region_names`
  std::vector<Face> faces;                        ///< all outer ones, each once
  std::vector<std::string> region_names;
  std::vector<std::string> boundary_names;

  /// Middle nodes of the curved edges, by their end vertices (the smaller first) [m]; the other edges are
  /// straight.
  std::map<std::pair<unsigned int, unsigned int>, Triple> edge_midpoints;

  /// For Boost's archives, by which ranks send meshes to each other.
  template <typename Archive>
  void serialize(Archive &archive, unsigned int)
  {
    archive &dimension &vertices &cells &regions &faces &region_names &boundary_names &edge_midpoints;
  }
};
} // namespace signorini
