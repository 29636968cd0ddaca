// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/adaptivity/error_estimate.h"

#include <mpi.h>

#include <vector>

namespace signorini
{
/// Squared errors sorted by size into classes of a tenth of a factor of two each; summed over all ranks.
class ErrorClasses
{
public:
  static constexpr unsigned int n_classes = 600;

  ErrorClasses(const ErrorEstimate &estimate, const MPI_Comm &communicator);

  /// 0 holds the largest errors.
  unsigned int class_of(double squared) const;

  /// Classes below this one hold just at least that share.
  unsigned int end_of_largest(double share) const;

  /// Classes from this one on hold at most that share.
  unsigned int begin_of_smallest(double share) const;

private:
  double total;
  std::vector<double> sums;
};
} // namespace signorini
