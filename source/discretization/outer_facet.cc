// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/discretization/outer_facet.h"

#include <deal.II/fe/fe_tools.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <numeric>
#include <unordered_map>

namespace signorini
{
namespace
{
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
SpatialVector<dim> mean_area_normal(const OuterFacet<dim> &outer)
{
  const std::vector<unsigned int> corners = corners_of(outer.facet);
  const auto from_first = [&](unsigned int i) -> SpatialVector<dim>
  { return outer.nodes[corners[i]].position - outer.nodes[corners[0]].position; };
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
void turn_around(OuterFacet<dim> &outer)
{
  auto &nodes = outer.nodes;
  const unsigned int degree = outer.facet.degree;
  if (dim == 2)
    std::reverse(nodes.begin(), nodes.end());
  else if (outer.facet.type == FacetType::triangle)
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

template <int dim>
class FacetCollector
{
public:
  explicit FacetCollector(const Discretization<dim> &the_discretization) : discretization(the_discretization)
  {
    if (discretization.tetrahedra)
      boundary_vertices = find_boundary_vertices<dim>(discretization.tetrahedra->triangulation());
  }

  std::vector<OuterFacet<dim>> collect()
  {
    discretization.for_each_own_cell(
        [this](const MeshPart<dim> &part, const auto &cell, unsigned int own_cell)
        {
          add_facets(part, cell, measure(own_cell));
          if (&part != discretization.tetrahedra.get())
            first_of_simplices = facets.size();
        });
    const std::size_t n_own = facets.size();
    if (discretization.tetrahedra)
    {
      for (const auto &cell : discretization.tetrahedra->dof_handler.active_cell_iterators())
        if (cell->is_ghost())
          add_facets(*discretization.tetrahedra, cell, 0.);
      smooth_thicknesses(n_own);
    }
    facets.resize(n_own);
    return std::move(facets);
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

  /// `volume` is not looked at where the part is that of the tetrahedra.
  void add_facets(const MeshPart<dim> &part, const Cell &cell, double volume)
  {
    for (const unsigned int face : cell->face_indices())
      if (cell->face(face)->at_boundary())
        facets.push_back(make_facet(part, cell, face, volume));
  }

  OuterFacet<dim> make_facet(const MeshPart<dim> &part, const Cell &cell, unsigned int face,
                             double volume) const
  {
    OuterFacet<dim> outer;
    Facet<dim> &facet = outer.facet;
    facet.degree = discretization.degree;
    facet.body = cell->material_id();
    const bool is_simplex = &part == discretization.tetrahedra.get();
    if (dim == 3 && is_simplex)
      facet.type = FacetType::triangle;
    std::iota(facet.nodes.begin(), facet.nodes.end(), 0);
    order_nodes(part, cell, face, outer);
    SpatialVector<dim> outward;
    for (unsigned int d = 0; d < dim; ++d)
      outward[d] = (cell->face(face)->center() - cell->center())[d];
    const SpatialVector<dim> normal = mean_area_normal(outer);
    if (normal.dot(outward) < 0.)
      turn_around(outer);
    if (is_simplex)
      measure_simplex(cell, normal.normalized(), outer);
    else
    {
      facet.layer_thickness = volume / cell->face(face)->measure();
      const bool is_whole_body = cell->face(face ^ 1u)->at_boundary(); // the face across
      facet.room = (is_whole_body ? 0.5 : 1.) * facet.layer_thickness;
    }
    return outer;
  }

  /// The face's nodes in the order of a facet, whichever way round.
  void order_nodes(const MeshPart<dim> &part, const Cell &cell, unsigned int face,
                   OuterFacet<dim> &outer) const
  {
    const auto face_nodes = part.face_nodes(cell, face);
    std::vector<unsigned int> order(face_nodes.size());
    std::iota(order.begin(), order.end(), 0);
    if (outer.facet.type == FacetType::tensor_product)
      order = dealii::FETools::hierarchic_to_lexicographic_numbering<dim - 1>(outer.facet.degree);
    outer.nodes.resize(face_nodes.size());
    for (unsigned int i = 0; i < face_nodes.size(); ++i)
    {
      typename OuterFacet<dim>::Node &node = outer.nodes[order[i]];
      node.dofs = face_nodes[i];
      for (unsigned int d = 0; d < dim; ++d)
        node.position[d] = discretization.node_positions(face_nodes[i][d]);
    }
  }

  /// The height over the face; where the corner across is on the boundary, the body ends there.
  void measure_simplex(const Cell &cell, const SpatialVector<dim> &normal, OuterFacet<dim> &outer) const
  {
    Facet<dim> &facet = outer.facet;
    for (const unsigned int v : cell->vertex_indices())
    {
      SpatialVector<dim> arm;
      for (unsigned int d = 0; d < dim; ++d)
        arm[d] = cell->vertex(v)[d] - outer.nodes[0].position[d];
      const double height = std::abs(arm.dot(normal));
      if (height > facet.layer_thickness)
      {
        facet.layer_thickness = height;
        facet.room = (boundary_vertices[cell->vertex_index(v)] ? 0.5 : 1.) * height;
      }
    }
  }

  /// Of the first facets, as far as they are of simplices. Around their nodes all are known: whatever touches
  /// an own cell is own or a ghost.
  void smooth_thicknesses(std::size_t n_own)
  {
    std::unordered_map<dealii::types::global_dof_index, std::vector<std::size_t>> facets_of_nodes;
    std::vector<SpatialVector<dim>> normals;
    for (std::size_t f = 0; f < facets.size(); ++f)
    {
      normals.push_back(mean_area_normal(facets[f]));
      for (const typename OuterFacet<dim>::Node &node : facets[f].nodes)
        facets_of_nodes[node.dofs[0]].push_back(f);
    }
    std::vector<double> smooth;
    for (std::size_t f = first_of_simplices; f < n_own; ++f)
      smooth.push_back(smooth_thickness(f, normals, facets_of_nodes));
    for (std::size_t f = first_of_simplices; f < n_own; ++f)
      facets[f].facet.layer_thickness = smooth[f - first_of_simplices];
  }

  double smooth_thickness(std::size_t f, const std::vector<SpatialVector<dim>> &normals,
                          const std::unordered_map<dealii::types::global_dof_index, std::vector<std::size_t>>
                              &facets_of_nodes) const
  {
    constexpr double same_way = 0.866;
    const OuterFacet<dim> &outer = facets[f];
    const std::vector<unsigned int> corners = corners_of(outer.facet);
    double sum = 0.;
    for (const unsigned int corner : corners)
    {
      double area = 0., volume = 0.;
      for (const std::size_t other : facets_of_nodes.at(outer.nodes[corner].dofs[0]))
        if (normals[f].dot(normals[other]) >= same_way * normals[f].norm() * normals[other].norm())
        {
          area += normals[other].norm();
          volume += normals[other].norm() * facets[other].facet.layer_thickness;
        }
      sum += volume / area;
    }
    return sum / static_cast<double>(corners.size());
  }

  const Discretization<dim> &discretization;
  std::vector<bool> boundary_vertices; ///< of the tetrahedra
  std::vector<OuterFacet<dim>> facets;
  std::size_t first_of_simplices = 0;
};
} // namespace

template <int dim>
void OuterFacet<dim>::pack(std::vector<double> &packed) const
{
  packed.insert(packed.end(), {static_cast<double>(facet.degree), static_cast<double>(facet.type),
                               static_cast<double>(facet.body), facet.layer_thickness, facet.room,
                               facet.youngs_modulus, facet.density, static_cast<double>(facet.number)});
  for (const Node &node : nodes)
  {
    packed.insert(packed.end(), node.dofs.begin(), node.dofs.end());
    packed.insert(packed.end(), node.position.begin(), node.position.end());
  }
}

template <int dim>
OuterFacet<dim> OuterFacet<dim>::unpack(std::vector<double>::const_iterator &value)
{
  OuterFacet outer;
  Facet<dim> &facet = outer.facet;
  facet.degree = static_cast<unsigned int>(*value++);
  facet.type = static_cast<FacetType>(*value++);
  facet.body = static_cast<unsigned int>(*value++);
  for (double *number : {&facet.layer_thickness, &facet.room, &facet.youngs_modulus, &facet.density})
    *number = *value++;
  facet.number = static_cast<unsigned int>(*value++);
  outer.nodes.resize(facet.n_nodes());
  for (Node &node : outer.nodes)
  {
    for (auto &dof : node.dofs)
      dof = static_cast<dealii::types::global_dof_index>(*value++);
    for (double &coordinate : node.position)
      coordinate = *value++;
  }
  return outer;
}

template <int dim>
std::vector<OuterFacet<dim>> collect_outer_facets(const Discretization<dim> &discretization)
{
  return FacetCollector<dim>(discretization).collect();
}

template struct OuterFacet<2>;
template struct OuterFacet<3>;
template std::vector<OuterFacet<2>> collect_outer_facets(const Discretization<2> &);
template std::vector<OuterFacet<3>> collect_outer_facets(const Discretization<3> &);
} // namespace signorini
