// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/adaptivity/motion_marking.h"

#include "signorini/adaptivity/error_classes.h"
#include "signorini/contact/coupling/facet_exchange.h"
#include "signorini/contact/search/coming_contact.h"
#include "signorini/parameters/contact_parameters.h"

#include <algorithm>
#include <cmath>

namespace signorini
{
namespace
{
/// How many levels each own cell lies above the file's mesh, [own cell].
template <int dim>
std::vector<unsigned int> find_extra_levels(const Discretization<dim> &discretization,
                                            const FileLevels<dim> &file_levels)
{
  std::vector<unsigned int> extra_levels(discretization.cells.n_cells, 0);
  unsigned int own_cell = 0; // hexahedra come first
  for (const auto &cell : discretization.hexahedra->own_cells())
    extra_levels[own_cell++] = cell->level() - file_levels.level_at(cell);
  return extra_levels;
}

/// Means over the facets of all ranks.
template <int dim>
std::vector<SpatialVector<dim>> find_body_velocities(const ContactSurface<dim> &surface,
                                                     const contact::StraightMotion<dim> &motion,
                                                     const MPI_Comm &communicator)
{
  std::vector<SpatialVector<dim>> velocities(surface.n_bodies, SpatialVector<dim>::Zero());
  std::vector<double> n_facets(surface.n_bodies, 0.);
  for (const Facet<dim> &facet : surface.facets)
  {
    velocities[facet.body] += motion.mean_velocity(facet);
    ++n_facets[facet.body];
  }
  MPI_Allreduce(MPI_IN_PLACE, velocities.data(), static_cast<int>(dim * velocities.size()), MPI_DOUBLE,
                MPI_SUM, communicator);
  dealii::Utilities::MPI::sum(n_facets, communicator, n_facets);
  for (unsigned int body = 0; body < velocities.size(); ++body)
    velocities[body] /= std::max(n_facets[body], 1.);
  return velocities;
}

/// Lets `near` hold all facets that may come near own ones while the nodes go on as they move now.
template <int dim>
void hold_coming_facets(const contact::StraightMotion<dim> &motion, const std::vector<double> &margins,
                        const std::function<bool(unsigned int, unsigned int)> &may_touch,
                        const MPI_Comm &communicator, SurfaceMap<dim> &near)
{
  // Seen by one at rest boxes are no smaller than by one who moves along.
  std::vector<contact::BoundingBox<dim>> boxes;
  std::vector<contact::FacetQuery<dim>> queries;
  for (unsigned int f = 0; f < near.n_own_facets(); ++f)
  {
    const Facet<dim> &facet = near.surface().facets[f];
    boxes.push_back(motion.swept_box(facet, SpatialVector<dim>::Zero()));
    const SpatialVector<dim> margin = SpatialVector<dim>::Constant(margins[f]);
    queries.push_back({{boxes[f].min() - margin, boxes[f].max() + margin}, facet.body});
  }
  hold_facets<dim>(queries, boxes, may_touch, communicator, near);
}
} // namespace

template <int dim>
std::vector<bool>
find_cells_near_contact(const Scene<dim> &scene, const ContactParameters &contact,
                        const Discretization<dim> &discretization, const SurfaceMap<dim> &map,
                        const std::vector<BoundaryFace<dim>> &faces, const FileLevels<dim> &file_levels,
                        const State &state, double duration)
{
  constexpr double margin_over_file_cell = 0.6;
  const ContactSurface<dim> &surface = map.surface();
  const std::vector<unsigned int> extra_levels = find_extra_levels(discretization, file_levels);
  std::vector<double> margins(surface.facets.size(), 0.);
  for (const BoundaryFace<dim> &face : faces)
    margins[face.facet] = margin_over_file_cell * surface.facets[face.facet].layer_thickness *
                          std::pow(2., extra_levels[face.cell]);

  const contact::StraightMotion<dim> motion{map.positions(state.displacement), map.gather(state.velocity),
                                            duration};
  const MPI_Comm &communicator = discretization.communicator();
  const auto may_touch = [&](unsigned int body, const std::string &other)
  { return !is_pair_excluded(contact, scene.body_names[body], other); };
  std::vector<bool> is_near(surface.facets.size(), false);
  const auto note = [&](const std::vector<unsigned int> &facets)
  {
    for (const unsigned int f : facets)
      is_near[f] = true;
  };
  const auto may_bodies_touch = [&](unsigned int body, unsigned int other)
  { return may_touch(body, scene.body_names[other]); };
  SurfaceMap<dim> near = map;
  hold_coming_facets<dim>(motion, margins, may_bodies_touch, communicator, near);
  note(contact::find_coming_contact<dim>(
      near.surface(), {near.positions(state.displacement), near.gather(state.velocity), duration}, margins,
      find_body_velocities<dim>(surface, motion, communicator), may_bodies_touch));
  for (unsigned int i = 0; i < scene.obstacles.size(); ++i)
  {
    const Obstacle<dim> &obstacle = *scene.obstacles[i];
    const ObstacleMotion<dim> &way = scene.obstacle_motions[i];
    contact::StraightMotion<dim> seen_from_obstacle = motion;
    for (SpatialVector<dim> &velocity : seen_from_obstacle.velocities)
      velocity -= way.velocity(state.time);
    note(contact::find_coming_contact<dim>(
        surface, seen_from_obstacle, margins, *obstacle.moved(way.displacement(state.time) - surface.origin),
        [&](unsigned int body) { return may_touch(body, obstacle.name()); }));
  }

  std::vector<bool> is_near_contact(extra_levels.size(), false);
  for (const BoundaryFace<dim> &face : faces)
    if (is_near[face.facet])
      is_near_contact[face.cell] = true;
  return is_near_contact;
}

template <int dim>
bool mark_cells_in_motion(const std::vector<bool> &is_near_contact, OtherCells others,
                          const std::vector<double> &plastic_strains, const ErrorEstimate &estimate,
                          const AdaptivityParameters &parameters, const FileLevels<dim> &file_levels,
                          Discretization<dim> &discretization)
{
  const ErrorClasses errors(estimate, parameters, discretization.communicator());
  const bool may_refine = discretization.n_dofs() < parameters.max_n_dofs;
  const std::vector<unsigned int> extra_levels = find_extra_levels(discretization, file_levels);
  unsigned int own_cell = 0;
  for (const auto &cell : discretization.hexahedra->own_cells())
  {
    const bool is_by_error = others == OtherCells::by_error;
    const double squared = is_by_error ? estimate.cell_discretization[own_cell] : 0.;
    if (is_near_contact[own_cell] || (is_by_error && errors.is_large(squared)))
    {
      if (may_refine && extra_levels[own_cell] < parameters.max_levels)
        cell->set_refine_flag();
    }
    else if (extra_levels[own_cell] > 0 && plastic_strains[own_cell] == 0. &&
             (is_by_error ? errors.is_small(squared) : others == OtherCells::coarser))
      cell->set_coarsen_flag();
    ++own_cell;
  }
  discretization.hexahedra->mesh.prepare_coarsening_and_refinement();
  bool is_any = false;
  for (const auto &cell : discretization.hexahedra->own_cells())
    is_any |= cell->refine_flag_set() || cell->coarsen_flag_set();
  return dealii::Utilities::MPI::max(static_cast<int>(is_any), discretization.communicator()) == 1;
}

template std::vector<bool> find_cells_near_contact(const Scene<2> &, const ContactParameters &,
                                                   const Discretization<2> &, const SurfaceMap<2> &,
                                                   const std::vector<BoundaryFace<2>> &,
                                                   const FileLevels<2> &, const State &, double);
template std::vector<bool> find_cells_near_contact(const Scene<3> &, const ContactParameters &,
                                                   const Discretization<3> &, const SurfaceMap<3> &,
                                                   const std::vector<BoundaryFace<3>> &,
                                                   const FileLevels<3> &, const State &, double);
template bool mark_cells_in_motion(const std::vector<bool> &, OtherCells, const std::vector<double> &,
                                   const ErrorEstimate &, const AdaptivityParameters &, const FileLevels<2> &,
                                   Discretization<2> &);
template bool mark_cells_in_motion(const std::vector<bool> &, OtherCells, const std::vector<double> &,
                                   const ErrorEstimate &, const AdaptivityParameters &, const FileLevels<3> &,
                                   Discretization<3> &);
} // namespace signorini
