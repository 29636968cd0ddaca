// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/base/spatial_vector.h"

#include <deal.II/base/tensor.h>

namespace signorini
{
/// A vector or point of deal.II as one of Eigen.
template <int dim>
SpatialVector<dim> to_eigen(const dealii::Tensor<1, dim> &x)
{
  SpatialVector<dim> result;
  for (unsigned int d = 0; d < dim; ++d)
    result[d] = x[d];
  return result;
}
} // namespace signorini
