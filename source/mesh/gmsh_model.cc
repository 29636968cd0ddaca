// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/mesh/gmsh_model.h"

#include "signorini/mesh/gmsh_format.h"

#include <fmt/format.h>
#include <gmsh.h>

#include <map>
#include <unordered_map>

namespace signorini
{
namespace
{
using Entity = std::pair<int, int>; // dimension and tag
using NodeNumbers = std::unordered_map<std::size_t, unsigned int>;

/// Gmsh's numbers of the types of elements that can be taken: linear and quadratic ones.
bool is_simplex(const int type, const int dimension)
{
  return dimension == 3   ? type == 4 || type == 11
         : dimension == 2 ? type == 2 || type == 9
                          : type == 1 || type == 8;
}

/// Gmsh's order of the last two middle nodes of a tetrahedron is the other way round.
unsigned int node_in_gmsh(const unsigned int node, const unsigned int n_nodes)
{
  return n_nodes == 10 && node >= 8 ? 17 - node : node;
}

NodeNumbers take_nodes(FileMesh &mesh)
{
  std::vector<std::size_t> tags;
  std::vector<double> coordinates, parametric;
  gmsh::model::mesh::getNodes(tags, coordinates, parametric);
  NodeNumbers numbers;
  for (std::size_t i = 0; i < tags.size(); ++i)
    if (numbers.emplace(tags[i], mesh.nodes.size()).second)
      mesh.nodes.push_back({coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]});
  return numbers;
}

std::string name_of_type(const int type)
{
  std::string name;
  int dimension = 0, order = 0, n_nodes = 0, n_primary = 0;
  std::vector<double> coordinates;
  gmsh::model::mesh::getElementProperties(type, name, dimension, order, n_nodes, coordinates, n_primary);
  return name;
}

/// Calls `take(type, tag, nodes)` for every element of an entity.
template <typename Take>
void for_each_element(const Entity &entity, const Take &take)
{
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> tags, nodes;
  gmsh::model::mesh::getElements(types, tags, nodes, entity.first, entity.second);
  for (std::size_t t = 0; t < types.size(); ++t)
    for (std::size_t e = 0; e < tags[t].size(); ++e)
    {
      const std::size_t n_nodes = nodes[t].size() / tags[t].size();
      take(types[t], tags[t][e], nodes[t].data() + e * n_nodes, static_cast<unsigned int>(n_nodes));
    }
}

/// Appends the cells of an entity; returns their numbers in `mesh`.
std::vector<unsigned int> take_cells(const Entity &entity, const NodeNumbers &numbers, FileMesh &mesh)
{
  std::vector<unsigned int> taken;
  for_each_element(
      entity,
      [&](const int type, const std::size_t tag, const std::size_t *nodes, const unsigned int n_nodes)
      {
        if (!is_simplex(type, entity.first))
          throw InputError(
              Complaint(fmt::format("the mesh has cells that are no {}",
                                    entity.first == 3 ? "tetrahedra" : "triangles"))
                  .at(fmt::format("{}, cell {}", mesh.file, tag))
                  .found(name_of_type(type))
                  .expected(entity.first == 3 ? "tetrahedra of 4 or 10 nodes" : "triangles of 3 or 6 nodes")
                  .advise("mesh the body with such cells only"));
        FileMesh::Cell cell;
        cell.number = tag;
        cell.block = entity.second;
        cell.n_nodes = n_nodes;
        for (unsigned int v = 0; v < n_nodes; ++v)
          cell.nodes[v] = numbers.at(nodes[node_in_gmsh(v, n_nodes)]);
        taken.push_back(mesh.cells.size());
        mesh.cells.push_back(cell);
      });
  return taken;
}

void take_faces(const Entity &entity, const NodeNumbers &numbers, const FileMesh &mesh,
                FileMesh::Boundary &boundary)
{
  for_each_element(
      entity,
      [&](const int type, std::size_t /*tag*/, const std::size_t *nodes, unsigned int /*n_nodes*/)
      {
        if (!is_simplex(type, entity.first))
          return;
        FileMesh::FaceVertices face{};
        for (unsigned int v = 0; v < mesh.dimension; ++v)
          face[v] = numbers.at(nodes[v]);
        boundary.faces.push_back(face);
      });
}

/// Calls `take(name, tags of the entities)` for every physical group of a dimension.
template <typename Take>
void for_each_group(const int dimension, const Take &take)
{
  std::vector<Entity> groups;
  gmsh::model::getPhysicalGroups(groups, dimension);
  for (const Entity &group : groups)
  {
    std::string name;
    gmsh::model::getPhysicalName(dimension, group.second, name);
    std::vector<int> tags;
    gmsh::model::getEntitiesForPhysicalGroup(dimension, group.second, tags);
    take(name.empty() ? std::to_string(group.second) : name, tags);
  }
}

void refuse_higher_dimension(const FileMesh &mesh)
{
  std::vector<Entity> solids;
  gmsh::model::getEntities(solids, 3);
  for (const Entity &solid : solids)
    for_each_element(solid,
                     [&](const int type, const std::size_t tag, const std::size_t *, unsigned int)
                     {
                       throw InputError(Complaint("the mesh is three-dimensional, the scene is not")
                                            .at(fmt::format("{}, cell {}", mesh.file, tag))
                                            .found(name_of_type(type))
                                            .expected("triangles in the plane z = 0")
                                            .advise("set Dimension = 3, or give a mesh of triangles"));
                     });
}
} // namespace

