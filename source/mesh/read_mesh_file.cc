// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/mesh/read_mesh_file.h"

#include "signorini/mesh/abaqus_file.h"
#include "signorini/mesh/file_content.h"
#include "signorini/mesh/gmsh_model.h"
#include "signorini/mesh/make_simplex_mesh.h"

#include <algorithm>

namespace signorini
{
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
  return make_simplex_mesh(ending_of(path) == ".inp" ? read_abaqus_file(path, dimension)
                                                     : read_gmsh_file(path, dimension),
                           regions);
}
} // namespace signorini
