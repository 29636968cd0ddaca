// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/discretization/scene_mesh.h"

#include "signorini/base/collective_error.h"
#include "signorini/base/to_point.h"
#include "signorini/discretization/body_mesh.h"
#include "signorini/discretization/placement.h"
#include "signorini/parameters/mesh_parameters.h"

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/manifold_lib.h>

#include <boost/serialization/array.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

namespace signorini
{
namespace
{
constexpr unsigned int max_boundaries_of_a_body = 4096;

template <int dim>
struct CoarseScene
{
  std::vector<dealii::Point<dim>> vertices;
  std::vector<dealii::CellData<dim>> cells;
  dealii::SubCellData faces;
};

template <typename Faces>
void append_faces(const Faces &faces, unsigned int first_vertex, unsigned int body, Faces &all)
{
  for (auto face : faces)
  {
    for (unsigned int &vertex : face.vertices)
      vertex += first_vertex;
    if (face.boundary_id != dealii::numbers::internal_face_boundary_id)
      face.boundary_id = global_boundary_id(body, face.boundary_id);
    if (face.manifold_id != dealii::numbers::flat_manifold_id)
      face.manifold_id = body;
    all.push_back(face);
  }
}

template <int dim>
void append_body(const BodyParameters &parameters, unsigned int body, CoarseScene<dim> &scene)
{
  dealii::Triangulation<dim> mesh;
  make_coarse_body_mesh(parameters.mesh, mesh);
  const Placement<dim> placement(parameters.placement);
  auto [vertices, cells, faces] = dealii::GridTools::get_coarse_mesh_description(mesh);
  // An eighth of a ball comes with edges that its cells run along in opposite directions. deal.II 9.6 mixes
  // up the children of their faces where it refines what was coarsened, as it does everywhere when cells
  // change ranks.
  dealii::GridTools::consistently_order_cells(cells);

  const unsigned int first_vertex = scene.vertices.size();
  for (const dealii::Point<dim> &vertex : vertices)
    scene.vertices.push_back(placement.place(vertex));
  for (dealii::CellData<dim> &cell : cells)
  {
    for (unsigned int &vertex : cell.vertices)
      vertex += first_vertex;
    cell.material_id = body;
    scene.cells.push_back(cell);
  }
  append_faces(faces.boundary_lines, first_vertex, body, scene.faces.boundary_lines);
  append_faces(faces.boundary_quads, first_vertex, body, scene.faces.boundary_quads);
}

template <int dim>
void set_manifold(const BodyParameters &parameters, unsigned int body, dealii::Triangulation<dim> &mesh)
{
  const Placement<dim> placement(parameters.placement);
  const dealii::Point<dim> centre = placement.place(dealii::Point<dim>());
  if (parameters.mesh.shape == MeshParameters::Shape::ball)
    mesh.set_manifold(body, dealii::SphericalManifold<dim>(centre));
  if constexpr (dim == 3)
    if (parameters.mesh.shape == MeshParameters::Shape::cylinder)
      mesh.set_manifold(
          body, dealii::CylindricalManifold<3>(placement.rotate(dealii::Point<3>::unit_vector(2)), centre));
}

/// Distance of a cell from what its body is graded towards, in the body's own coordinates.
template <int dim>
double distance_to_grading(const MeshParameters &mesh, const Placement<dim> &placement,
                           const typename dealii::Triangulation<dim>::cell_iterator &cell)
{
  const MeshParameters::Grading &grading = *mesh.grading;
  std::vector<dealii::Point<dim>> vertices;
  for (const unsigned int v : cell->vertex_indices())
    vertices.push_back(placement.own_coordinates(cell->vertex(v)));
  if (grading.boundary)
  {
    double nearest = std::numeric_limits<double>::max();
    for (const dealii::Point<dim> &vertex : vertices)
      nearest = std::min(nearest, distance_to_boundary(mesh, *grading.boundary, vertex));
    return nearest;
  }
  const dealii::BoundingBox<dim> box(vertices);
  double squared = 0.;
  for (unsigned int d = 0; d < dim; ++d)
    squared += std::pow(
        std::max({box.lower_bound(d) - grading.point[d], grading.point[d] - box.upper_bound(d), 0.}), 2);
  return std::sqrt(squared);
}

/// Gives the faces of a mesh the indices of their boundaries among `names`.
void number_boundaries(const std::vector<std::string> &names, SimplexMesh &mesh)
{
  for (SimplexMesh::Face &face : mesh.faces)
  {
    const auto name = std::find(names.begin(), names.end(), mesh.boundary_names[face.boundary]);
    AssertThrow(name != names.end(), dealii::ExcInternalError());
    face.boundary = static_cast<unsigned int>(name - names.begin());
  }
  mesh.boundary_names = names;
}
} // namespace

template <int dim>
FileLevels<dim>::FileLevels(const std::vector<BodyParameters> &bodies)
{
  for (const BodyParameters &body : bodies)
  {
    meshes.push_back(body.mesh);
    placements.emplace_back(body.placement);
  }
}

template <int dim>
unsigned int FileLevels<dim>::n_levels() const
{
  unsigned int n = 0;
  for (const MeshParameters &mesh : meshes)
    n = std::max(n, mesh.refinements + (mesh.grading ? mesh.grading->levels : 0));
  return n;
}

template <int dim>
bool FileLevels<dim>::is_refined(const typename dealii::Triangulation<dim>::cell_iterator &cell) const
{
  const unsigned int body = cell->material_id(), level = cell->level();
  const MeshParameters &mesh = meshes[body];
  if (level < mesh.refinements)
    return true;
  if (!mesh.grading || level >= mesh.refinements + mesh.grading->levels)
    return false;
  const unsigned int finer_levels = mesh.refinements + mesh.grading->levels - 1 - level;
  return distance_to_grading<dim>(mesh, placements[body], cell) <=
         mesh.grading->distance * std::pow(2., finer_levels);
}

template <int dim>
unsigned int FileLevels<dim>::level_at(const typename dealii::Triangulation<dim>::cell_iterator &cell) const
{
  if (cell->level() == 0)
    return 0;
  const auto parent = cell->parent();
  const unsigned int of_parent = level_at(parent);
  return of_parent == static_cast<unsigned int>(parent->level()) && is_refined(parent) ? cell->level()
                                                                                       : of_parent;
}

dealii::types::boundary_id global_boundary_id(unsigned int body, unsigned int local_id)
{
  AssertIndexRange(local_id, max_boundaries_of_a_body);
  return max_boundaries_of_a_body * body + local_id;
}

std::pair<unsigned int, unsigned int> split_boundary_id(dealii::types::boundary_id id)
{
  return {id / max_boundaries_of_a_body, id % max_boundaries_of_a_body};
}

template <int dim>
std::unique_ptr<dealii::parallel::distributed::Triangulation<dim>>
make_scene_mesh(const std::vector<BodyParameters> &bodies, const MPI_Comm &communicator)
{
  CoarseScene<dim> scene;
  for (unsigned int body = 0; body < bodies.size(); ++body)
    if (bodies[body].mesh.cell_type == MeshParameters::CellType::hexahedra)
      append_body(bodies[body], body, scene);
  if (scene.cells.empty())
    return nullptr;

  using Mesh = dealii::parallel::distributed::Triangulation<dim>;
  auto mesh = std::make_unique<Mesh>(communicator, dealii::Triangulation<dim>::none,
                                     Mesh::no_automatic_repartitioning);
  mesh->create_triangulation(scene.vertices, scene.cells, scene.faces);
  for (unsigned int body = 0; body < bodies.size(); ++body)
    if (bodies[body].mesh.cell_type == MeshParameters::CellType::hexahedra)
      set_manifold(bodies[body], body, *mesh);
  const FileLevels<dim> levels(bodies);
  for (unsigned int level = 0; level < levels.n_levels(); ++level)
  {
    for (const auto &cell : mesh->active_cell_iterators_on_level(level))
      if (cell->is_locally_owned() && levels.is_refined(cell))
        cell->set_refine_flag();
    mesh->execute_coarsening_and_refinement();
    mesh->repartition();
  }
  return mesh;
}

namespace
{
template <int dim>
std::vector<PlacedSimplexMesh> make_and_place(const std::vector<BodyParameters> &bodies, unsigned int degree,
                                              const SizeOfBody &size_of_body)
{
  std::vector<PlacedSimplexMesh> meshes;
  for (unsigned int body = 0; body < bodies.size(); ++body)
  {
    if (bodies[body].mesh.cell_type != MeshParameters::CellType::tetrahedra)
      continue;
    const Placement<dim> placement(bodies[body].placement);
    const auto place = [&placement](Triple &point)
    { point = to_triple<dim>(placement.place(to_point<dim>(point))); };
    const MeshParameters &parameters = bodies[body].mesh;
    SimplexMesh mesh = size_of_body && !parameters.mesh_of_file
                           ? generate_simplex_mesh(parameters, dim, degree, size_of_body(body))
                           : make_simplex_body_mesh(parameters, dim, degree);
    number_boundaries(boundary_names(parameters, dim), mesh);
    for (Triple &vertex : mesh.vertices)
      place(vertex);
    for (auto &midpoint : mesh.edge_midpoints)
      place(midpoint.second);
    meshes.push_back({body, std::move(mesh)});
  }
  return meshes;
}
} // namespace

template <int dim>
std::vector<PlacedSimplexMesh> place_simplex_meshes(const std::vector<BodyParameters> &bodies,
                                                    unsigned int degree, const MPI_Comm &communicator,
                                                    const SizeOfBody &size_of_body)
{
  std::vector<PlacedSimplexMesh> meshes;
  throw_together(communicator,
                 [&]()
                 {
                   if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
                     meshes = make_and_place<dim>(bodies, degree, size_of_body);
                 });
  if (dealii::Utilities::MPI::n_mpi_processes(communicator) == 1)
    return meshes;
  return dealii::Utilities::MPI::broadcast(communicator, meshes);
}

template class FileLevels<2>;
template class FileLevels<3>;
template std::unique_ptr<dealii::parallel::distributed::Triangulation<2>>
make_scene_mesh<2>(const std::vector<BodyParameters> &, const MPI_Comm &);
template std::unique_ptr<dealii::parallel::distributed::Triangulation<3>>
make_scene_mesh<3>(const std::vector<BodyParameters> &, const MPI_Comm &);
template std::vector<PlacedSimplexMesh> place_simplex_meshes<2>(const std::vector<BodyParameters> &,
                                                                unsigned int, const MPI_Comm &,
                                                                const SizeOfBody &);
template std::vector<PlacedSimplexMesh> place_simplex_meshes<3>(const std::vector<BodyParameters> &,
                                                                unsigned int, const MPI_Comm &,
                                                                const SizeOfBody &);
} // namespace signorini