void make_gmsh_mesh(const GmshSession &gmsh, const std::string &file, const unsigned int dimension,
                    const SizeField &size)
{
  const std::vector<std::pair<std::string, double>> options{
      {"Mesh.MeshSizeExtendFromBoundary", 0.},
      {"Mesh.MeshSizeFromPoints", 0.},
      {"Mesh.MeshSizeFromCurvature", 0.},
      {"Mesh.Algorithm3D", 1.}, // Delaunay: faster with its optimisation, and nearer to the sizes, than HXT
      {"Mesh.Optimize", 1.},
      {"Mesh.OptimizeThreshold", 0.5},
      {"Mesh.SecondOrderLinear", 0.}};
  // Since Gmsh 4.9 its own size comes behind the place.
  const auto size_at = [&size](int /*dimension*/, int /*tag*/, double x, double y, double z, auto...) {
    return size({x, y, z});
  };
  gmsh.run(Complaint("the shape cannot be meshed")
               .at(file)
               .advise("try another 'Element size', or mend the shape where it was made"),
           [&]()
           {
             for (const auto &[option, value] : options)
               gmsh::option::setNumber(option, value);
             gmsh::model::mesh::setSizeCallback(size_at);
             // An exception could not leave the parallel regions of the mesher: it must go on to their end.
             gmsh::option::setNumber("General.AbortOnError", 0.);
             gmsh::model::mesh::generate(static_cast<int>(dimension));
             gmsh::option::setNumber("General.AbortOnError", 2.);
             std::string error;
             gmsh::logger::getLastError(error);
             if (!error.empty())
               throw error;
           });
}

FileMesh take_gmsh_mesh(const std::string &file, const unsigned int dimension)
{
  FileMesh mesh;
  mesh.file = file;
  mesh.dimension = dimension;
  if (dimension == 2)
    refuse_higher_dimension(mesh);
  const NodeNumbers numbers = take_nodes(mesh);
  const int dim = static_cast<int>(dimension);
  std::vector<Entity> entities;
  gmsh::model::getEntities(entities, dim);
  std::map<int, std::vector<unsigned int>> cells_of;
  for (const Entity &entity : entities)
    cells_of[entity.second] = take_cells(entity, numbers, mesh);
  for_each_group(dim,
                 [&](const std::string &name, const std::vector<int> &tags)
                 {
                   FileMesh::Region region{name, {}};
                   for (const int tag : tags)
                     region.cells.insert(region.cells.end(), cells_of[tag].begin(), cells_of[tag].end());
                   if (!region.cells.empty())
                     mesh.regions.push_back(region);
                 });
  for_each_group(dim - 1,
                 [&](const std::string &name, const std::vector<int> &tags)
                 {
                   FileMesh::Boundary boundary{name, {}, {}, true};
                   for (const int tag : tags)
                     take_faces({dim - 1, tag}, numbers, mesh, boundary);
                   mesh.boundaries.push_back(boundary);
                 });
  return mesh;
}

FileMesh read_gmsh_file(const std::string &path, const unsigned int dimension)
{
  check_gmsh_format(path);
  const GmshSession gmsh;
  FileMesh mesh;
  gmsh.run(Complaint("the mesh file cannot be understood").at(path).advise("write or copy the file again"),
           [&]()
           {
             gmsh::merge(path);
             mesh = take_gmsh_mesh(path, dimension);
           });
  return mesh;
}
} // namespace signorini
