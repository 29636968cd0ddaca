// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/discretization/cut_box.h"

#include "signorini/parameters/mesh_parameters.h"

#include <algorithm>
#include <numeric>

namespace signorini
{
namespace
{
using Lattice = std::array<unsigned int, 3>;

/// Blocks in each direction; none in the third of two dimensions.
Lattice count_blocks(const MeshParameters &parameters, unsigned int dimension)
{
  Lattice n{};
  for (unsigned int d = 0; d < dimension; ++d)
    n[d] = parameters.cells[d] << parameters.refinements;
  return n;
}

unsigned int vertex_at(const Lattice &at, const Lattice &n)
{
  return at[0] + (n[0] + 1) * (at[1] + (n[1] + 1) * at[2]);
}

template <typename Visit>
void for_each_point(const Lattice &end, const Visit &visit)
{
  for (unsigned int k = 0; k < end[2]; ++k)
    for (unsigned int j = 0; j < end[1]; ++j)
      for (unsigned int i = 0; i < end[0]; ++i)
        visit(Lattice{i, j, k});
}

/// The way from a block's lower corner to the upper one along the axes in every order.
void add_cells(const Lattice &n, SimplexMesh &mesh)
{
  const unsigned int dimension = mesh.dimension;
  std::vector<unsigned int> axes(dimension);
  std::iota(axes.begin(), axes.end(), 0);
  do
  {
    unsigned int n_inversions = 0;
    for (unsigned int b = 0; b < dimension; ++b)
      for (unsigned int a = 0; a < b; ++a)
        n_inversions += axes[a] > axes[b] ? 1 : 0;
    for_each_point({n[0], n[1], std::max(1u, n[2])},
                   [&](Lattice at)
                   {
                     std::array<unsigned int, 4> cell{};
                     cell[0] = vertex_at(at, n);
                     for (unsigned int v = 0; v < dimension; ++v)
                     {
                       ++at[axes[v]];
                       cell[v + 1] = vertex_at(at, n);
                     }
                     if (n_inversions % 2 == 1)
                       std::swap(cell[0], cell[1]);
                     mesh.cells.push_back(cell);
                   });
  } while (std::next_permutation(axes.begin(), axes.end()));
}

/// The faces whose vertices all lie at an end of the lattice: boundary 2 axis, or 2 axis + 1 at the upper
/// end.
void add_faces(const std::vector<Lattice> &points, const Lattice &n, SimplexMesh &mesh)
{
  for (const auto &cell : mesh.cells)
    for (unsigned int opposite = 0; opposite <= mesh.dimension; ++opposite)
    {
      SimplexMesh::Face face;
      for (unsigned int v = 0, i = 0; v <= mesh.dimension; ++v)
        if (v != opposite)
          face.vertices[i++] = cell[v];
      for (unsigned int axis = 0; axis < mesh.dimension; ++axis)
        for (const bool is_upper : {false, true})
          if (std::all_of(face.vertices.begin(), face.vertices.begin() + mesh.dimension,
                          [&](unsigned int v) { return points[v][axis] == (is_upper ? n[axis] : 0); }))
          {
            face.boundary = 2 * axis + (is_upper ? 1 : 0);
            mesh.faces.push_back(face);
          }
    }
}
} // namespace

SimplexMesh make_cut_box(const MeshParameters &parameters, unsigned int dimension)
{
  const Lattice n = count_blocks(parameters, dimension);
  SimplexMesh mesh;
  mesh.dimension = dimension;
  mesh.region_names = {"box"};
  mesh.boundary_names = boundary_names(parameters, dimension);
  std::vector<Lattice> points;
  for_each_point({n[0] + 1, n[1] + 1, n[2] + 1}, [&](const Lattice &at) { points.push_back(at); });
  for (const Lattice &at : points)
  {
    Triple x{};
    for (unsigned int d = 0; d < dimension; ++d)
    {
      const double share = static_cast<double>(at[d]) / n[d];
      x[d] = (1. - share) * parameters.lower_corner[d] + share * parameters.upper_corner[d];
    }
    mesh.vertices.push_back(x);
  }
  add_cells(n, mesh);
  mesh.regions.assign(mesh.cells.size(), 0);
  add_faces(points, n, mesh);
  return mesh;
}
} // namespace signorini
