// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

namespace signorini
{
/// All that element loops need of this rank's own cells, in flat arrays: after the set-up no loop over cells touches
/// deal.II. Geometry is that of the undeformed configuration.
template <int dim>
struct CellTable
{
  unsigned int n_cells = 0;
  unsigned int n_nodes = 0; ///< of a cell
  unsigned int n_points = 0; ///< quadrature points of a cell

  std::vector<unsigned int> dofs;      ///< [cell][node][component] → index into the local part of a Vector
  std::vector<unsigned int> bodies;    ///< [cell]
  std::vector<double> gradients;       ///< [cell][point][node][direction] of the shape functions [1/m]
  std::vector<double> weights;         ///< [cell][point] quadrature weight × Jacobian [m³; m² in 2-D]
  std::vector<double> nodal_measures;  ///< [cell][node] ∫N dV by the rule whose points are the nodes, scaled to the cell's volume [m³; m² in 2-D]

  unsigned int n_cell_dofs() const { return n_nodes * dim; }
  const unsigned int *cell_dofs(unsigned int cell) const { return &dofs[cell * n_nodes * dim]; }
  const double *cell_gradients(unsigned int cell) const { return &gradients[cell * n_points * n_nodes * dim]; }
  const double *cell_weights(unsigned int cell) const { return &weights[cell * n_points]; }
};
} // namespace signorini
