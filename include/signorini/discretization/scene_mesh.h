// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/discretization/generated_simplex_mesh.h"
#include "signorini/discretization/placement.h"
#include "signorini/discretization/tetrahedral_part.h"
#include "signorini/parameters/parameters.h"

#include <deal.II/distributed/tria.h>

#include <memory>

namespace signorini
{
/// Numbers the boundary `local_id` of a body among all boundaries of the scene.
dealii::types::boundary_id global_boundary_id(unsigned int body, unsigned int local_id);

/// Body of a boundary id made by global_boundary_id(), and its index within that body.
std::pair<unsigned int, unsigned int> split_boundary_id(dealii::types::boundary_id id);

/// The levels of refinement that the parameter file asks for, place by place.
template <int dim>
class FileLevels
{
public:
  explicit FileLevels(const std::vector<BodyParameters> &bodies);

  /// Level of that cell of the file's mesh which `cell` is or descends from, not counting what was refined
  /// only to keep neighbours within one level.
  unsigned int level_at(const typename dealii::Triangulation<dim>::cell_iterator &cell) const;

  /// Whether the file asks to refine a cell of this level.
  bool is_refined(const typename dealii::Triangulation<dim>::cell_iterator &cell) const;

  /// One more than the highest level of a cell that is refined.
  unsigned int n_levels() const;

private:
  std::vector<MeshParameters> meshes;
  std::vector<Placement<dim>> placements;
};

/// All bodies of hexahedra of a scene in one distributed mesh, null if there are none. Bodies share no
/// vertex, touching or not; a cell's material id is the index of its body. Curved boundaries stay on their
/// manifolds under refinement; grading is done. Every rank has the same number of cells; later refinement
/// moves none of them.
template <int dim>
std::unique_ptr<dealii::parallel::distributed::Triangulation<dim>>
make_scene_mesh(const std::vector<BodyParameters> &bodies, const MPI_Comm &communicator);

/// Edge lengths [m] in the own coordinates of a body, by its index.
using SizeOfBody = std::function<SizeField(unsigned int)>;

/// The meshes of all bodies of tetrahedra, where the bodies stand in the scene; curved edges for degree 2.
/// With `size_of_body` those that do not come from a mesh file are made with these sizes instead of the
/// parameters'. The first rank makes them for all, so that none can have another one (collective).
template <int dim>
std::vector<PlacedSimplexMesh> place_simplex_meshes(const std::vector<BodyParameters> &bodies,
                                                    unsigned int degree, const MPI_Comm &communicator,
                                                    const SizeOfBody &size_of_body = {});
} // namespace signorini
