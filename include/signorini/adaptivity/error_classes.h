// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/adaptivity/error_estimate.h"
#include "signorini/parameters/parameters.h"

#include <mpi.h>

namespace signorini
{
/// Which errors of all cells of a scene, whatever their bodies and kinds, are large and which small: the
/// largest that hold `refine_share` of the squared error (W. Dörfler, 1996) and the smallest that hold at
/// most `coarsen_share`. Errors alike within 7 % are in one class, so that round-off decides nothing.
class ErrorClasses
{
public:
  /// Of all ranks together (collective).
  ErrorClasses(const ErrorEstimate &estimate, const AdaptivityParameters &parameters,
               const MPI_Comm &communicator);

  bool is_large(double squared) const { return class_of(squared) < end_of_large; }
  bool is_small(double squared) const { return class_of(squared) >= begin_of_small; }

private:
  /// A tenth of a factor of two each; 0 holds the largest errors.
  unsigned int class_of(double squared) const;

  double total;
  unsigned int end_of_large = 0, begin_of_small;
};
} // namespace signorini
