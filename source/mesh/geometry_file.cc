// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/mesh/geometry_file.h"

#include "signorini/mesh/file_content.h"
#include "signorini/mesh/gmsh_model.h"
#include "signorini/mesh/make_simplex_mesh.h"

#include <fmt/format.h>
#include <gmsh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace signorini
{
namespace
{
enum class Format
{
  step,
  brep,
  stl
};

constexpr double degree = 3.14159265358979323846 / 180.;

/// Of the first look, relative to the diagonal of the shape.
constexpr double size_of_look = 0.02;

const std::vector<std::pair<std::string, Format>> &endings()
{
  static const std::vector<std::pair<std::string, Format>> table{
      {".step", Format::step}, {".stp", Format::step}, {".brep", Format::brep}, {".stl", Format::stl}};
  return table;
}

const std::pair<std::string, Format> *find_ending(const std::string &path)
{
  const std::string ending = ending_of(path);
  for (const auto &entry : endings())
    if (entry.first == ending)
      return &entry;
  return nullptr;
}

/// OpenCASCADE prints its complaints: what it cannot read must not get there.
void check_content(const std::string &path, const Format format)
{
  const std::string content = read_content(path);
  const auto has = [&content](const std::string &mark) { return content.find(mark) != std::string::npos; };
  const bool is_complete = format == Format::step   ? has("ISO-10303-21;") && has("END-ISO-10303-21")
                           : format == Format::brep ? has("CASCADE Topology") && has("TShapes")
                                                    : content.size() > 84;
  if (!is_complete)
    throw InputError(
        Complaint(content.empty() ? "the file is empty" : "the file holds no shape, or is cut off")
            .at(path)
            .expected(format == Format::step   ? "ISO-10303-21; … END-ISO-10303-21;"
                      : format == Format::brep ? "a shape as OpenCASCADE writes it"
                                               : "triangles in STL's text or binary form")
            .advise("write or copy the file again"));
}

std::vector<int> tags_of(const unsigned int dimension)
{
  std::vector<std::pair<int, int>> entities;
  gmsh::model::getEntities(entities, static_cast<int>(dimension));
  std::vector<int> tags;
  for (const auto &entity : entities)
    tags.push_back(entity.second);
  return tags;
}

void add_group(const unsigned int dimension, const std::vector<int> &tags, const std::string &name)
{
  const int group = gmsh::model::addPhysicalGroup(static_cast<int>(dimension), tags);
  gmsh::model::setPhysicalName(static_cast<int>(dimension), group, name);
}

void load_solids(const std::string &path, const unsigned int dimension)
{
  std::vector<std::pair<int, int>> shapes;
  gmsh::model::occ::importShapes(path, shapes);
  if (shapes.size() > 1) // touching ones shall share their faces
    gmsh::model::occ::removeAllDuplicates();
  gmsh::model::occ::synchronize();
  const std::array<std::string, 4> names{"", "curve", "surface", "volume"};
  for (const unsigned int dim : {dimension, dimension - 1})
    for (const int tag : tags_of(dim))
      add_group(dim, {tag}, fmt::format("{}_{}", names[dim], tag));
}

/// Throws unless every edge belongs to two triangles.
void check_closed(const std::string &path)
{
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> tags, nodes;
  gmsh::model::mesh::getElements(types, tags, nodes, 2);
  std::map<std::pair<std::size_t, std::size_t>, unsigned int> n_triangles;
  for (const std::vector<std::size_t> &of_type : nodes)
    for (std::size_t first = 0; first + 2 < of_type.size(); first += 3)
      for (std::size_t v = 0; v < 3; ++v)
        ++n_triangles[std::minmax(of_type[first + v], of_type[first + (v + 1) % 3])];
  const auto n_open = std::count_if(n_triangles.begin(), n_triangles.end(),
                                    [](const auto &edge) { return edge.second != 2; });
  if (n_open > 0 || n_triangles.empty())
    throw InputError(Complaint("the surface is not closed")
                         .at(path)
                         .found(fmt::format("{} edges that do not belong to two triangles", n_open))
                         .expected("the whole surface of one body")
                         .advise("mend the surface where it was made"));
}

void load_surface(const std::string &path)
{
  gmsh::merge(path);
  check_closed(path);
  gmsh::model::mesh::classifySurfaces(40. * degree, true, true, 180. * degree);
  gmsh::model::mesh::createGeometry();
  const std::vector<int> surfaces = tags_of(2);
  const int volume = gmsh::model::geo::addVolume({gmsh::model::geo::addSurfaceLoop(surfaces)});
  gmsh::model::geo::synchronize();
  add_group(3, {volume}, "volume_1");
  add_group(2, surfaces, "surface");
}

/// Names of the boundaries between the chosen regions and the outside.
std::set<std::string> find_outer_boundaries(const unsigned int dimension,
                                            const std::vector<std::string> &regions)
{
  const int dim = static_cast<int>(dimension);
  const auto group_of = [](const int of_dimension, const int tag)
  {
    std::vector<int> groups;
    std::string name;
    gmsh::model::getPhysicalGroupsForEntity(of_dimension, tag, groups);
    gmsh::model::getPhysicalName(of_dimension, groups.at(0), name);
    return name;
  };
  std::set<std::string> outer;
  for (const int tag : tags_of(dimension - 1))
  {
    std::vector<int> solids, ignored;
    gmsh::model::getAdjacencies(dim - 1, tag, solids, ignored);
    const auto n_chosen = std::count_if(
        solids.begin(), solids.end(),
        [&](const int solid)
        { return regions.empty() || std::count(regions.begin(), regions.end(), group_of(dim, solid)) > 0; });
    if (n_chosen == 1)
      outer.insert(group_of(dim - 1, tag));
  }
  return outer;
}

double diagonal_of_model()
{
  Triple low{}, high{};
  gmsh::model::getBoundingBox(-1, -1, low[0], low[1], low[2], high[0], high[1], high[2]);
  return std::sqrt(std::pow(high[0] - low[0], 2) + std::pow(high[1] - low[1], 2) +
                   std::pow(high[2] - low[2], 2));
}

/// Throws InputError for a region that the shape does not have.
void check_regions(const std::string &path, const unsigned int dimension,
                   const std::vector<std::string> &regions)
{
  FileMesh shape;
  shape.file = path;
  std::vector<std::pair<int, int>> groups;
  gmsh::model::getPhysicalGroups(groups);
  for (const auto &[dim, tag] : groups)
  {
    std::string name;
    gmsh::model::getPhysicalName(dim, tag, name);
    if (dim == static_cast<int>(dimension))
      shape.regions.push_back({name, {}});
    else
      shape.boundaries.push_back({name, {}, {}});
  }
  choose_regions(shape, regions);
}
} // namespace

std::vector<std::string> geometry_file_endings()
{
  std::vector<std::string> names;
  for (const auto &entry : endings())
    names.push_back(entry.first);
  return names;
}

bool is_geometry_file(const std::string &path)
{
  return find_ending(path) != nullptr;
}

double load_geometry(const GmshSession &gmsh, const std::string &path, const unsigned int dimension)
{
  const Format format = find_ending(path)->second;
  check_content(path, format);
  if (format == Format::stl && dimension == 2)
    throw InputError(Complaint("an STL file holds the surface of a solid, but the scene has two dimensions")
                         .at(path)
                         .expected("a plane face in a STEP or BREP file, or a mesh of triangles")
                         .advise("set Dimension = 3, or give another file"));
  gmsh.run(Complaint("the shape cannot be understood").at(path).advise("write or copy the file again"),
           [&]()
           {
             if (format == Format::stl)
               load_surface(path);
             else
               load_solids(path, dimension);
           });
  if (tags_of(dimension).empty() || (dimension == 2 && !tags_of(3).empty()))
    throw InputError(
        Complaint(dimension == 3 ? "the file holds no solid" : "the file holds no plane face")
            .at(path)
            .found(fmt::format("{} solids, {} faces", tags_of(3).size(), tags_of(2).size()))
            .advise(dimension == 3 ? "write the shape as a solid" : "write a face in the plane z = 0"));
  constexpr double millimetre = 1e-3; // OpenCASCADE turns the unit of a STEP file into it
  return format == Format::step ? millimetre : 1.;
}

SimplexMesh read_geometry_file(const std::string &path, const unsigned int dimension,
                               const std::vector<std::string> &regions)
{
  const GmshSession gmsh;
  const double unit = load_geometry(gmsh, path, dimension);
  check_regions(path, dimension, regions);
  const double size = size_of_look * diagonal_of_model();
  make_gmsh_mesh(gmsh, path, dimension - 1, [size](const Triple & /*point*/) { return size; });
  const FileMesh mesh = take_gmsh_mesh(path, dimension);
  const std::set<std::string> outer = find_outer_boundaries(dimension, regions);

  SimplexMesh surface;
  surface.dimension = dimension;
  std::vector<unsigned int> vertex_of(mesh.nodes.size(), std::numeric_limits<unsigned int>::max());
  for (const FileMesh::Boundary &boundary : mesh.boundaries)
    if (outer.count(boundary.name) > 0)
    {
      for (FileMesh::FaceVertices face : boundary.faces)
      {
        for (unsigned int v = 0; v < dimension; ++v)
        {
          const Triple &node = mesh.nodes[face[v]];
          unsigned int &vertex = vertex_of[face[v]];
          if (vertex == std::numeric_limits<unsigned int>::max())
          {
            vertex = surface.vertices.size();
            surface.vertices.push_back({unit * node[0], unit * node[1], unit * node[2]});
          }
          face[v] = vertex;
        }
        surface.faces.push_back({face, static_cast<unsigned int>(surface.boundary_names.size())});
      }
      surface.boundary_names.push_back(boundary.name);
    }
  return surface;
}
} // namespace signorini
