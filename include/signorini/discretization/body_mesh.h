// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/parameters/parameters.h"

#include <deal.II/grid/tria.h>

#include <functional>
#include <memory>

namespace signorini
{
/// The coarse hexahedral (quadrilateral) mesh of one body in its own coordinates. Faces carry the index of their
/// boundary's name in boundary_names() as boundary id; curved faces carry manifold id 0, all else is flat.
template <int dim>
void make_coarse_body_mesh(const MeshParameters &parameters, dealii::Triangulation<dim> &mesh);

/// Distance [m] of a point (own coordinates) from the named boundary of the shape.
template <int dim>
double distance_to_boundary(const MeshParameters &parameters, const std::string &boundary,
                            const dealii::Point<dim> &own);
} // namespace signorini
