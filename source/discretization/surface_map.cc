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
/// A facet travels between ranks as its body, thickness, room, type and whether it is of a simplex, then for
/// every node its dofs and position.
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
        [this](const MeshPart<dim> &part, const auto &cell, unsigned int own_cell)
        {
          for (const unsigned int face : cell->face_indices())
            if (cell->face(face)->at_boundary())
              pack_facet(part, cell, face, measure(own_cell));
        });
    return packed;
  }

private:
  using Cell = typename MeshPart<dim>::Cell;

  /// Volume of a cell. deal.II's own takes squares of coordinates, which leaves no digits far from the
  /// origin.
  double measure(unsigned int own_cell) const
  {
    const double *weights = discretization.cells.cell_weights(own_cell);
    return std::accumulate(weights, weights + discretization.cells.n_points(own_cell), 0.);
  }

  void pack_facet(const MeshPart<dim> &part, const Cell &cell, unsigned int face, double volume)
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
      facet.layer_thickness = volume / cell->face(face)->measure();
      const bool is_whole_body = cell->face(face ^ 1u)->at_boundary(); // the face across
      facet.room = (is_whole_body ? 0.5 : 1.) * facet.layer_thickness;
    }
    packed.insert(packed.end(), {static_cast<double>(facet.body), facet.layer_thickness, facet.room,
                                 static_cast<double>(facet.type), is_simplex ? 1. : 0.});
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

template <int dim>
SpatialVector<dim> area_normal(const Facet<dim> &facet, const std::vector<SpatialVector<dim>> &positions)
{
  std::vector<TravellingNode<dim>> nodes;
  for (unsigned int i = 0; i < facet.n_nodes(); ++i)
    nodes.push_back({{}, positions[facet.nodes[i]]});
  return mean_area_normal(nodes, corners_of(facet));
}

/// Gives the facets of simplices the mean thickness around them, by area: over the facets at each node that
/// face the same way within 30°, then over the nodes. Heights of simplices differ at random from one to the
/// next, and under one pressure depths would differ as they do.
template <int dim>
void smooth_thicknesses(const std::vector<bool> &is_of_simplices, ContactSurface<dim> &surface)
{
  constexpr double same_way = 0.866;
  std::vector<std::vector<unsigned int>> facets_of_nodes(surface.n_nodes());
  std::vector<SpatialVector<dim>> normals;
  for (unsigned int f = 0; f < surface.facets.size(); ++f)
  {
    normals.push_back(area_normal(surface.facets[f], surface.reference_positions));
    for (unsigned int i = 0; i < surface.facets[f].n_nodes(); ++i)
      facets_of_nodes[surface.facets[f].nodes[i]].push_back(f);
  }
  std::vector<double> smooth;
  for (unsigned int f = 0; f < surface.facets.size(); ++f)
  {
    const Facet<dim> &facet = surface.facets[f];
    double sum = 0.;
    for (const unsigned int corner : corners_of(facet))
    {
      double area = 0., volume = 0.;
      for (const unsigned int other : facets_of_nodes[facet.nodes[corner]])
        if (normals[f].dot(normals[other]) >= same_way * normals[f].norm() * normals[other].norm())
        {
          area += normals[other].norm();
          volume += normals[other].norm() * surface.facets[other].layer_thickness;
        }
      sum += volume / area;
    }
    smooth.push_back(is_of_simplices[f] ? sum / static_cast<double>(corners_of(facet).size())
                                        : facet.layer_thickness);
  }
  for (unsigned int f = 0; f < surface.facets.size(); ++f)
    surface.facets[f].layer_thickness = smooth[f];
}
} // namespace

template <int dim>
SurfaceMap<dim>::SurfaceMap(const Scene<dim> &scene, const Discretization<dim> &the_discretization)
    : NodeMap<dim>(the_discretization)
{
  const MPI_Comm &communicator = the_discretization.communicator();
  contact_surface.n_bodies = scene.n_bodies();
  const std::vector<bool> is_of_simplices =
      number_nodes(dealii::Utilities::MPI::all_gather(
                       communicator, FacetCollector<dim>(the_discretization).pack_own_facets()),
                   dealii::Utilities::MPI::this_mpi_process(communicator));
  smooth_thicknesses(is_of_simplices, contact_surface);
  contact_surface.origin = move_to_middle(contact_surface.reference_positions);
  for (Facet<dim> &facet : contact_surface.facets)
  {
    facet.youngs_modulus = scene.materials[facet.body].youngs_modulus;
    facet.density = scene.materials[facet.body].density;
  }
}

template <int dim>
std::vector<bool> SurfaceMap<dim>::number_nodes(const std::vector<std::vector<double>> &packed_facets,
                                                unsigned int this_rank)
{
  std::unordered_map<dealii::types::global_dof_index, unsigned int> node_of_dof;
  std::vector<typename NodeMap<dim>::NodeDofs> all_node_dofs;
  std::vector<bool> is_of_simplices;
  for (unsigned int rank = 0; rank < packed_facets.size(); ++rank)
    for (auto value = packed_facets[rank].begin(); value != packed_facets[rank].end();)
    {
      Facet<dim> facet;
      facet.degree = this->discretization->degree;
      facet.owned = (rank == this_rank);
      facet.body = static_cast<unsigned int>(*value++);
      facet.layer_thickness = *value++;
      facet.room = *value++;
      facet.type = static_cast<FacetType>(*value++);
      is_of_simplices.push_back(*value++ == 1.);
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
          all_node_dofs.push_back(node_dofs);
        }
      }
      contact_surface.facets.push_back(facet);
    }
  this->set_nodes(std::move(all_node_dofs));
  return is_of_simplices;
}

template <int dim>
std::vector<SpatialVector<dim>> SurfaceMap<dim>::positions(const Vector &displacement) const
{
  std::vector<SpatialVector<dim>> x = this->gather(displacement);
  for (unsigned int node = 0; node < x.size(); ++node)
    x[node] += contact_surface.reference_positions[node];
  return x;
}

template class SurfaceMap<2>;
template class SurfaceMap<3>;
} // namespace signorini
