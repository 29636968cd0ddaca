// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/adaptivity/error_classes.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace signorini
{
ErrorClasses::ErrorClasses(const ErrorEstimate &estimate, const MPI_Comm &communicator)
    : total(estimate.discretization), sums(n_classes, 0.)
{
  for (const double squared : estimate.cell_discretization)
    sums[class_of(squared)] += squared;
  dealii::Utilities::MPI::sum(sums, communicator, sums);
}

unsigned int ErrorClasses::class_of(double squared) const
{
  const double index = squared > 0. ? std::floor(-10. * std::log2(squared / total)) : n_classes;
  return static_cast<unsigned int>(std::clamp(index, 0., n_classes - 1.));
}

unsigned int ErrorClasses::end_of_largest(double share) const
{
  unsigned int end = 0;
  for (double sum = 0.; end < n_classes && sum < share * total; ++end)
    sum += sums[end];
  return end;
}

unsigned int ErrorClasses::begin_of_smallest(double share) const
{
  unsigned int begin = n_classes;
  for (double sum = 0.; begin > 0 && (sum += sums[begin - 1]) <= share * total; --begin)
    ;
  return begin;
}
} // namespace signorini
