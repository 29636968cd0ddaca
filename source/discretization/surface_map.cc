// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/discretization/surface_map.h"

#include <deal.II/fe/fe_tools.h>

#include <Eigen/Geometry>

#include <numeric>
#include <unordered_map>

namespace signorini
{
namespace
{
/// A facet travels between ranks as its body, thickness, room and type, then for every node its dofs and
/// position.
template <int dim>
struct TravellingNode
{
  std::array<dealii::types::global_dof_index, dim> dofs;
  SpatialVector<dim> position;
};

/// Indices of the corners, in turn around the facet.
template <int dim>
std::vector<unsigned int> corners_of(const Facet<dim> &facet)
{
  const unsigned int degree = facet.degree;
  if constexpr (dim == 2)
    return {0, degree};
  else if (facet.type == FacetType::triangle)
    return {0, 1, 2};
  else
    return {0, degree, (degree + 1) * (degree + 1) - 1, degree * (degree + 1)};
}

template <int dim>
SpatialVector<dim> mean_area_normal(const std::vector<TravellingNode<dim>> &nodes,
                                    const std::vector<unsigned int> &corners)
{
  const auto from_first = [&](unsigned int i) -> SpatialVector<dim>
  { return nodes[corners[i]].position - nodes[corners[0]].position; };
  if constexpr (dim == 2)
    return SpatialVector<2>(from_first(1)[1], -from_first(1)[0]);
  else
  {
    SpatialVector<3> normal = SpatialVector<3>::Zero();
    for (unsigned int i = 1; i + 1 < corners.size(); ++i)
      normal += 0.5 * from_first(i).cross(from_first(i + 1));
    return normal;
  }
}

/// Turns the normal around.
template <int dim>
void turn_around(std::vector<TravellingNode<dim>> &nodes, const Facet<dim> &facet)
{
  const unsigned int degree = facet.degree;
  if (dim == 2)
    std::reverse(nodes.begin(), nodes.end());
  else if (facet.type == FacetType::triangle)
  {
    std::swap(nodes[1], nodes[2]);
    if (degree == 2)
      std::swap(nodes[3], nodes[5]);
  }
  else
    for (unsigned int j = 0; j <= degree; ++j)
      for (unsigned int i = 0; i < j; ++i)
        std::swap(nodes[i + j * (degree + 1)], nodes[j + i * (degree + 1)]);
}

/// Vertices of the mesh that lie on its boundary, as far as this rank knows.
template <int dim>
std::vector<bool> find_boundary_vertices(const dealii::Triangulation<dim> &mesh)
{
  std::vector<bool> at_boundary(mesh.n_vertices(), false);
  for (const auto &face : mesh.active_face_iterators())
    if (face->at_boundary())
      for (const unsigned int v : face->vertex_indices())
        at_boundary[face->vertex_index(v)] = true;
  return at_boundary;
}

/// Collects the outer faces of this rank's cells.
template <int dim>
class FacetCollector
{
public:
  explicit FacetCollector(const Discretization<dim> &the_discretization) : discretization(the_discretization)
  {
    if (discretization.tetrahedra)
      boundary_vertices = find_boundary_vertices<dim>(discretization.tetrahedra->triangulation());
  }

  std::vector<double> pack_own_facets()
  {
    discretization.for_each_own_cell(
        [this](const MeshPart<dim> &part, const auto &cell, unsigned int)
        {
          for (const unsigned int face : cell->face_indices())
            if (cell->face(face)->at_boundary())
              pack_facet(part, cell, face);
        });
    return packed;
  }

private:
  using Cell = typename MeshPart<dim>::Cell;

