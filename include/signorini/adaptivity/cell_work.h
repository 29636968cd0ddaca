// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/adaptivity/boundary_faces.h"
#include "signorini/solvers/scene_forces.h"

namespace signorini
{
/// Work of each own cell: 1000 for its part of the elasticity, and more for every contact pair that its
/// faces, or simplices, had when `forces` were renewed last (doc/theory.md, section 11).
template <int dim>
std::vector<unsigned int> find_cell_work(const Discretization<dim> &discretization,
                                         const std::vector<BoundaryFace<dim>> &faces,
                                         const SceneForces<dim> &forces);
} // namespace signorini
