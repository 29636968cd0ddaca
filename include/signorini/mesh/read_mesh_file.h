// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/mesh/simplex_mesh.h"

#include <string>
#include <vector>

namespace signorini
{
/// Endings of the names of mesh files, with their dot.
std::vector<std::string> mesh_file_endings();

/// Whether the name has such an ending, in upper or lower case.
bool is_mesh_file(const std::string &path);

/// Reads and checks a mesh of tetrahedra (triangles in 2-D, in the plane z = 0), linear or quadratic: Gmsh
/// (2.2 and 4.1), legacy VTK, Abaqus. `regions`: names of those that are the body; none: all cells.
///
/// Physical groups and element sets are regions; physical groups of faces, surfaces, sets of faces and of
/// nodes are boundaries. Outer faces that none of them names are the boundary "rest". Throws FileError if the
/// file cannot be read, InputError if it holds anything but a sound mesh of one body.
SimplexMesh read_mesh_file(const std::string &path, unsigned int dimension,
                           const std::vector<std::string> &regions = {});

/// Nodes in the set of this name, 0 if the file has none: what makes no boundary is left out of the mesh.
/// Throws as read_mesh_file().
std::size_t count_nodes_in_set(const std::string &path, unsigned int dimension, const std::string &name);
} // namespace signorini
