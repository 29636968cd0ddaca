// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/mesh/make_simplex_mesh.h"

#include "signorini/base/exceptions.h"
#include "signorini/mesh/check_cells.h"
#include "signorini/mesh/simplex_geometry.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

namespace signorini
{
namespace
{
constexpr unsigned int none = std::numeric_limits<unsigned int>::max();

/// Off the straight midpoint by more than this, relative to its length, an edge is curved.
constexpr double straightness = 1e-12;

const char *const unnamed = "rest";

std::string join_names(const std::vector<FileMesh::Region> &regions)
{
  std::string names;
  for (const FileMesh::Region &region : regions)
    names += (names.empty() ? "" : ", ") + region.name;
  return names.empty() ? "none: the file names no regions" : "one of " + names;
}

/// [cell] → index into `regions`; the first that has it; `none` if no region has it.
std::vector<unsigned int> find_regions(const FileMesh &mesh, const std::vector<FileMesh::Region> &regions)
{
  std::vector<unsigned int> of_cells(mesh.cells.size(), none);
  for (unsigned int r = regions.size(); r-- > 0;)
    for (const unsigned int cell : regions[r].cells)
      of_cells[cell] = r;
  return of_cells;
}

/// Keeps the cells for which it is true, and their nodes; sets and faces with a node that is left out go.
void keep_cells(FileMesh &mesh, const std::vector<bool> &is_kept)
{
  std::vector<unsigned int> new_number(mesh.nodes.size(), none);
  std::vector<FileMesh::Cell> cells;
  std::vector<Triple> nodes;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    if (is_kept[c])
    {
      cells.push_back(mesh.cells[c]);
      for (unsigned int v = 0; v < cells.back().n_nodes; ++v)
      {
        unsigned int &node = cells.back().nodes[v];
        if (new_number[node] == none)
        {
          new_number[node] = nodes.size();
          nodes.push_back(mesh.nodes[node]);
        }
        node = new_number[node];
      }
    }
  mesh.cells = std::move(cells);
  mesh.nodes = std::move(nodes);
  for (FileMesh::Boundary &boundary : mesh.boundaries)
  {
    const auto is_gone = [&new_number](const unsigned int node)
    { return node == none || new_number[node] == none; };
    for (FileMesh::FaceVertices &face : boundary.faces)
      if (std::any_of(face.begin(), face.begin() + mesh.dimension, is_gone))
        face.fill(none);
      else
        std::transform(face.begin(), face.begin() + mesh.dimension, face.begin(),
                       [&new_number](const unsigned int node) { return new_number[node]; });
    boundary.nodes.erase(std::remove_if(boundary.nodes.begin(), boundary.nodes.end(), is_gone),
                         boundary.nodes.end());
    for (unsigned int &node : boundary.nodes)
      node = new_number[node];
  }
}

FileMesh::FaceVertices sorted(FileMesh::FaceVertices face, const unsigned int dimension)
{
  if (dimension == 3)
    std::sort(face.begin(), face.end());
  else if (face[0] > face[1])
    std::swap(face[0], face[1]);
  return face;
}

/// The outer faces, vertices in ascending order, themselves in order. Throws for a face that three cells
/// share.
std::vector<FileMesh::FaceVertices> find_outer_faces(const FileMesh &mesh)
{
  struct FaceOfCell
  {
    FileMesh::FaceVertices vertices;
    unsigned int cell;
    bool operator<(const FaceOfCell &other) const
    {
      return vertices != other.vertices ? vertices < other.vertices : cell < other.cell;
    }
  };
  std::vector<FaceOfCell> all;
  for (unsigned int c = 0; c < mesh.cells.size(); ++c)
    for (unsigned int opposite = 0; opposite < mesh.n_corners(); ++opposite)
    {
      FileMesh::FaceVertices face{};
      for (unsigned int v = 0, n = 0; v < mesh.n_corners(); ++v)
        if (v != opposite)
          face[n++] = mesh.cells[c].nodes[v];
      all.push_back({sorted(face, mesh.dimension), c});
    }
  std::sort(all.begin(), all.end());
  std::vector<FileMesh::FaceVertices> outer;
  for (std::size_t first = 0, end = 0; first < all.size(); first = end)
  {
    while (end < all.size() && all[end].vertices == all[first].vertices)
      ++end;
    if (end - first > 2)
      throw InputError(Complaint("more than two cells have a face in common")
                           .at(mesh.file + ", " + describe_cell(mesh, mesh.cells[all[first].cell]))
                           .found(fmt::format("{} cells, the second and third are {} and {}", end - first,
                                              describe_cell(mesh, mesh.cells[all[first + 1].cell]),
                                              describe_cell(mesh, mesh.cells[all[first + 2].cell])))
                           .expected("two, or one at the boundary")
                           .advise("mend the mesh where it was made: cells overlap there"));
    if (end - first == 1)
      outer.push_back(all[first].vertices);
  }
  return outer;
}

/// Gives outer faces their boundaries, one after the other.
class BoundaryNaming
{
public:
  BoundaryNaming(const FileMesh &file_mesh, std::vector<FileMesh::FaceVertices> outer)
      : mesh(file_mesh), faces(std::move(outer)), boundary_of(faces.size(), none)
  {
  }

