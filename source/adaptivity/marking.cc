// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/adaptivity/marking.h"

#include "signorini/adaptivity/error_classes.h"

namespace signorini
{
template <int dim>
void mark_cells(const ErrorEstimate &estimate, const AdaptivityParameters &parameters,
                Discretization<dim> &discretization)
{
  const ErrorClasses errors(estimate, parameters, discretization.communicator());
  unsigned int own_cell = 0; // hexahedra come first
  for (const auto &cell : discretization.hexahedra->own_cells())
  {
    const double squared = estimate.cell_discretization[own_cell];
    // Without contact the solution says nothing of errors yet.
    if (estimate.is_any_contact_unseen ? estimate.is_contact_unseen[own_cell] : errors.is_large(squared))
      cell->set_refine_flag();
    else if (!estimate.is_any_contact_unseen && errors.is_small(squared))
      cell->set_coarsen_flag();
    ++own_cell;
  }
}

template void mark_cells(const ErrorEstimate &, const AdaptivityParameters &, Discretization<2> &);
template void mark_cells(const ErrorEstimate &, const AdaptivityParameters &, Discretization<3> &);
} // namespace signorini
