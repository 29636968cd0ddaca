// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/discretization/mesh_part.h"
#include "signorini/parameters/parameters.h"

#include <deal.II/distributed/tria.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q.h>

namespace signorini
{
/// The bodies of hexahedra (quadrilaterals), which can be refined cell by cell.
template <int dim>
class HexahedralPart : public MeshPart<dim>
{
public:
  using Mesh = dealii::parallel::distributed::Triangulation<dim>;

  HexahedralPart(std::unique_ptr<Mesh> mesh, unsigned int degree);

  /// Nodes of curved boundaries on the curve.
  std::vector<dealii::Point<dim>> place_nodes(const typename MeshPart<dim>::Cell &cell) override;
  dealii::Quadrature<dim> cell_rule() const override;
  /// The rule whose points are the nodes.
  dealii::Quadrature<dim> lumping_rule() const override;

  Mesh &mesh;

private:
  const dealii::MappingQ<dim> on_the_curve;
  dealii::FEValues<dim> at_nodes;
};
} // namespace signorini
