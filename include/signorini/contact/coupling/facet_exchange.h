// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/search/facet_query.h"
#include "signorini/discretization/surface_map.h"

namespace signorini
{
/// Lets `map` hold, of the facets of other ranks, those that answer this rank's queries
/// (contact::find_facets) (collective).
///
/// Every rank tells all others one box around its own facets, `own_boxes`, and asks those whose boxes its
/// queries overlap; all else travels between these.
template <int dim>
void hold_facets(const std::vector<contact::FacetQuery<dim>> &queries,
                 const std::vector<contact::BoundingBox<dim>> &own_boxes,
                 const std::function<bool(unsigned int body, unsigned int other_body)> &is_allowed_pair,
                 const MPI_Comm &communicator, SurfaceMap<dim> &map);

/// Boxes of the own facets, where their nodes are at `positions`.
template <int dim>
std::vector<contact::BoundingBox<dim>> make_own_boxes(const SurfaceMap<dim> &map,
                                                      const std::vector<SpatialVector<dim>> &positions);
} // namespace signorini
