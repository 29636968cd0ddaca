// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/discretization/contact_surface.h"

#include <Eigen/Geometry>

namespace signorini::contact
{
template <int dim>
using BoundingBox = Eigen::AlignedBox<double, dim>;

/// A box that holds the whole facet, not only its nodes: that of its Bernstein control points.
template <int dim>
BoundingBox<dim> make_facet_box(const Facet<dim> &facet, const std::vector<SpatialVector<dim>> &positions);
} // namespace signorini::contact
