// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/adaptivity/error_estimate.h"
#include "signorini/discretization/discretization.h"
#include "signorini/discretization/scene_mesh.h"

namespace signorini
{
/// New meshes of all bodies of tetrahedra by an error estimate (collective): cells with large errors (see
/// ErrorClasses) get edges of half their length, those with small ones of twice it, but no longer than
/// coarsest_size(), the others keep theirs. The size is continuous and grows by no more than the way gone.
/// What comes from a mesh file, whose shape is not known beyond the mesh, stays as it is.
///
/// Where contact goes unseen only the cells there are refined, as mark_cells() does.
template <int dim>
std::vector<PlacedSimplexMesh>
make_adapted_meshes(const ErrorEstimate &estimate, const AdaptivityParameters &adaptivity,
                    const std::vector<BodyParameters> &bodies, const Discretization<dim> &discretization);
} // namespace signorini
