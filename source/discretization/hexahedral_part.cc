// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/discretization/hexahedral_part.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>

namespace signorini
{
template <int dim>
HexahedralPart<dim>::HexahedralPart(std::unique_ptr<Mesh> the_mesh, unsigned int degree)
    : MeshPart<dim>(std::move(the_mesh), dealii::FE_Q<dim>(degree)),
      mesh(static_cast<Mesh &>(this->triangulation())), on_the_curve(degree),
      at_nodes(on_the_curve, this->element.base_element(0),
               dealii::Quadrature<dim>(this->element.base_element(0).get_unit_support_points()),
               dealii::update_quadrature_points)
{
}

template <int dim>
std::vector<dealii::Point<dim>> HexahedralPart<dim>::place_nodes(const typename MeshPart<dim>::Cell &cell)
{
  at_nodes.reinit(typename dealii::Triangulation<dim>::cell_iterator(cell));
  return at_nodes.get_quadrature_points();
}

template <int dim>
dealii::Quadrature<dim> HexahedralPart<dim>::cell_rule() const
{
  return dealii::QGauss<dim>(this->element.degree + 1);
}

template <int dim>
dealii::Quadrature<dim> HexahedralPart<dim>::lumping_rule() const
{
  return dealii::QGaussLobatto<dim>(this->element.degree + 1);
}

template class HexahedralPart<2>;
template class HexahedralPart<3>;
} // namespace signorini
