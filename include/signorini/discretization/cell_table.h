// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <vector>

namespace signorini
{
/// All that element loops need of this rank's own cells, in flat arrays: after the set-up no loop over cells
/// touches deal.II. Geometry is that of the undeformed configuration. Cells of one kind follow each other.
template <int dim>
struct CellTable
{
  unsigned int n_cells = 0;

  std::vector<unsigned int> dofs;      ///< [cell][node][component] → index into the local part of a Vector
  std::vector<unsigned int> bodies;    ///< [cell]
  std::vector<double> gradients;       ///< [cell][point][node][direction] of the shape functions [1/m]
  std::vector<double> weights;         ///< [cell][point] quadrature weight × Jacobian [m³; m² in 2-D]
  std::vector<double> nodal_measures;  ///< [cell][node] positive shares of the cell's volume: the diagonal of
                                       ///< the mass matrix at unit density [m³; m² in 2-D]
  std::vector<double> shape_integrals; ///< [cell][node] ∫N dV [m³; m² in 2-D]

  unsigned int n_nodes(unsigned int cell) const
  {
    return static_cast<unsigned int>(first_nodes[cell + 1] - first_nodes[cell]);
  }
  unsigned int n_points(unsigned int cell) const
  {
    return static_cast<unsigned int>(first_points[cell + 1] - first_points[cell]);
  }
  unsigned int n_cell_dofs(unsigned int cell) const { return n_nodes(cell) * dim; }
  const unsigned int *cell_dofs(unsigned int cell) const { return &dofs[first_nodes[cell] * dim]; }
  const double *cell_gradients(unsigned int cell) const { return &gradients[first_gradients[cell]]; }
  const double *cell_weights(unsigned int cell) const { return &weights[first_points[cell]]; }
  const double *cell_nodal_measures(unsigned int cell) const { return &nodal_measures[first_nodes[cell]]; }
  const double *cell_shape_integrals(unsigned int cell) const { return &shape_integrals[first_nodes[cell]]; }
  /// Index of a cell's first point among the points of all cells.
  std::size_t first_point(unsigned int cell) const { return first_points[cell]; }
  std::size_t n_points() const { return weights.size(); }

  /// Ends a cell whose entries have been appended to all arrays.
  void close_cell()
  {
    ++n_cells;
    first_nodes.push_back(nodal_measures.size());
    first_points.push_back(weights.size());
    first_gradients.push_back(gradients.size());
  }

private:
  std::vector<std::size_t> first_nodes{0}, first_points{0}, first_gradients{0};
};
} // namespace signorini