  void name(const FileMesh::Boundary &boundary)
  {
    const std::vector<std::size_t> members =
        boundary.nodes.empty() ? find_members(boundary) : find_between(boundary);
    if (members.empty())
      return;
    for (const std::size_t face : members)
      if (boundary_of[face] != none)
      {
        if (boundary.is_surface)
          refuse(faces[face], boundary.name, names[boundary_of[face]]);
        return;
      }
    for (const std::size_t face : members)
      boundary_of[face] = names.size();
    names.push_back(boundary.name);
  }

  void finish(SimplexMesh &result)
  {
    const auto is_nameless = [](const unsigned int boundary) { return boundary == none; };
    if (std::any_of(boundary_of.begin(), boundary_of.end(), is_nameless))
    {
      if (std::find(names.begin(), names.end(), unnamed) != names.end())
        throw InputError(
            Complaint(fmt::format("a boundary is called '{}', the name of outer faces without one", unnamed))
                .at(mesh.file)
                .advise("give it another name in the mesh file"));
      std::replace_if(boundary_of.begin(), boundary_of.end(), is_nameless,
                      static_cast<unsigned int>(names.size()));
      names.emplace_back(unnamed);
    }
    result.boundary_names = names;
    for (std::size_t face = 0; face < faces.size(); ++face)
      result.faces.push_back({faces[face], boundary_of[face]});
  }

private:
  /// Outer faces among those of the boundary, each once.
  std::vector<std::size_t> find_members(const FileMesh::Boundary &boundary) const
  {
    std::vector<std::size_t> members;
    for (const FileMesh::FaceVertices &face : boundary.faces)
    {
      const FileMesh::FaceVertices key = sorted(face, mesh.dimension);
      const auto found = std::lower_bound(faces.begin(), faces.end(), key);
      if (found != faces.end() && *found == key)
        members.push_back(found - faces.begin());
    }
    std::sort(members.begin(), members.end());
    members.erase(std::unique(members.begin(), members.end()), members.end());
    return members;
  }

  /// Outer faces all of whose vertices are in the set; none for a set of all nodes, which names nothing.
  std::vector<std::size_t> find_between(const FileMesh::Boundary &boundary) const
  {
    std::vector<bool> is_in(mesh.nodes.size(), false);
    for (const unsigned int node : boundary.nodes)
      is_in[node] = true;
    std::vector<std::size_t> members;
    for (std::size_t face = 0; face < faces.size(); ++face)
      if (std::all_of(faces[face].begin(), faces[face].begin() + mesh.dimension,
                      [&is_in](const unsigned int vertex) { return is_in[vertex]; }))
        members.push_back(face);
    return members.size() == faces.size() ? std::vector<std::size_t>{} : members;
  }

  [[noreturn]] void refuse(const FileMesh::FaceVertices &face, const std::string &name,
                           const std::string &other) const
  {
    Triple centre{};
    for (unsigned int v = 0; v < mesh.dimension; ++v)
      for (unsigned int c = 0; c < 3; ++c)
        centre[c] += mesh.nodes[face[v]][c] / mesh.dimension;
    throw InputError(Complaint("a face belongs to two boundaries")
                         .at(mesh.file)
                         .found(fmt::format("'{}' and '{}' at ({:.6g}, {:.6g}, {:.6g})", other, name,
                                            centre[0], centre[1], centre[2]))
                         .expected("one boundary for each face")
                         .advise("split the boundaries in the mesh file so that they share no face"));
  }

