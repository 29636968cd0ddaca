// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/mesh/read_mesh_file.h"

#include "signorini/mesh/abaqus_file.h"
#include "signorini/mesh/file_content.h"
#include "signorini/mesh/gmsh_model.h"
#include "signorini/mesh/make_simplex_mesh.h"

#include <algorithm>

namespace signorini
{
namespace
{
FileMesh read_unchecked(const std::string &path, const unsigned int dimension)
{
  return ending_of(path) == ".inp" ? read_abaqus_file(path, dimension) : read_gmsh_file(path, dimension);
}
} // namespace

std::vector<std::string> mesh_file_endings()
{
  return {".msh", ".vtk", ".inp"};
}

bool is_mesh_file(const std::string &path)
{
  const std::vector<std::string> endings = mesh_file_endings();
  return std::find(endings.begin(), endings.end(), ending_of(path)) != endings.end();
}

SimplexMesh read_mesh_file(const std::string &path, const unsigned int dimension,
                           const std::vector<std::string> &regions)
{
  return make_simplex_mesh(read_unchecked(path, dimension), regions);
}

std::size_t count_nodes_in_set(const std::string &path, const unsigned int dimension, const std::string &name)
{
  std::size_t n_nodes = 0;
  for (const FileMesh::Boundary &boundary : read_unchecked(path, dimension).boundaries)
    if (boundary.name == name)
      n_nodes += boundary.nodes.size();
  return n_nodes;
}
} // namespace signorini
