// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/base/spatial_vector.h"

#include <vector>

namespace signorini::contact
{
/// For each of `queries` the index of the nearest of `points`, of which there must be one at least.
template <int dim>
std::vector<unsigned int> find_nearest_points(const std::vector<SpatialVector<dim>> &points,
                                              const std::vector<SpatialVector<dim>> &queries);
} // namespace signorini::contact
