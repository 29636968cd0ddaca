// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/mesh/file_mesh.h"

#include <string>

namespace signorini
{
/// Reads the mesh of an Abaqus (CalculiX) input file: *NODE, *ELEMENT, *ELSET, *NSET, *SURFACE; all other
/// keywords are passed over. Elements of one dimension less are faces. Surfaces name boundaries, then sets of
/// faces, then sets of nodes. Throws InputError with the line.
FileMesh read_abaqus_file(const std::string &path, unsigned int dimension);
} // namespace signorini
