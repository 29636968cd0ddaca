// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/base/types.h"

#include <deal.II/base/quadrature.h>
#include <deal.II/distributed/tria_base.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping.h>

#include <array>
#include <memory>
#include <vector>

namespace signorini
{
/// All bodies of one kind of cell: their mesh, element, degrees of freedom and mapping. A scene has one or
/// two of these; deal.II numbers the degrees of freedom of each apart, the program those of all together.
template <int dim>
class MeshPart
{
public:
  using Cell = typename dealii::DoFHandler<dim>::active_cell_iterator;

  /// `scalar_element` is that of one component.
  MeshPart(std::unique_ptr<dealii::parallel::TriangulationBase<dim>> triangulation,
           const dealii::FiniteElement<dim> &scalar_element);
  virtual ~MeshPart() = default;

  /// Numbers cells and degrees of freedom of this part anew. Afterwards set_numbering() and place() it.
  void number_dofs();

  /// This rank's cells in the order of their ids. Theirs and that of the degrees of freedom are those of the
  /// mesh as it is, however it was refined to that: deal.II's own depend on the way.
  const std::vector<Cell> &own_cells() const { return the_own_cells; }

  /// Where the nodes of a cell are to be, in the order of the scalar element [m].
  virtual std::vector<dealii::Point<dim>> place_nodes(const Cell &cell) = 0;

  /// For the integrals of the elastic energy.
  virtual dealii::Quadrature<dim> cell_rule() const = 0;

  /// For ∫N² dV, the proportions of the diagonal of the mass matrix.
  virtual dealii::Quadrature<dim> lumping_rule() const = 0;

  /// Sets where the degrees of freedom stand among all: of every rank r its range in this part's own
  /// numbering starts at own_starts[r] and becomes the range from starts[r] on.
  void set_numbering(const std::vector<dealii::types::global_dof_index> &own_starts,
                     const std::vector<dealii::types::global_dof_index> &starts);

  /// The number among those of all parts.
  dealii::types::global_dof_index to_global(dealii::types::global_dof_index dof) const;

  /// As deal.II's, in the numbering of all parts.
  void get_dof_indices(const Cell &cell, std::vector<dealii::types::global_dof_index> &dofs) const;

  /// Degrees of freedom of the nodes of a cell's face, [node][component], the nodes in the order of the
  /// face's own scalar element: corners, edges, face.
  std::vector<std::array<dealii::types::global_dof_index, dim>> face_nodes(const Cell &cell,
                                                                           unsigned int face) const;

  /// Bends the mesh so that its nodes are at these positions, those of all parts (collective).
  void place(const Vector &positions);

  /// This part's entries of a vector over all parts, with ghosts, in deal.II's numbering (collective).
  Vector extract(const Vector &values) const;

  /// Writes them back to the owned entries.
  void insert(const Vector &own_values, Vector &values) const;

  const dealii::Mapping<dim> &mapping() const { return *the_mapping; }
  /// Gauss rules for the cells and their faces, exact up to degree 2·n_points − 1.
  dealii::Quadrature<dim> gauss_rule(unsigned int n_points) const;
  dealii::Quadrature<dim - 1> face_gauss_rule(unsigned int n_points) const;

  dealii::parallel::TriangulationBase<dim> &triangulation() const { return *the_triangulation; }

private:
  std::unique_ptr<dealii::parallel::TriangulationBase<dim>> the_triangulation;

public:
  const dealii::FESystem<dim> element;
  dealii::DoFHandler<dim> dof_handler;
  dealii::IndexSet relevant_dofs; ///< in deal.II's numbering
  unsigned int first_cell = 0;    ///< of its own cells among the own cells of all parts

private:
  /// Numbers the degrees of freedom in the order of the cells.
  void sort_dofs();

  std::vector<Cell> the_own_cells;
  std::vector<dealii::types::global_dof_index> own_starts_of_ranks, starts_of_ranks;
  Vector node_positions;
  std::unique_ptr<dealii::Mapping<dim>> the_mapping;
};
} // namespace signorini
