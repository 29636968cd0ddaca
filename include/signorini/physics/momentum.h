// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/discretization/discretization.h"

#include <array>

namespace signorini
{
/// A vector and its moment about the origin, in three components whatever the dimension.
struct VectorAndMoment
{
  std::array<double, 3> vector{};
  std::array<double, 3> moment{};
  double vector_scale = 0.; ///< sum of the nodal magnitudes
  double moment_scale = 0.; ///< sum of |x|·(nodal magnitude)

  template <typename Archive>
  void serialize(Archive &archive, unsigned int /*version*/)
  {
    archive &vector &moment &vector_scale &moment_scale;
  }
};

/// Sums a nodal quantity q over all ranks: Σ q and Σ x×q, with x = X + u the nodes' positions. With forces:
/// their resultant. With `mass`, q = m v: the momenta.
template <int dim>
VectorAndMoment sum_over_nodes(const Discretization<dim> &discretization, const Vector &displacement,
                               const Vector &nodal, const Vector *mass = nullptr);
} // namespace signorini
