// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Core>
#include <unsupported/Eigen/AutoDiff>

namespace signorini::contact
{
/// A number that carries its derivatives by what places a point against its target: the dim components of the
/// gap, those of the dim − 1 tangents of the target's facet, and the dim − 1 local coordinates of the foot.
template <int dim>
using Differentiable = Eigen::AutoDiffScalar<Eigen::Matrix<double, dim + dim *(dim - 1) + (dim - 1), 1>>;

/// Vectors and tensors in space of double or Differentiable.
template <int dim, typename Number>
using VectorOf = Eigen::Matrix<Number, dim, 1>;
template <int dim, typename Number>
using TensorOf = Eigen::Matrix<Number, dim, dim>;
} // namespace signorini::contact
