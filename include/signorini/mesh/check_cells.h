// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/mesh/file_mesh.h"

namespace signorini
{
/// Throws InputError, with number and centre of a cell, for the first of: coordinates that are not finite
/// (or, in 2-D, off the plane z = 0), a cell with a node twice, two nodes at the same place, the same cell
/// twice, no volume, inverted cells among others of their block, a quadratic cell that is folded. Turns the
/// cells of a block all of which are inverted. All nodes must belong to cells.
void check_cells(FileMesh &mesh);

/// "cell 17 at (0.5, 0, 1)", by the number in the file and the mean of the corners.
std::string describe_cell(const FileMesh &mesh, const FileMesh::Cell &cell);
} // namespace signorini
