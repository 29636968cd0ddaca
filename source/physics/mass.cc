// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/physics/mass.h"

namespace signorini
{
namespace
{
template <int dim, typename Factor>
Vector lump(const Discretization<dim> &discretization, const Factor &factor_of_body)
{
  const CellTable<dim> &cells = discretization.cells;
  Vector lumped = discretization.make_vector();
  for (unsigned int cell = 0; cell < cells.n_cells; ++cell)
    for (unsigned int i = 0; i < cells.n_cell_dofs(cell); ++i)
      lumped.local_element(cells.cell_dofs(cell)[i]) +=
          factor_of_body(cells.bodies[cell]) * cells.cell_nodal_measures(cell)[i / dim];
  discretization.collect(lumped);
  return lumped;
}
} // namespace

template <int dim>
Vector make_lumped_mass(const std::vector<MaterialParameters> &materials,
                        const Discretization<dim> &discretization)
{
  return lump(discretization, [&](unsigned int body) { return materials[body].density; });
}

template <int dim>
Vector make_nodal_volume(const Discretization<dim> &discretization)
{
  return lump(discretization, [](unsigned int) { return 1.; });
}

template Vector make_lumped_mass<2>(const std::vector<MaterialParameters> &, const Discretization<2> &);
template Vector make_lumped_mass<3>(const std::vector<MaterialParameters> &, const Discretization<3> &);
template Vector make_nodal_volume<2>(const Discretization<2> &);
template Vector make_nodal_volume<3>(const Discretization<3> &);
} // namespace signorini
