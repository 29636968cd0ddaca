// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/discretization/point_transfer.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_dgq.h>

namespace signorini
{
template <int dim>
PointTransfer<dim>::PointTransfer(const HexahedralPart<dim> &hexahedra, unsigned int n_components,
                                  const std::vector<double> &values)
    : part(hexahedra),
      element(dealii::FE_DGQArbitraryNodes<dim>(dealii::QGauss<1>(part.element.degree + 1)), n_components),
      dof_handler(part.mesh), old_values(make_vector()), transfer(dof_handler)
{
  for_each_number([&](dealii::types::global_dof_index dof, std::size_t i) { old_values(dof) = values[i]; });
  old_values.update_ghost_values();
  transfer.prepare_for_coarsening_and_refinement(old_values);
}

template <int dim>
Vector PointTransfer<dim>::make_vector()
{
  dof_handler.distribute_dofs(element);
  dealii::IndexSet relevant;
  dealii::DoFTools::extract_locally_relevant_dofs(dof_handler, relevant);
  return Vector(dof_handler.locally_owned_dofs(), relevant,
                dof_handler.get_triangulation().get_communicator());
}

template <int dim>
template <typename Visit>
void PointTransfer<dim>::for_each_number(const Visit &visit) const
{
  const unsigned int n = element.n_dofs_per_cell(), n_components = element.n_components();
  std::vector<dealii::types::global_dof_index> dofs(n);
  std::size_t first = 0;
  for (const auto &cell : part.own_cells())
  {
    const typename MeshPart<dim>::Cell with_dofs(&part.mesh, cell->level(), cell->index(), &dof_handler);
    with_dofs->get_dof_indices(dofs);
    for (unsigned int i = 0; i < n; ++i)
    {
      const auto [component, point] = element.system_to_component_index(i);
      visit(dofs[i], first + point * n_components + component);
    }
    first += n;
  }
}

template <int dim>
std::vector<double> PointTransfer<dim>::interpolate()
{
  Vector values = make_vector();
  transfer.interpolate(values);
  std::vector<double> numbers(values.locally_owned_size());
  for_each_number([&](dealii::types::global_dof_index dof, std::size_t i) { numbers[i] = values(dof); });
  return numbers;
}

template class PointTransfer<2>;
template class PointTransfer<3>;
} // namespace signorini
