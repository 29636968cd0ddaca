// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/adaptivity/contact_marking.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <utility>

namespace signorini
{
namespace
{
constexpr int not_concerned = -1;

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

/// Raises the levels of facets that share a node until they are equal.
template <int dim>
void level_out(const ContactSurface<dim> &surface, std::vector<int> &levels)
{
  std::vector<int> of_node(surface.n_nodes(), not_concerned);
  for (bool has_changed = true; has_changed;)
  {
    has_changed = false;
    for (unsigned int f = 0; f < levels.size(); ++f)
    {
      if (levels[f] == not_concerned)
        continue;
      const auto &nodes = surface.facets[f].nodes;
      int highest = levels[f];
      for (unsigned int i = 0; i < surface.facets[f].n_nodes(); ++i)
        highest = std::max(highest, of_node[nodes[i]]);
      levels[f] = highest;
      for (unsigned int i = 0; i < surface.facets[f].n_nodes(); ++i)
        has_changed |= std::exchange(of_node[nodes[i]], highest) != highest;
    }
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

  std::vector<int> levels(surface.facets.size(), not_concerned);
  for (const BoundaryFace<dim> &face : faces)
  {
    const Facet<dim> &facet = surface.facets[face.facet];
    const double kink = pressure_of_kink * facet.youngs_modulus / facet.layer_thickness *
                        sagitta<dim>(cells[face.cell], face.boundary_id);
    if (largest_pressure(face, pressures) > 0. && kink > tolerance * peak)
      levels[face.facet] = level_to_be<dim>(cells[face.cell]);
  }
  const auto share = [&]()
  {
    MPI_Allreduce(MPI_IN_PLACE, levels.data(), static_cast<int>(levels.size()), MPI_INT, MPI_MAX,
                  discretization.communicator());
  };
  share();
  // On the next mesh contact may reach a little farther.
  std::vector<bool> is_concerned(surface.n_nodes(), false);
  for (unsigned int f = 0; f < levels.size(); ++f)
    for (unsigned int i = 0; i < surface.facets[f].n_nodes() && levels[f] != not_concerned; ++i)
      is_concerned[surface.facets[f].nodes[i]] = true;
  for (const BoundaryFace<dim> &face : faces)
  {
    const auto &nodes = surface.facets[face.facet].nodes;
    if (std::any_of(nodes.begin(), nodes.begin() + surface.facets[face.facet].n_nodes(),
                    [&](unsigned int node) { return is_concerned[node]; }))
      levels[face.facet] = level_to_be<dim>(cells[face.cell]);
  }
  share();
  level_out(surface, levels);
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
