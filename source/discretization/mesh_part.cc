// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/discretization/mesh_part.h"

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/mapping_fe_field.h>

#include <algorithm>
#include <utility>

namespace signorini
{
template <int dim>
MeshPart<dim>::MeshPart(std::unique_ptr<dealii::parallel::TriangulationBase<dim>> triangulation,
                        const dealii::FiniteElement<dim> &scalar_element)
    : the_triangulation(std::move(triangulation)), element(scalar_element, dim),
      dof_handler(*the_triangulation)
{
}

template <int dim>
void MeshPart<dim>::number_dofs()
{
  dof_handler.distribute_dofs(element);
  std::vector<std::pair<dealii::CellId, Cell>> sorted;
  for (const auto &cell : dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
      sorted.emplace_back(cell->id(), cell);
  std::sort(sorted.begin(), sorted.end(),
            [](const auto &one, const auto &other) { return one.first < other.first; });
  the_own_cells.clear();
  for (const auto &[id, cell] : sorted)
    the_own_cells.push_back(cell);
  sort_dofs();
  dealii::DoFTools::extract_locally_relevant_dofs(dof_handler, relevant_dofs);
}

template <int dim>
void MeshPart<dim>::sort_dofs()
{
  const dealii::IndexSet owned = dof_handler.locally_owned_dofs();
  std::vector<dealii::types::global_dof_index> numbers(owned.n_elements(),
                                                       dealii::numbers::invalid_dof_index),
      dofs(element.n_dofs_per_cell());
  auto next = owned.begin();
  for (const Cell &cell : the_own_cells)
  {
    cell->get_dof_indices(dofs);
    for (const dealii::types::global_dof_index dof : dofs)
      if (owned.is_element(dof))
        if (auto &number = numbers[owned.index_within_set(dof)]; number == dealii::numbers::invalid_dof_index)
          number = *next++;
  }
  // Those without a cell, see Discretization::unused_dofs, come last.
  for (auto &number : numbers)
    if (number == dealii::numbers::invalid_dof_index)
      number = *next++;
  dof_handler.renumber_dofs(numbers);
}

template <int dim>
void MeshPart<dim>::set_numbering(const std::vector<dealii::types::global_dof_index> &own_starts,
                                  const std::vector<dealii::types::global_dof_index> &starts)
{
  own_starts_of_ranks = own_starts;
  starts_of_ranks = starts;
}

template <int dim>
dealii::types::global_dof_index MeshPart<dim>::to_global(dealii::types::global_dof_index dof) const
{
  const auto after = std::upper_bound(own_starts_of_ranks.begin(), own_starts_of_ranks.end(), dof);
  const auto rank = static_cast<std::size_t>(after - own_starts_of_ranks.begin()) - 1;
  return dof - own_starts_of_ranks[rank] + starts_of_ranks[rank];
}

template <int dim>
void MeshPart<dim>::get_dof_indices(const Cell &cell,
                                    std::vector<dealii::types::global_dof_index> &dofs) const
{
  cell->get_dof_indices(dofs);
  for (auto &dof : dofs)
    dof = to_global(dof);
}

template <int dim>
std::vector<std::array<dealii::types::global_dof_index, dim>>
MeshPart<dim>::face_nodes(const Cell &cell, unsigned int face) const
{
  std::vector<dealii::types::global_dof_index> dofs(element.n_dofs_per_face());
  cell->face(face)->get_dof_indices(dofs);
  std::vector<std::array<dealii::types::global_dof_index, dim>> nodes(dofs.size() / dim);
  for (unsigned int i = 0; i < dofs.size(); ++i)
  {
    const auto [component, node] = element.face_system_to_component_index(i);
    nodes[node][component] = to_global(dofs[i]);
  }
  return nodes;
}

template <int dim>
void MeshPart<dim>::place(const Vector &positions)
{
  the_mapping.reset(); // it points to the old positions
  node_positions = extract(positions);
  the_mapping = std::make_unique<dealii::MappingFEField<dim, dim, Vector>>(dof_handler, node_positions);
}

template <int dim>
Vector MeshPart<dim>::extract(const Vector &values) const
{
  const dealii::IndexSet &owned = dof_handler.locally_owned_dofs();
  Vector own(owned, relevant_dofs, the_triangulation->get_communicator());
  for (const dealii::types::global_dof_index dof : owned)
    own(dof) = values(to_global(dof));
  own.update_ghost_values();
  return own;
}

template <int dim>
void MeshPart<dim>::insert(const Vector &own_values, Vector &values) const
{
  for (const dealii::types::global_dof_index dof : dof_handler.locally_owned_dofs())
    values(to_global(dof)) = own_values(dof);
}

template <int dim>
dealii::Quadrature<dim> MeshPart<dim>::gauss_rule(unsigned int n_points) const
{
  return element.reference_cell().template get_gauss_type_quadrature<dim>(n_points);
}

template <int dim>
dealii::Quadrature<dim - 1> MeshPart<dim>::face_gauss_rule(unsigned int n_points) const
{
  return element.reference_cell().face_reference_cell(0).template get_gauss_type_quadrature<dim - 1>(
      n_points);
}

template class MeshPart<2>;
template class MeshPart<3>;
} // namespace signorini
