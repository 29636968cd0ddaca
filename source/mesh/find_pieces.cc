// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/mesh/find_pieces.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace signorini
{
std::vector<MeshPiece> find_pieces(const SimplexMesh &mesh)
{
  std::vector<unsigned int> leader(mesh.vertices.size());
  std::iota(leader.begin(), leader.end(), 0u);
  const auto find_leader = [&leader](unsigned int vertex)
  {
    while (leader[vertex] != vertex)
      vertex = leader[vertex] = leader[leader[vertex]];
    return vertex;
  };
  const unsigned int n_corners = mesh.dimension + 1;
  for (const auto &cell : mesh.cells)
    for (unsigned int v = 1; v < n_corners; ++v)
      leader[find_leader(cell[v])] = find_leader(cell[0]);

  std::map<unsigned int, std::size_t> piece_of; // by its leader
  std::vector<MeshPiece> pieces;
  for (const auto &cell : mesh.cells)
  {
    const auto [found, is_new] = piece_of.emplace(find_leader(cell[0]), pieces.size());
    if (is_new)
    {
      pieces.emplace_back();
      for (unsigned int v = 0; v < n_corners; ++v)
        for (unsigned int c = 0; c < 3; ++c)
          pieces.back().place[c] += mesh.vertices[cell[v]][c] / n_corners;
    }
    ++pieces[found->second].n_cells;
  }
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const MeshPiece &a, const MeshPiece &b) { return a.n_cells > b.n_cells; });
  return pieces;
}
} // namespace signorini
