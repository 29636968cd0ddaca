// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/parameters/parameter_text.h"
#include "signorini/parameters/parameters.h"

#include <mpi.h>

namespace signorini
{
/// How large a run will be, from its parameters alone.
struct SizeEstimate
{
  double n_cells = 0.;
  double n_dofs = 0.;
  double memory = 0.;                      ///< of all ranks together, at least about this [bytes]
  const BodyParameters *largest = nullptr; ///< the body with the most cells
};

SizeEstimate estimate_size(const Parameters &parameters, unsigned int n_ranks);

/// Throws InputError, before any mesh is made, if the run needs more memory than the machines of all ranks
/// have. Collective.
void check_size(const ParameterText &text, const Parameters &parameters, const MPI_Comm &communicator);
} // namespace signorini