  const FileMesh &mesh;
  std::vector<FileMesh::FaceVertices> faces;
  std::vector<unsigned int> boundary_of;
  std::vector<std::string> names;
};

/// Corners get numbers of their own; middle nodes of curved edges go into the map.
void take_cells(const FileMesh &mesh, SimplexMesh &result)
{
  std::vector<unsigned int> vertex_of(mesh.nodes.size(), none);
  for (const FileMesh::Cell &cell : mesh.cells)
  {
    std::array<unsigned int, 4> corners{};
    for (unsigned int v = 0; v < mesh.n_corners(); ++v)
    {
      unsigned int &vertex = vertex_of[cell.nodes[v]];
      if (vertex == none)
      {
        vertex = result.vertices.size();
        result.vertices.push_back(mesh.nodes[cell.nodes[v]]);
      }
      corners[v] = vertex;
    }
    result.cells.push_back(corners);
    for (unsigned int e = 0; mesh.n_corners() + e < cell.n_nodes; ++e)
    {
      const auto [a, b] = std::minmax(corners[edges_of_cell[e][0]], corners[edges_of_cell[e][1]]);
      const Triple &middle = mesh.nodes[cell.nodes[mesh.n_corners() + e]];
      const Triple &first = result.vertices[a], &second = result.vertices[b];
      if (distance(middle, midpoint(first, second)) > straightness * distance(first, second))
        result.edge_midpoints[{a, b}] = middle;
    }
  }
  for (SimplexMesh::Face &face : result.faces)
    std::transform(face.vertices.begin(), face.vertices.begin() + mesh.dimension, face.vertices.begin(),
                   [&vertex_of](const unsigned int node) { return vertex_of[node]; });
}
} // namespace

std::vector<FileMesh::Region> choose_regions(const FileMesh &mesh, const std::vector<std::string> &chosen)
{
  if (chosen.empty())
    return mesh.regions;
  std::vector<FileMesh::Region> regions;
  std::vector<std::string> names;
  for (const FileMesh::Region &region : mesh.regions)
    names.push_back(region.name);
  for (const std::string &name : chosen)
  {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
    {
      const bool is_boundary =
          std::any_of(mesh.boundaries.begin(), mesh.boundaries.end(),
                      [&name](const FileMesh::Boundary &boundary) { return boundary.name == name; });
      throw InputError(Complaint(is_boundary ? "the file has a boundary of this name, but no such region"
                                             : "the mesh file has no such region")
                           .at(mesh.file)
                           .found(name)
                           .expected(join_names(mesh.regions))
                           .did_you_mean(nearest_name(name, names))
                           .advise("correct 'Regions', or leave it out to take all cells"));
    }
    regions.push_back(mesh.regions[found - names.begin()]);
  }
  return regions;
}

SimplexMesh make_simplex_mesh(const FileMesh &file_mesh, const std::vector<std::string> &chosen)
{
  FileMesh mesh = file_mesh;
  const std::vector<FileMesh::Region> regions = choose_regions(mesh, chosen);
  const std::vector<unsigned int> region_of = find_regions(mesh, regions);
  std::vector<bool> is_kept(mesh.cells.size(), true);
  SimplexMesh result;
  result.dimension = mesh.dimension;
  for (const FileMesh::Region &region : regions)
    result.region_names.push_back(region.name);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
  {
    is_kept[c] = chosen.empty() || region_of[c] != none;
    if (is_kept[c])
      result.regions.push_back(region_of[c] == none ? static_cast<unsigned int>(regions.size())
                                                    : region_of[c]);
  }
  if (std::find(result.regions.begin(), result.regions.end(), regions.size()) != result.regions.end())
    result.region_names.emplace_back(unnamed);
  keep_cells(mesh, is_kept);
  if (mesh.cells.empty())
    throw InputError(Complaint(mesh.dimension == 3 ? "there is no tetrahedron" : "there is no triangle")
                         .at(mesh.file)
                         .expected(mesh.dimension == 3 ? "a mesh of tetrahedra" : "a mesh of triangles")
                         .advise("check the mesh file, 'Regions' and 'Dimension'"));
  check_cells(mesh);
  BoundaryNaming naming(mesh, find_outer_faces(mesh));
  for (const FileMesh::Boundary &boundary : mesh.boundaries)
    naming.name(boundary);
  naming.finish(result);
  take_cells(mesh, result);
  return result;
}
} // namespace signorini
