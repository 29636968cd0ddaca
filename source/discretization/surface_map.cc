// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/discretization/surface_map.h"

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_tools.h>

#include <Eigen/Geometry>

#include <unordered_map>

namespace signorini
{
namespace
{
/// A facet as it travels between ranks: body, thickness, room, then for every node its dofs and position.
template <int dim>
struct TravellingNode
{
  std::array<dealii::types::global_dof_index, dim> dofs;
  SpatialVector<dim> position;
};

template <int dim>
SpatialVector<dim> area_normal_at_centre(const std::vector<TravellingNode<dim>> &nodes, unsigned int degree)
{
  const auto corner = [&](unsigned int i, unsigned int j)
  { return nodes[degree * (i + j * (degree + 1))].position; };
  const SpatialVector<dim> t = corner(1, 0) - corner(0, 0);
  if constexpr (dim == 2)
    return SpatialVector<2>(t[1], -t[0]);
  else
  {
    const SpatialVector<3> a = corner(1, 1) - corner(0, 0), b = corner(0, 1) - corner(1, 0);
    return 0.5 * a.cross(b);
  }
}

/// Swaps the local directions (2-D: reverses the nodes), which turns the normal around.
template <int dim>
void turn_around(std::vector<TravellingNode<dim>> &nodes, unsigned int degree)
{
  if (dim == 2)
    std::reverse(nodes.begin(), nodes.end());
  else
    for (unsigned int j = 0; j <= degree; ++j)
      for (unsigned int i = 0; i < j; ++i)
        std::swap(nodes[i + j * (degree + 1)], nodes[j + i * (degree + 1)]);
}

template <int dim>
std::vector<double> pack_own_facets(const Discretization<dim> &discretization)
{
  const auto &element = discretization.element;
  const std::vector<unsigned int> lexicographic =
      dealii::FETools::hierarchic_to_lexicographic_numbering<dim - 1>(element.degree);
  std::map<dealii::types::global_dof_index, dealii::Point<dim>> positions;
  dealii::DoFTools::map_dofs_to_support_points(discretization.mapping, discretization.dof_handler, positions);

  std::vector<double> packed;
  std::vector<dealii::types::global_dof_index> face_dofs(element.n_dofs_per_face());
  std::vector<TravellingNode<dim>> nodes(element.n_dofs_per_face() / dim);
  for (const auto &cell : discretization.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned() && cell->at_boundary())
      for (const unsigned int face_number : cell->face_indices())
      {
        const auto face = cell->face(face_number);
        if (!face->at_boundary())
          continue;
        face->get_dof_indices(face_dofs);
        for (unsigned int i = 0; i < face_dofs.size(); ++i)
        {
          const auto [component, node] = element.face_system_to_component_index(i);
          nodes[lexicographic[node]].dofs[component] = face_dofs[i];
          for (unsigned int d = 0; d < dim; ++d)
            nodes[lexicographic[node]].position[d] = positions[face_dofs[i]][d];
        }
        SpatialVector<dim> outward;
        for (unsigned int d = 0; d < dim; ++d)
          outward[d] = (face->center() - cell->center())[d];
        if (area_normal_at_centre(nodes, element.degree).dot(outward) < 0.)
          turn_around(nodes, element.degree);

        packed.push_back(cell->material_id());
        const double thickness = cell->measure() / face->measure();
        const bool is_whole_body = cell->face(face_number ^ 1u)->at_boundary(); // the face across
        packed.insert(packed.end(), {thickness, (is_whole_body ? 0.5 : 1.) * thickness});
        for (const auto &node : nodes)
        {
          packed.insert(packed.end(), node.dofs.begin(), node.dofs.end());
          packed.insert(packed.end(), node.position.begin(), node.position.end());
        }
      }
  return packed;
}
} // namespace

template <int dim>
SurfaceMap<dim>::SurfaceMap(const Scene<dim> &scene, const Discretization<dim> &the_discretization)
    : discretization(&the_discretization)
{
  contact_surface.n_bodies = scene.n_bodies();
  number_nodes(
      dealii::Utilities::MPI::all_gather(discretization->communicator(), pack_own_facets(*discretization)),
      dealii::Utilities::MPI::this_mpi_process(discretization->communicator()));
  move_origin();
  for (Facet<dim> &facet : contact_surface.facets)
  {
    facet.youngs_modulus = scene.materials[facet.body].youngs_modulus;
    facet.density = scene.materials[facet.body].density;
  }
  const Vector layout = discretization->make_vector();
  for (unsigned int node = 0; node < dofs.size(); ++node)
    if (discretization->owned_dofs.is_element(dofs[node][0]))
    {
      std::array<unsigned int, dim> local;
      for (unsigned int d = 0; d < dim; ++d)
        local[d] = layout.get_partitioner()->global_to_local(dofs[node][d]);
      owned_nodes.emplace_back(node, local);
    }
  gather_constraints();
}

template <int dim>
void SurfaceMap<dim>::number_nodes(const std::vector<std::vector<double>> &packed_facets,
                                   unsigned int this_rank)
{
  const unsigned int degree = discretization->element.degree;
  std::unordered_map<dealii::types::global_dof_index, unsigned int> node_of_dof;
  for (unsigned int rank = 0; rank < packed_facets.size(); ++rank)
    for (auto value = packed_facets[rank].begin(); value != packed_facets[rank].end();)
    {
      Facet<dim> facet;
      facet.degree = degree;
      facet.owned = (rank == this_rank);
      facet.body = static_cast<unsigned int>(*value++);
      facet.layer_thickness = *value++;
      facet.room = *value++;
      for (unsigned int i = 0; i < facet.n_nodes(); ++i)
      {
        std::array<dealii::types::global_dof_index, dim> node_dofs;
        SpatialVector<dim> position;
        for (auto &dof : node_dofs)
          dof = static_cast<dealii::types::global_dof_index>(*value++);
        for (double &coordinate : position)
          coordinate = *value++;
        const auto [entry, is_new] = node_of_dof.emplace(node_dofs[0], contact_surface.n_nodes());
        facet.nodes[i] = entry->second;
        if (is_new)
        {
          contact_surface.reference_positions.push_back(position);
          dofs.push_back(node_dofs);
        }
      }
      contact_surface.facets.push_back(facet);
    }
}

template <int dim>
void SurfaceMap<dim>::move_origin()
{
  auto &positions = contact_surface.reference_positions;
  SpatialVector<dim> low = positions.at(0), high = low;
  for (const SpatialVector<dim> &x : positions)
  {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  contact_surface.origin = 0.5 * (low + high);
  for (SpatialVector<dim> &x : positions)
    x -= contact_surface.origin;
}

template <int dim>
void SurfaceMap<dim>::gather_constraints()
{
  std::vector<double> packed;
  for (const auto &[node, local] : owned_nodes)
    for (const dealii::types::global_dof_index dof : dofs[node])
      if (discretization->hanging_constraints.is_constrained(dof))
      {
        const auto &entries = *discretization->hanging_constraints.get_constraint_entries(dof);
        packed.push_back(static_cast<double>(dof));
        packed.push_back(static_cast<double>(entries.size()));
        for (const auto &[master, weight] : entries)
        {
          packed.push_back(static_cast<double>(master));
          packed.push_back(weight);
        }
      }
  all_relevant_dofs = discretization->relevant_dofs;
  for (const auto &node_dofs : dofs)
    for (const dealii::types::global_dof_index dof : node_dofs)
      all_relevant_dofs.add_index(dof);
  for (const auto &of_rank : dealii::Utilities::MPI::all_gather(discretization->communicator(), packed))
    for (auto value = of_rank.begin(); value != of_rank.end();)
    {
      typename dealii::AffineConstraints<double>::ConstraintLine line;
      line.index = static_cast<dealii::types::global_dof_index>(*value++);
      const auto n_entries = static_cast<unsigned int>(*value++);
      for (unsigned int i = 0; i < n_entries; ++i)
      {
        const auto master = static_cast<dealii::types::global_dof_index>(*value++);
        line.entries.emplace_back(master, *value++);
        all_relevant_dofs.add_index(master);
      }
      lines.push_back(line);
    }
}

template <int dim>
std::vector<SpatialVector<dim>> SurfaceMap<dim>::gather(const Vector &values) const
{
  std::vector<SpatialVector<dim>> gathered(dofs.size(), SpatialVector<dim>::Zero());
  for (const auto &[node, local] : owned_nodes)
    for (unsigned int d = 0; d < dim; ++d)
      gathered[node][d] = values.local_element(local[d]);
  if (dealii::Utilities::MPI::n_mpi_processes(discretization->communicator()) > 1)
    MPI_Allreduce(MPI_IN_PLACE, gathered.data(), static_cast<int>(dim * gathered.size()), MPI_DOUBLE, MPI_SUM,
                  discretization->communicator());
  return gathered;
}

template <int dim>
std::vector<SpatialVector<dim>> SurfaceMap<dim>::positions(const Vector &displacement) const
{
  std::vector<SpatialVector<dim>> x = gather(displacement);
  for (unsigned int node = 0; node < x.size(); ++node)
    x[node] += contact_surface.reference_positions[node];
  return x;
}

template <int dim>
void SurfaceMap<dim>::add_to_owners(const std::vector<SpatialVector<dim>> &nodal_forces, Vector &forces) const
{
  const std::vector<SpatialVector<dim>> *total = &nodal_forces;
  std::vector<SpatialVector<dim>> summed;
  if (dealii::Utilities::MPI::n_mpi_processes(discretization->communicator()) > 1)
  {
    summed = nodal_forces;
    MPI_Allreduce(MPI_IN_PLACE, summed.data(), static_cast<int>(dim * summed.size()), MPI_DOUBLE, MPI_SUM,
                  discretization->communicator());
    total = &summed;
  }
  for (const auto &[node, local] : owned_nodes)
    for (unsigned int d = 0; d < dim; ++d)
      forces.local_element(local[d]) += (*total)[node][d];
}

template <int dim>
void SurfaceMap<dim>::add_remote_hanging_constraints(dealii::AffineConstraints<double> &constraints) const
{
  for (const auto &line : lines)
    if (!constraints.is_constrained(line.index))
    {
      constraints.add_line(line.index);
      constraints.add_entries(line.index, line.entries);
    }
}

template class SurfaceMap<2>;
template class SurfaceMap<3>;
} // namespace signorini
