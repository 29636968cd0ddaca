// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/parameters/declarations.h"
#include "signorini/parameters/parameters.h"

#include <string>
#include <vector>

namespace signorini
{
/// Declare `Mesh` of a body, with the keys that belong to its shape.
void declare_mesh(Declarations &declarations, const DeclarationScope &scope, const std::string &path);

/// Read and check it, with the file that it names. Throws InputError, FileError.
MeshParameters read_mesh(const ParameterText &text, const Declarations &in_use, const std::string &path,
                         unsigned int dimension);

/// Whether `Adaptivity` can change a mesh: tetrahedra are not refined one by one, their meshes are made anew,
/// between equilibria and from a known shape.
bool is_adaptable(const MeshParameters &mesh, bool is_in_motion);

/// Names of the boundaries of a mesh, as Support, Load and Grading use them.
std::vector<std::string> boundary_names(const MeshParameters &mesh, unsigned int dimension);

/// Points that bound one boundary of a mesh, before placement.
std::vector<Triple> boundary_points(const MeshParameters &mesh, unsigned int dimension,
                                    const std::string &boundary);

/// Longest side of the box around the shape, before placement [m].
double largest_extent(const MeshParameters &mesh, unsigned int dimension);
} // namespace signorini
