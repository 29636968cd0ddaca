// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/adaptivity/marking.h"

#include <deal.II/distributed/grid_refinement.h>

namespace signorini
{
template <int dim>
void mark_cells(const ErrorEstimate &estimate, const AdaptivityParameters &parameters,
                Discretization<dim> &discretization)
{
  unsigned int own_cell = 0;
  if (estimate.is_any_contact_unseen)
  {
    // Without contact the solution says nothing of errors yet.
    for (const auto &cell : discretization.hexahedra->mesh.active_cell_iterators())
      if (cell->is_locally_owned() && estimate.is_contact_unseen[own_cell++])
        cell->set_refine_flag();
    return;
  }
  dealii::Vector<float> squares(discretization.hexahedra->mesh.n_active_cells());
  for (const auto &cell : discretization.hexahedra->mesh.active_cell_iterators())
    if (cell->is_locally_owned())
      squares[cell->active_cell_index()] =
          static_cast<float>(estimate.cell_discretization[own_cell++] / estimate.discretization);
  dealii::parallel::distributed::GridRefinement::refine_and_coarsen_fixed_fraction(
      discretization.hexahedra->mesh, squares, parameters.refine_share, parameters.coarsen_share);
}

template void mark_cells(const ErrorEstimate &, const AdaptivityParameters &, Discretization<2> &);
template void mark_cells(const ErrorEstimate &, const AdaptivityParameters &, Discretization<3> &);
} // namespace signorini
