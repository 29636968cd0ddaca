// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/discretization/contact_surface.h"

#include <functional>
#include <vector>

namespace signorini::contact
{
template <int dim>
bool share_a_node(const Facet<dim> &one, const Facet<dim> &other);

/// Of every owned facet of a body that `is_considered` the facets of the same body that it never touches,
/// [facet], in rising order; empty for all others.
///
/// Those are the facet itself and what lies, undeformed, within its entry in `distances` [m] or shares a node
/// with it, but is not in front of it: along the surface, around an edge, and on the far side of a wall,
/// whose thickness would be taken for a depth. In front of a facet are those that have it above them, those
/// that lie above it, and those without a common node turned by more than 135° that are apart from it along
/// the mean normal. A gap may be closed: the two sides of a slit touch, however narrow it is (doc/theory.md,
/// section 5).
template <int dim>
std::vector<std::vector<unsigned int>>
find_untouchable_facets(const ContactSurface<dim> &surface, const std::vector<double> &distances,
                        const std::function<bool(unsigned int body)> &is_considered);
} // namespace signorini::contact
