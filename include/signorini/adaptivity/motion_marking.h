// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/adaptivity/boundary_faces.h"
#include "signorini/adaptivity/error_estimate.h"
#include "signorini/discretization/scene_mesh.h"
#include "signorini/physics/state.h"
#include "signorini/scene/scene.h"

namespace signorini
{
/// Own cells, [own cell], with a face that may come into contact within `duration` [s], or is in contact, if
/// all goes on as it moves now (collective). Surfaces count as touching from 0.6 cells of the file's mesh on.
/// `faces`: see collect_boundary_faces().
template <int dim>
std::vector<bool>
find_cells_near_contact(const Scene<dim> &scene, const ContactParameters &contact,
                        const Discretization<dim> &discretization, const SurfaceMap<dim> &map,
                        const std::vector<BoundaryFace<dim>> &faces, const FileLevels<dim> &file_levels,
                        const State &state, double duration);

/// What becomes of cells that are not near contact.
enum class OtherCells
{
  by_error, ///< refined or made coarser by their share of the squared error
  coarser,
  as_they_are
};

/// Flags cells of a moving scene (collective): those near contact for refinement; none above `max_levels`
/// beyond the mesh of the file or below that mesh; errors count as ErrorClasses says. Cells that have
/// yielded, of the mean equivalent plastic strain `plastic_strains` [own cell], become no coarser: the nodes
/// that would be dropped hold the volume of what has flowed around them. Returns whether any flag is left
/// after those have been cleared that the neighbours forbid.
template <int dim>
bool mark_cells_in_motion(const std::vector<bool> &is_near_contact, OtherCells others,
                          const std::vector<double> &plastic_strains, const ErrorEstimate &estimate,
                          const AdaptivityParameters &parameters, const FileLevels<dim> &file_levels,
                          Discretization<dim> &discretization);
} // namespace signorini
