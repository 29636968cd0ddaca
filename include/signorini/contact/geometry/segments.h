// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/geometry/facet_shape.h"

#include <vector>

namespace signorini::contact
{
/// A point of integration on a facet.
template <int dim>
struct FacetQuadraturePoint
{
  LocalPoint<dim> xi;
  double weight = 0.; ///< measure of the facet's local domain that the point stands for
};

/// Gauss points of a whole facet, `n_points` a direction, exact for polynomials of degree 2·`n_points` − 1
/// (in each direction of a tensor product, in all of a triangle); weights sum to the local domain's measure,
/// 1 or ½.
template <int dim>
std::vector<FacetQuadraturePoint<dim>> make_gauss_points(FacetType type, unsigned int n_points);

/// Gauss points on the part of facet `contactor` that `target` covers when both are seen along the
/// contactor's mean normal: `target`'s outline is clipped against `contactor`'s, the polygon cut into
/// triangles, and points of an exact rule of order 2·`n_points` − 1 placed in each and mapped back to the
/// contactor's local domain.
///
/// Facets of degree 2 are treated as their (straight-edged) sub-facets, so that the outline follows the
/// mid-side nodes. Returns nothing where they do not overlap, where the mean normals do not oppose each
/// other, or where the overlap is below 1e-14 of the contactor. Weights are measures in ξ: over targets that
/// cover the contactor once they sum to the measure of its local domain.
template <int dim>
std::vector<FacetQuadraturePoint<dim>>
make_segment_points(const FacetNodes<dim> &contactor, const FacetNodes<dim> &target, unsigned int n_points);
} // namespace signorini::contact
