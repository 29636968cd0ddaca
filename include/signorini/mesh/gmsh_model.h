// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/mesh/file_mesh.h"
#include "signorini/mesh/gmsh_session.h"

#include <functional>
#include <string>

namespace signorini
{
/// Length of edges [m] at a point.
using SizeField = std::function<double(const Triple &)>;

/// Meshes Gmsh's model up to a dimension; edges have about the length that `size` gives, at the boundary;
/// inside they are up to 1.3 times as long. `file` is for messages. Throws InputError if Gmsh gives up.
void make_gmsh_mesh(const GmshSession &gmsh, const std::string &file, unsigned int dimension,
                    const SizeField &size);

/// The mesh in Gmsh's current model: cells by physical groups of the dimension, faces by those of one less;
/// groups without a name are called by their number. Throws InputError for cells that are no simplices, or of
/// a higher dimension. Needs a GmshSession. `file` is for messages.
FileMesh take_gmsh_mesh(const std::string &file, unsigned int dimension);

/// Reads a file in one of Gmsh's formats or legacy VTK.
FileMesh read_gmsh_file(const std::string &path, unsigned int dimension);
} // namespace signorini
