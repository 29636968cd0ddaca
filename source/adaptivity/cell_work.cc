// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/adaptivity/cell_work.h"

namespace signorini
{
template <int dim>
std::vector<unsigned int> find_cell_work(const Discretization<dim> &discretization,
                                         const std::vector<BoundaryFace<dim>> &faces,
                                         const SceneForces<dim> &forces)
{
  constexpr unsigned int work_of_cell = 1000, work_of_body_pair = 700, work_of_obstacle_pair = 75,
                         work_of_simplex_pair = 3500;
  std::vector<unsigned int> work(discretization.cells.n_cells, work_of_cell);
  for (const auto &contact : forces.surface_contacts)
  {
    const unsigned int work_of_pair = contact->is_external ? work_of_obstacle_pair : work_of_body_pair;
    const std::vector<unsigned int> n_pairs = contact->n_pairs_of_facets();
    for (const BoundaryFace<dim> &face : faces)
      work[face.cell] += work_of_pair * n_pairs[face.facet];
  }
  for (const auto &contact : forces.volume_contacts)
    for (const unsigned int cell : contact->cells_of_pairs())
      work[cell] += work_of_simplex_pair;
  return work;
}

template std::vector<unsigned int>
find_cell_work(const Discretization<2> &, const std::vector<BoundaryFace<2>> &, const SceneForces<2> &);
template std::vector<unsigned int>
find_cell_work(const Discretization<3> &, const std::vector<BoundaryFace<3>> &, const SceneForces<3> &);
} // namespace signorini
