// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/mesh/simplex_mesh.h"
#include "signorini/parameters/parameters.h"

namespace signorini
{
/// A box of `cells` blocks in each direction, halved by every refinement, each block cut into 6 tetrahedra (2
/// triangles) along the same diagonal, so that neighbours agree (H. W. Kuhn, 1960). Heights over outer faces
/// are the edges of the blocks. Boundaries as boundary_names() has them.
SimplexMesh make_cut_box(const MeshParameters &parameters, unsigned int dimension);
} // namespace signorini
