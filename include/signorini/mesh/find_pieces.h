// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/mesh/simplex_mesh.h"

#include <cstddef>
#include <vector>

namespace signorini
{
/// Cells that hang together by common vertices.
struct MeshPiece
{
  std::size_t n_cells = 0;
  Triple place{}; ///< the mean of the corners of its first cell [m]
};

/// All pieces of a mesh, the largest first; a sound body is one.
std::vector<MeshPiece> find_pieces(const SimplexMesh &mesh);
} // namespace signorini
