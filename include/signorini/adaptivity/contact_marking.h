// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/adaptivity/boundary_faces.h"

namespace signorini
{
/// Flags further cells, after mark_cells(), where hanging nodes would kink a curved surface under contact
/// pressure: a hanging node of degree 1 lies in the middle of the straight edge that it hangs on, deeper in
/// the body than its neighbours by the sagitta s of the edge; it moves with the edge and cannot yield, so
/// that the pressure there is wrong by up to k_A s = α E s/h. At degree 2 the edge bends with the surface,
/// but k_A jumps there, which costs about as much as 4 E s/h. Cells for which that is more than a tenth
/// (degree 2: a twentieth) of the largest pressure, and which touch each other, get one level, with those
/// around them, where contact may reach next. `pressures` are those of contact (collective).
template <int dim>
void level_curved_contact(const std::vector<BoundaryFace<dim>> &faces, const NodalPressures<dim> &pressures,
                          double penalty_factor, const SurfaceMap<dim> &map,
                          Discretization<dim> &discretization);
} // namespace signorini
