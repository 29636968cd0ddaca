// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/mesh/file_mesh.h"
#include "signorini/mesh/simplex_mesh.h"

#include <string>
#include <vector>

namespace signorini
{
/// The regions of these names, in their order; all for no names. Throws InputError for a name that the file
/// does not have.
std::vector<FileMesh::Region> choose_regions(const FileMesh &mesh, const std::vector<std::string> &chosen);

/// Checks the chosen regions (none: all cells) and puts them in order: nodes that no cell has are left out, a
/// block of cells all of which are inverted is turned, outer faces are found and named. Throws InputError for
/// anything that is no sound mesh.
SimplexMesh make_simplex_mesh(const FileMesh &mesh, const std::vector<std::string> &regions);
} // namespace signorini
