// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/mesh/read_mesh_file.h"

#include "signorini/base/exceptions.h"
#include "signorini/mesh/abaqus_file.h"
#include "signorini/mesh/gmsh_model.h"
#include "signorini/mesh/make_simplex_mesh.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>

namespace signorini
{
namespace
{
std::string ending_of(const std::string &path)
{
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](const unsigned char character) { return std::tolower(character); });
  return ending;
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
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored) || !std::ifstream(path))
    throw FileError(
        Complaint("the mesh file cannot be read")
            .at(path)
            .advise("give the name of an existing file; it is looked for beside the parameter file"));
  return make_simplex_mesh(ending_of(path) == ".inp" ? read_abaqus_file(path, dimension)
                                                     : read_gmsh_file(path, dimension),
                           regions);
}
} // namespace signorini
