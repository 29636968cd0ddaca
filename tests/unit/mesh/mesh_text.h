// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/base/exceptions.h"
#include "signorini/mesh/read_mesh_file.h"
#include "signorini/mesh/simplex_geometry.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <numeric>
#include <string>
#include <vector>

namespace signorini::test
{
/// A file that is there as long as the object.
class TemporaryFile
{
public:
  TemporaryFile(const std::string &ending, const std::string &content)
      : path((std::filesystem::temp_directory_path() / ("signorini_" + std::to_string(getpid()) + ending))
                 .string())
  {
    std::ofstream(path, std::ios::binary) << content;
  }
  ~TemporaryFile() { std::filesystem::remove(path); }
  TemporaryFile(const TemporaryFile &) = delete;
  TemporaryFile &operator=(const TemporaryFile &) = delete;

  const std::string path;
};

inline SimplexMesh read_text(const std::string &ending, const std::string &content,
                             unsigned int dimension = 3, const std::vector<std::string> &regions = {})
{
  return read_mesh_file(TemporaryFile(ending, content).path, dimension, regions);
}

/// What the file is refused with; empty if it is not.
inline std::string refusal(const std::string &ending, const std::string &content, unsigned int dimension = 3,
                           const std::vector<std::string> &regions = {})
{
  try
  {
    read_text(ending, content, dimension, regions);
  }
  catch (const InputError &error)
  {
    return error.what();
  }
  return "";
}

/// Gmsh's format 2.2 of numbered lines; elements are given as "type 2 GROUP ENTITY nodes".
inline std::string msh_text(const std::vector<std::string> &nodes, const std::vector<std::string> &elements)
{
  std::string text =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n2 2 \"skin\"\n3 1 \"core\"\n3 4 \"shell\"\n"
      "$EndPhysicalNames\n";
  const auto append = [&text](const std::string &name, const std::vector<std::string> &lines)
  {
    text += "$" + name + "\n" + std::to_string(lines.size()) + "\n";
    for (std::size_t line = 0; line < lines.size(); ++line)
      text += std::to_string(line + 1) + " " + lines[line] + "\n";
    text += "$End" + name + "\n";
  };
  append("Nodes", nodes);
  append("Elements", elements);
  return text;
}

inline std::array<Triple, 4> corners_of(const SimplexMesh &mesh, const std::size_t cell)
{
  std::array<Triple, 4> corners{};
  for (unsigned int v = 0; v <= mesh.dimension; ++v)
    corners[v] = mesh.vertices.at(mesh.cells.at(cell)[v]);
  return corners;
}

inline double volume_of(const SimplexMesh &mesh)
{
  double volume = 0.;
  for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
    volume += determinant(corners_of(mesh, cell), mesh.dimension) / (mesh.dimension == 3 ? 6. : 2.);
  return volume;
}

inline std::vector<std::size_t> n_faces(const SimplexMesh &mesh)
{
  std::vector<std::size_t> counts(mesh.boundary_names.size(), 0);
  for (const SimplexMesh::Face &face : mesh.faces)
    ++counts.at(face.boundary);
  return counts;
}

/// Each cell with positive volume, and as many outer faces as there must be.
inline void expect_sound(const SimplexMesh &mesh)
{
  for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
    EXPECT_GT(determinant(corners_of(mesh, cell), mesh.dimension), 0.);
  EXPECT_EQ(mesh.regions.size(), mesh.cells.size());
  for (const unsigned int region : mesh.regions)
    EXPECT_LT(region, mesh.region_names.size());
  for (const std::size_t count : n_faces(mesh))
    EXPECT_GT(count, 0u);
}
} // namespace signorini::test
