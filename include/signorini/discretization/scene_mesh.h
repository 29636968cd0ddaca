// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/parameters/parameters.h"

#include <deal.II/distributed/tria.h>

#include <memory>

namespace signorini
{
/// Numbers the boundary `local_id` of a body among all boundaries of the scene.
dealii::types::boundary_id global_boundary_id(unsigned int body, unsigned int local_id);

/// Body of a boundary id made by global_boundary_id(), and its index within that body.
std::pair<unsigned int, unsigned int> split_boundary_id(dealii::types::boundary_id id);

/// All bodies of a scene in one distributed mesh. Bodies share no vertex, touching or not; a cell's material id is
/// the index of its body. Curved boundaries stay on their manifolds under refinement; grading is done.
template <int dim>
std::unique_ptr<dealii::parallel::distributed::Triangulation<dim>>
make_scene_mesh(const std::vector<BodyParameters> &bodies, const MPI_Comm &communicator);
} // namespace signorini
