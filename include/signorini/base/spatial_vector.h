// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Core>

namespace signorini
{
/// A point, displacement, velocity or force in space.
template <int dim>
using SpatialVector = Eigen::Matrix<double, dim, 1>;

/// A symmetric or general second-order tensor in space.
template <int dim>
using SpatialTensor = Eigen::Matrix<double, dim, dim>;

/// Local coordinates on a facet.
template <int dim>
using LocalPoint = Eigen::Matrix<double, dim - 1, 1>;
} // namespace signorini
