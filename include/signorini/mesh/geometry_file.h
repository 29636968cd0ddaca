// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/mesh/gmsh_session.h"
#include "signorini/mesh/simplex_mesh.h"

#include <string>
#include <vector>

namespace signorini
{
/// Endings of the names of files that hold a shape but no mesh of its inside, with their dot: STEP, BREP,
/// STL.
std::vector<std::string> geometry_file_endings();

/// Whether the name has such an ending, in upper or lower case.
bool is_geometry_file(const std::string &path);

/// Makes the shape in a file Gmsh's model, with a physical group for each region and boundary: volume_1, …,
/// and surface_1, … (2-D: surface_1, … and curve_1, …) by the numbers OpenCASCADE gives; STL: volume_1 and
/// surface. Returns the length of Gmsh's unit in own coordinates: STEP files carry their unit, and become
/// metres; BREP and STL files are taken as they are. Throws FileError, InputError.
double load_geometry(const GmshSession &gmsh, const std::string &path, unsigned int dimension);

/// The outer faces alone, without cells, meshed so finely that their shape is seen: names and rough distances
/// are taken from them. `regions` as in read_mesh_file(). Throws FileError, InputError.
SimplexMesh read_geometry_file(const std::string &path, unsigned int dimension,
                               const std::vector<std::string> &regions = {});
} // namespace signorini
