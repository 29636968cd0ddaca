// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/discretization/hexahedral_part.h"

#include <deal.II/distributed/solution_transfer.h>

namespace signorini
{
/// Numbers at the points of the elastic energy, for carrying them to another mesh.
struct PointValues
{
  unsigned int n_components = 0; ///< 0 where there is nothing to carry
  std::vector<double> values;    ///< [own cell][point][component]

  template <typename Archive>
  void serialize(Archive &archive, unsigned int)
  {
    archive &n_components &values;
  }
};

/// Carries numbers at the Gauss points of hexahedra over a change of the mesh: those of a cell are values of
/// the polynomial through them, which is evaluated in the cell's children, and made of theirs, where they
/// become coarser, by projection.
template <int dim>
class PointTransfer
{
public:
  /// Before the mesh changes, with the values of all own cells [own cell][point][component] (collective).
  /// `hexahedra` must outlive this object.
  PointTransfer(const HexahedralPart<dim> &hexahedra, unsigned int n_components,
                const std::vector<double> &values);

  /// The same on the mesh that has changed and been numbered anew (collective).
  std::vector<double> interpolate();

private:
  Vector make_vector();
  /// Calls `visit(dof, i)` with the degree of freedom of the number `i` of the own cells.
  template <typename Visit>
  void for_each_number(const Visit &visit) const;

  const HexahedralPart<dim> &part;
  const dealii::FESystem<dim> element;
  dealii::DoFHandler<dim> dof_handler;
  Vector old_values;
  dealii::parallel::distributed::SolutionTransfer<dim, Vector> transfer;
};
} // namespace signorini
