// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/search/facet_box.h"

#include <functional>
#include <vector>

namespace signorini::contact
{
/// What somebody looks for: facets that may touch those of a body in a box.
template <int dim>
struct FacetQuery
{
  BoundingBox<dim> box;
  unsigned int body = 0;
};

/// Those of the first `boxes.size()` facets, which have these boxes, that answer any of the queries, in
/// rising order: they overlap its box and `is_allowed_pair(body of the query, own body)`.
template <int dim>
std::vector<unsigned int>
find_facets(const ContactSurface<dim> &surface, const std::vector<BoundingBox<dim>> &boxes,
            const std::vector<FacetQuery<dim>> &queries,
            const std::function<bool(unsigned int body, unsigned int other_body)> &is_allowed_pair);
} // namespace signorini::contact
