// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/adaptivity/error_classes.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace signorini
{
namespace
{
constexpr unsigned int n_classes = 600;
}

ErrorClasses::ErrorClasses(const ErrorEstimate &estimate, const AdaptivityParameters &parameters,
                           const MPI_Comm &communicator)
    : total(estimate.discretization), begin_of_small(n_classes)
{
  std::vector<double> sums(n_classes, 0.);
  for (const double squared : estimate.cell_discretization)
    sums[class_of(squared)] += squared;
  dealii::Utilities::MPI::sum(sums, communicator, sums);
  for (double sum = 0.; end_of_large < n_classes && sum < parameters.refine_share * total; ++end_of_large)
    sum += sums[end_of_large];
  for (double sum = 0.;
       begin_of_small > end_of_large && (sum += sums[begin_of_small - 1]) <= parameters.coarsen_share * total;
       --begin_of_small)
    ;
}

unsigned int ErrorClasses::class_of(double squared) const
{
  const double index = squared > 0. ? std::floor(-10. * std::log2(squared / total)) : n_classes;
  return static_cast<unsigned int>(std::clamp(index, 0., n_classes - 1.));
}
} // namespace signorini
