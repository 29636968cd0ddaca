// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/discretization/tetrahedral_part.h"

#include "signorini/base/to_point.h"
#include "signorini/discretization/scene_mesh.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/utilities.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria_description.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace signorini
{
namespace
{
/// deal.II holds the faces of triangles and of tetrahedra in different lists.
template <int dim>
auto &face_list(dealii::SubCellData &faces)
{
  if constexpr (dim == 2)
    return faces.boundary_lines;
  else
    return faces.boundary_quads;
}

/// The cells in the order of their middles along Hilbert's curve: neighbours stand near each other in memory,
/// whatever the order of the file.
template <int dim>
std::vector<std::array<unsigned int, 4>> sort_along_curve(const SimplexMesh &mesh)
{
  std::vector<dealii::Point<dim>> middles;
  for (const auto &vertices : mesh.cells)
  {
    middles.emplace_back();
    for (unsigned int v = 0; v <= dim; ++v)
      middles.back() += to_point<dim>(mesh.vertices[vertices[v]]) / (dim + 1.);
  }
  const auto places = dealii::Utilities::inverse_Hilbert_space_filling_curve<dim>(middles, 20);
  std::vector<unsigned int> order(mesh.cells.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](unsigned int one, unsigned int other) { return places[one] < places[other]; });
  std::vector<std::array<unsigned int, 4>> sorted;
  for (const unsigned int cell : order)
    sorted.push_back(mesh.cells[cell]);
  return sorted;
}
} // namespace

template <int dim>
TetrahedralPart<dim>::CoarseMesh::CoarseMesh(const std::vector<PlacedSimplexMesh> &meshes)
{
  for (const PlacedSimplexMesh &placed : meshes)
    append(placed);
}

template <int dim>
void TetrahedralPart<dim>::CoarseMesh::append(const PlacedSimplexMesh &placed)
{
  const SimplexMesh &mesh = placed.mesh;
  const unsigned int first_vertex = vertices.size();
  for (const Triple &vertex : mesh.vertices)
    vertices.push_back(to_point<dim>(vertex));
  for (const auto &vertices_of_cell : sort_along_curve<dim>(mesh))
  {
    dealii::CellData<dim> cell(dim + 1);
    for (unsigned int v = 0; v <= dim; ++v)
      cell.vertices[v] = first_vertex + vertices_of_cell[v];
    cell.material_id = placed.body;
    cells.push_back(cell);
  }
  for (const SimplexMesh::Face &face_of_mesh : mesh.faces)
  {
    dealii::CellData<dim - 1> face(dim);
    for (unsigned int v = 0; v < dim; ++v)
      face.vertices[v] = first_vertex + face_of_mesh.vertices[v];
    face.boundary_id = global_boundary_id(placed.body, face_of_mesh.boundary);
    face_list<dim>(faces).push_back(face);
  }
  for (const auto &[edge, midpoint] : mesh.edge_midpoints)
    edge_midpoints[{first_vertex + edge.first, first_vertex + edge.second}] = to_point<dim>(midpoint);
}

template <int dim>
TetrahedralPart<dim>::TetrahedralPart(const std::vector<PlacedSimplexMesh> &meshes, unsigned int degree,
                                      const MPI_Comm &communicator)
    : TetrahedralPart(CoarseMesh(meshes), degree, communicator)
{
}

template <int dim>
TetrahedralPart<dim>::TetrahedralPart(const CoarseMesh &coarse, unsigned int degree,
                                      const MPI_Comm &communicator)
    : TetrahedralPart(share_out(coarse, communicator), coarse, degree)
{
}

template <int dim>
TetrahedralPart<dim>::TetrahedralPart(std::unique_ptr<Mesh> the_mesh, const CoarseMesh &coarse,
                                      unsigned int degree)
    : MeshPart<dim>(std::move(the_mesh), dealii::FE_SimplexP<dim>(degree))
{
  for (const auto &cell : this->triangulation().active_cell_iterators())
    if (cell->is_locally_owned())
    {
      const auto id = cell->id().get_coarse_cell_id();
      const std::vector<unsigned int> &vertices = coarse.cells[id].vertices;
      for (const unsigned int line : cell->line_indices())
      {
        const auto coarse_vertex = [&](unsigned int end)
        {
          unsigned int v = 0;
          while (cell->vertex_index(v) != cell->line(line)->vertex_index(end))
            ++v;
          return vertices[v];
        };
        const unsigned int a = coarse_vertex(0), b = coarse_vertex(1);
        const auto midpoint = coarse.edge_midpoints.find({std::min(a, b), std::max(a, b)});
        if (midpoint != coarse.edge_midpoints.end())
          curved_edges[{id, line}] = midpoint->second;
      }
    }
}

template <int dim>
std::unique_ptr<typename TetrahedralPart<dim>::Mesh>
TetrahedralPart<dim>::share_out(const CoarseMesh &coarse, const MPI_Comm &communicator)
{
  dealii::Triangulation<dim> whole;
  whole.create_triangulation(coarse.vertices, coarse.cells, coarse.faces);
  dealii::GridTools::partition_triangulation(dealii::Utilities::MPI::n_mpi_processes(communicator), whole);
  auto mesh = std::make_unique<Mesh>(communicator);
  mesh->create_triangulation(
      dealii::TriangulationDescription::Utilities::create_description_from_triangulation(whole,
                                                                                         communicator));
  return mesh;
}

template <int dim>
std::vector<dealii::Point<dim>> TetrahedralPart<dim>::place_nodes(const typename MeshPart<dim>::Cell &cell)
{
  std::vector<dealii::Point<dim>> points;
  for (const unsigned int v : cell->vertex_indices())
    points.push_back(cell->vertex(v));
  if (this->element.degree == 1)
    return points;
  for (const unsigned int line : cell->line_indices())
  {
    const auto midpoint = curved_edges.find({cell->id().get_coarse_cell_id(), line});
    points.push_back(midpoint != curved_edges.end() ? midpoint->second
                                                    : cell->line(line)->center(/*respect_manifold=*/false));
  }
  return points;
}

template <int dim>
dealii::Quadrature<dim> TetrahedralPart<dim>::cell_rule() const
{
  if (this->element.degree == 1)
    return dealii::QGaussSimplex<dim>(1);
  const double near = (1. - 1. / std::sqrt(dim + 2.)) / (dim + 1.), far = 1. - dim * near;
  std::vector<dealii::Point<dim>> points;
  for (unsigned int corner = 0; corner <= dim; ++corner)
  {
    dealii::Point<dim> point;
    for (unsigned int d = 0; d < dim; ++d)
      point[d] = d + 1 == corner ? far : near;
    points.push_back(point);
  }
  const double volume = dim == 2 ? 1. / 2. : 1. / 6.;
  return dealii::Quadrature<dim>(points, std::vector<double>(dim + 1, volume / (dim + 1)));
}

template <int dim>
dealii::Quadrature<dim> TetrahedralPart<dim>::lumping_rule() const
{
  return this->gauss_rule(this->element.degree + 1);
}

template class TetrahedralPart<2>;
template class TetrahedralPart<3>;
} // namespace signorini
