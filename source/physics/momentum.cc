// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/physics/momentum.h"

#include <cmath>

namespace signorini
{
template <int dim>
VectorAndMoment sum_over_nodes(const Discretization<dim> &discretization, const Vector &displacement,
                               const Vector &nodal, const Vector *mass)
{
  std::array<double, 8> sums{};
  for (const OwnedNode<dim> &node : discretization.owned_nodes)
  {
    std::array<double, 3> x{}, q{};
    for (unsigned int d = 0; d < dim; ++d)
    {
      x[d] = node.position[d] + displacement.local_element(node.dofs[d]);
      q[d] = nodal.local_element(node.dofs[d]) * (mass ? mass->local_element(node.dofs[d]) : 1.);
    }
    for (unsigned int d = 0; d < 3; ++d)
    {
      const unsigned int e = (d + 1) % 3, f = (d + 2) % 3;
      sums[d] += q[d];
      sums[3 + d] += x[e] * q[f] - x[f] * q[e];
    }
    const double magnitude = std::hypot(q[0], q[1], q[2]);
    sums[6] += magnitude;
    sums[7] += magnitude * std::hypot(x[0], x[1], x[2]);
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM,
                discretization.communicator());
  return {{sums[0], sums[1], sums[2]}, {sums[3], sums[4], sums[5]}, sums[6], sums[7]};
}

template VectorAndMoment sum_over_nodes<2>(const Discretization<2> &, const Vector &, const Vector &, const Vector *);
template VectorAndMoment sum_over_nodes<3>(const Discretization<3> &, const Vector &, const Vector &, const Vector *);
} // namespace signorini
