// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/adaptivity/boundary_faces.h"

namespace signorini
{
/// Flags further cells, after mark_cells(), where hanging nodes would kink a curved surface under contact
/// pressure: a hanging node lies in the middle of the straight edge that it hangs on, deeper in the body than
/// its neighbours by the sagitta s of the edge, and the pressure there is wrong by about 4 E s/h. Cells for
/// which that is more than a twentieth of the largest pressure, and which touch each other, get one level.
/// `pressures` are those of contact (collective).
template <int dim>
void level_curved_contact(const std::vector<BoundaryFace<dim>> &faces, const NodalPressures<dim> &pressures,
                          const SurfaceMap<dim> &map, Discretization<dim> &discretization);
} // namespace signorini
