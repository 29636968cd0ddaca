// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/discretization/size_field.h"
#include "signorini/mesh/simplex_mesh.h"
#include "signorini/parameters/parameters.h"

namespace signorini
{
/// Measured: so many cells Gmsh makes in a cube (square) of the edge length that it is asked for.
constexpr double n_cells_of_cube(unsigned int dimension)
{
  return dimension == 3 ? 4.6 : 2.3;
}

/// A mesh of tetrahedra (triangles) of a box, ball or cylinder, or of the shape in a file, made by Gmsh: the
/// same in every run. Boundaries are named as boundary_names() says.
///
/// `size`: length of edges [m] at a point in own coordinates, all finite and positive. `degree` 2: edges at
/// curved boundaries have their middle nodes there, but for cells that this would fold: their edges stay
/// straight. Throws InputError if Gmsh cannot mesh the shape, FileError.
SimplexMesh generate_simplex_mesh(const MeshParameters &parameters, unsigned int dimension,
                                  unsigned int degree, const SizeField &size);

/// The mesh of a body of tetrahedra as its parameters say: that of its mesh file, a cut box
/// (see make_cut_box()), or one made by Gmsh.
SimplexMesh make_simplex_body_mesh(const MeshParameters &parameters, unsigned int dimension,
                                   unsigned int degree);
} // namespace signorini
