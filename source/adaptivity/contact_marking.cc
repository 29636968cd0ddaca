// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/adaptivity/contact_marking.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <utility>

namespace signorini
{
namespace
{
constexpr double not_concerned = -1.;

template <int dim>
using Cell = typename dealii::DoFHandler<dim>::active_cell_iterator;

template <int dim>
int level_to_be(const Cell<dim> &cell)
{
  return cell->level() + (cell->refine_flag_set() ? 1 : 0) - (cell->coarsen_flag_set() ? 1 : 0);
}

/// Largest distance of the middle of an edge from the surface that it belongs to [m].
template <int dim>
double sagitta(const Cell<dim> &cell, unsigned int boundary_id)
{
  double largest = 0.;
  for (const unsigned int f : cell->face_indices())
    if (cell->face(f)->at_boundary() && cell->face(f)->boundary_id() == boundary_id)
      for (unsigned int l = 0; l < cell->face(f)->n_lines(); ++l)
      {
        const auto edge = cell->face(f)->line(l);
        largest = std::max(largest, edge->center(true).distance(edge->center(false)));
      }
  return largest;
}

template <int dim>
double largest_pressure(const BoundaryFace<dim> &face, const NodalPressures<dim> &pressures)
{
  double largest = 0.;
  for (const unsigned int node : face.facet_nodes)
    largest = std::max(largest, pressures[face.facet][node]);
  return largest;
}

/// Highest level of the facets of all ranks at each node (collective).
template <int dim>
std::vector<double> find_nodal_levels(const SurfaceMap<dim> &map, const std::vector<double> &levels)
{
  const ContactSurface<dim> &surface = map.surface();
  std::vector<double> of_node(surface.n_nodes(), not_concerned);
  for (unsigned int f = 0; f < levels.size(); ++f)
    for (unsigned int i = 0; i < surface.facets[f].n_nodes(); ++i)
    {
      double &level = of_node[surface.facets[f].nodes[i]];
      level = std::max(level, levels[f]);
    }
  map.maximize(of_node);
  return of_node;
}

/// Raises the levels of facets that share a node until they are equal (collective).
template <int dim>
void level_out(const SurfaceMap<dim> &map, const MPI_Comm &communicator, std::vector<double> &levels)
{
  for (bool has_changed = true; has_changed;)
  {
    const std::vector<double> of_node = find_nodal_levels(map, levels);
    has_changed = false;
    for (unsigned int f = 0; f < levels.size(); ++f)
      if (levels[f] != not_concerned)
        for (unsigned int i = 0; i < map.surface().facets[f].n_nodes(); ++i)
        {
          const double highest = std::max(levels[f], of_node[map.surface().facets[f].nodes[i]]);
          has_changed |= std::exchange(levels[f], highest) != highest;
        }
    has_changed = dealii::Utilities::MPI::max(static_cast<int>(has_changed), communicator) == 1;
  }
}
} // namespace

template <int dim>
void level_curved_contact(const std::vector<BoundaryFace<dim>> &all_faces,
                          const NodalPressures<dim> &pressures, double penalty_factor,
                          const SurfaceMap<dim> &map, Discretization<dim> &discretization)
{
  if (dim == 2)
    return; // nodes of a boundary curve do not hang
  const bool is_straight = discretization.degree == 1;
  const double tolerance = is_straight ? 0.1 : 0.05, pressure_of_kink = is_straight ? penalty_factor : 4.;
  const ContactSurface<dim> &surface = map.surface();
  const std::vector<Cell<dim>> &cells = discretization.hexahedra->own_cells();
  std::vector<BoundaryFace<dim>> faces; // of the hexahedra, which come first among the cells
  std::copy_if(all_faces.begin(), all_faces.end(), std::back_inserter(faces),
               [&](const BoundaryFace<dim> &face) { return face.cell < cells.size(); });
  double peak = 0.;
  for (const BoundaryFace<dim> &face : faces)
    peak = std::max(peak, largest_pressure(face, pressures));
  peak = dealii::Utilities::MPI::max(peak, discretization.communicator());

  std::vector<double> levels(surface.facets.size(), not_concerned);
  for (const BoundaryFace<dim> &face : faces)
  {
    const Facet<dim> &facet = surface.facets[face.facet];
    const double kink = pressure_of_kink * facet.youngs_modulus / facet.layer_thickness *
                        sagitta<dim>(cells[face.cell], face.boundary_id);
    if (largest_pressure(face, pressures) > 0. && kink > tolerance * peak)
      levels[face.facet] = level_to_be<dim>(cells[face.cell]);
  }
  // On the next mesh contact may reach a little farther.
  const std::vector<double> of_node = find_nodal_levels(map, levels);
  for (const BoundaryFace<dim> &face : faces)
  {
    const auto &nodes = surface.facets[face.facet].nodes;
    if (std::any_of(nodes.begin(), nodes.begin() + surface.facets[face.facet].n_nodes(),
                    [&](unsigned int node) { return of_node[node] != not_concerned; }))
      levels[face.facet] = level_to_be<dim>(cells[face.cell]);
  }
  level_out(map, discretization.communicator(), levels);
  for (const BoundaryFace<dim> &face : faces)
    if (levels[face.facet] > level_to_be<dim>(cells[face.cell]))
    {
      cells[face.cell]->clear_coarsen_flag();
      if (levels[face.facet] > cells[face.cell]->level())
        cells[face.cell]->set_refine_flag();
    }
}

template void level_curved_contact(const std::vector<BoundaryFace<2>> &, const NodalPressures<2> &, double,
                                   const SurfaceMap<2> &, Discretization<2> &);
template void level_curved_contact(const std::vector<BoundaryFace<3>> &, const NodalPressures<3> &, double,
                                   const SurfaceMap<3> &, Discretization<3> &);
} // namespace signorini
