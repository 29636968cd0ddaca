// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace signorini
{
/// All that element loops need of this rank's own cells, in flat arrays: after the set-up no loop over cells
/// touches deal.II. Geometry is that of the undeformed configuration. Cells of one kind follow each other.
template <int dim>
struct CellTable
{
  /// What cells with the same element and quadrature share.
  struct Kind
  {
    unsigned int n_nodes = 0, n_points = 0;
    std::vector<double> reference_gradients; ///< [point][node][direction] ∂N/∂ξ
    unsigned int first_cell = 0;
    std::size_t first_node = 0, first_point = 0; ///< of its first cell
  };

  unsigned int n_cells = 0;
  std::vector<Kind> kinds; ///< in the order of their cells

  std::vector<unsigned int> dofs;   ///< [cell][node][component] → index into the local part of a Vector
  std::vector<unsigned int> bodies; ///< [cell]
  std::vector<double> inverse_jacobians; ///< [cell][point][d][j] ∂ξ_d/∂X_j [1/m]
  std::vector<double> weights;           ///< [cell][point] quadrature weight × Jacobian [m³; m² in 2-D]
  std::vector<double> nodal_measures;  ///< [cell][node] positive shares of the cell's volume: the diagonal of
                                       ///< the mass matrix at unit density [m³; m² in 2-D]
  std::vector<double> shape_integrals; ///< [cell][node] ∫N dV [m³; m² in 2-D]

  const Kind &kind_of(unsigned int cell) const
  {
    return cell < kinds.back().first_cell ? kinds.front() : kinds.back(); // there are one or two
  }
  unsigned int n_nodes(unsigned int cell) const { return kind_of(cell).n_nodes; }
  unsigned int n_points(unsigned int cell) const { return kind_of(cell).n_points; }
  unsigned int n_cell_dofs(unsigned int cell) const { return n_nodes(cell) * dim; }
  const unsigned int *cell_dofs(unsigned int cell) const { return &dofs[first_node(cell) * dim]; }
  const double *cell_inverse_jacobians(unsigned int cell) const
  {
    return &inverse_jacobians[first_point(cell) * dim * dim];
  }
  const double *cell_weights(unsigned int cell) const { return &weights[first_point(cell)]; }
  const double *cell_nodal_measures(unsigned int cell) const { return &nodal_measures[first_node(cell)]; }
  const double *cell_shape_integrals(unsigned int cell) const { return &shape_integrals[first_node(cell)]; }
  /// Index of a cell's first point among the points of all cells.
  std::size_t first_point(unsigned int cell) const
  {
    const Kind &kind = kind_of(cell);
    return kind.first_point + static_cast<std::size_t>(cell - kind.first_cell) * kind.n_points;
  }
  std::size_t n_points() const { return weights.size(); }

  /// Begins `n_cells_to_come` cells of another kind, all entries of which are then appended to the arrays
  /// cell by cell. `reference_gradients`: as in Kind.
  void begin_kind(unsigned int n_nodes, unsigned int n_points, std::vector<double> reference_gradients,
                  std::size_t n_cells_to_come)
  {
    kinds.push_back(
        {n_nodes, n_points, std::move(reference_gradients), n_cells, nodal_measures.size(), weights.size()});
    const auto expect = [&](auto &array, std::size_t n_of_cell)
    { array.reserve(array.size() + n_cells_to_come * n_of_cell); };
    expect(dofs, n_nodes * dim);
    expect(bodies, 1);
    expect(inverse_jacobians, n_points * dim * dim);
    expect(weights, n_points);
    expect(nodal_measures, n_nodes);
    expect(shape_integrals, n_nodes);
  }

private:
  std::size_t first_node(unsigned int cell) const
  {
    const Kind &kind = kind_of(cell);
    return kind.first_node + static_cast<std::size_t>(cell - kind.first_cell) * kind.n_nodes;
  }
};
} // namespace signorini