  void pack_facet(const MeshPart<dim> &part, const Cell &cell, unsigned int face)
  {
    Facet<dim> facet;
    facet.degree = discretization.degree;
    facet.body = cell->material_id();
    const bool is_simplex = &part == discretization.tetrahedra.get();
    if (dim == 3 && is_simplex)
      facet.type = FacetType::triangle;
    std::vector<TravellingNode<dim>> nodes = ordered_nodes(part, cell, face, facet);
    SpatialVector<dim> outward;
    for (unsigned int d = 0; d < dim; ++d)
      outward[d] = (cell->face(face)->center() - cell->center())[d];
    const SpatialVector<dim> normal = mean_area_normal(nodes, corners_of(facet));
    if (normal.dot(outward) < 0.)
      turn_around(nodes, facet);
    if (is_simplex)
      measure_simplex(cell, nodes[0].position, normal.normalized(), facet);
    else
    {
      facet.layer_thickness = cell->measure() / cell->face(face)->measure();
      const bool is_whole_body = cell->face(face ^ 1u)->at_boundary(); // the face across
      facet.room = (is_whole_body ? 0.5 : 1.) * facet.layer_thickness;
    }
    packed.insert(packed.end(), {static_cast<double>(facet.body), facet.layer_thickness, facet.room,
                                 static_cast<double>(facet.type)});
    for (const auto &node : nodes)
    {
      packed.insert(packed.end(), node.dofs.begin(), node.dofs.end());
      packed.insert(packed.end(), node.position.begin(), node.position.end());
    }
  }

  /// The face's nodes in the order of a facet, whichever way round.
  std::vector<TravellingNode<dim>> ordered_nodes(const MeshPart<dim> &part, const Cell &cell,
                                                 unsigned int face, const Facet<dim> &facet) const
  {
    const auto face_nodes = part.face_nodes(cell, face);
    std::vector<unsigned int> order(face_nodes.size());
    std::iota(order.begin(), order.end(), 0);
    if (facet.type == FacetType::tensor_product)
      order = dealii::FETools::hierarchic_to_lexicographic_numbering<dim - 1>(facet.degree);
    std::vector<TravellingNode<dim>> nodes(face_nodes.size());
    for (unsigned int i = 0; i < nodes.size(); ++i)
    {
      TravellingNode<dim> &node = nodes[order[i]];
      node.dofs = face_nodes[i];
      for (unsigned int d = 0; d < dim; ++d)
        node.position[d] = discretization.node_positions(face_nodes[i][d]);
    }
    return nodes;
  }

  /// The height over the face; where the corner across is on the boundary, the body ends there.
  void measure_simplex(const Cell &cell, const SpatialVector<dim> &point, const SpatialVector<dim> &normal,
                       Facet<dim> &facet) const
  {
    for (const unsigned int v : cell->vertex_indices())
    {
      SpatialVector<dim> arm;
      for (unsigned int d = 0; d < dim; ++d)
        arm[d] = cell->vertex(v)[d] - point[d];
      const double height = std::abs(arm.dot(normal));
      if (height > facet.layer_thickness)
      {
        facet.layer_thickness = height;
        facet.room = (boundary_vertices[cell->vertex_index(v)] ? 0.5 : 1.) * height;
      }
    }
  }

  const Discretization<dim> &discretization;
  std::vector<bool> boundary_vertices; ///< of the tetrahedra
  std::vector<double> packed;
};
} // namespace

template <int dim>
SurfaceMap<dim>::SurfaceMap(const Scene<dim> &scene, const Discretization<dim> &the_discretization)
    : discretization(&the_discretization)
{
  contact_surface.n_bodies = scene.n_bodies();
  number_nodes(dealii::Utilities::MPI::all_gather(discretization->communicator(),
                                                  FacetCollector<dim>(*discretization).pack_own_facets()),
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
  std::unordered_map<dealii::types::global_dof_index, unsigned int> node_of_dof;
  for (unsigned int rank = 0; rank < packed_facets.size(); ++rank)
    for (auto value = packed_facets[rank].begin(); value != packed_facets[rank].end();)
    {
      Facet<dim> facet;
      facet.degree = discretization->degree;
      facet.owned = (rank == this_rank);
      facet.body = static_cast<unsigned int>(*value++);
      facet.layer_thickness = *value++;
      facet.room = *value++;
      facet.type = static_cast<FacetType>(*value++);
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
