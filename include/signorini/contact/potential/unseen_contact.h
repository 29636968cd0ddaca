// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/potential/pair_list.h"

namespace signorini::contact
{
/// Owned facets of which a node lies deeper in an obstacle or another body than `known_depth` [node] [m]:
/// such facets are too large to see their contact. Of bodies only those near the facet by the list are looked
/// at.
template <int dim>
std::vector<unsigned int> find_unseen_contact(const ContactSurface<dim> &surface, const PairList<dim> &pairs,
                                              const std::vector<SpatialVector<dim>> &positions,
                                              const std::vector<double> &known_depth);
} // namespace signorini::contact
