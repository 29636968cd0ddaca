// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/adaptivity/error_estimate.h"
#include "signorini/discretization/discretization.h"

namespace signorini
{
/// Flags hexahedra for refinement and coarsening by the discretisation error of the whole scene, see
/// ErrorClasses: the contact part falls with the penalty factor, not with the cells. While some cells are too
/// large to see the contact they are in, only these are refined (collective).
template <int dim>
void mark_cells(const ErrorEstimate &estimate, const AdaptivityParameters &parameters,
                Discretization<dim> &discretization);
} // namespace signorini
