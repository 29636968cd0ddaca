// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/mesh/gmsh_model.h"
#include "signorini/parameters/parameters.h"

namespace signorini
{
/// Length of edges [m] that the parameters ask for in tetrahedra: the element size, halved by every
/// refinement; with a grading divided by 2^levels within its distance, and growing with the distance beyond,
/// so that twice the distance has twice the length. It grows by no more than the way gone. `parameters` is
/// copied.
SizeField make_size_field(const MeshParameters &parameters, unsigned int dimension);

/// Length of edges [m] of the mesh that the parameters refine: the element size, or of a cut box the longest
/// edge of its cells.
double coarsest_size(const MeshParameters &parameters, unsigned int dimension);
} // namespace signorini
