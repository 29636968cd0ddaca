// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/parameters/mesh_parameters.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace signorini
{
namespace
{
/// Points on the axes of a part of a ball.
std::vector<Triple> ball_points(const MeshParameters &mesh, const unsigned int dimension)
{
  std::vector<Triple> points;
  for (unsigned int c = 0; c < dimension; ++c)
  {
    Triple point{};
    point[c] = mesh.radius;
    points.push_back(point);
    const bool cut = mesh.part == MeshParameters::Part::orthant ||
                     (mesh.part == MeshParameters::Part::half && c + 1 == dimension);
    point[c] = -mesh.radius;
    if (!cut)
      points.push_back(point);
  }
  return points;
}

std::vector<Triple> cylinder_points(const MeshParameters &mesh)
{
  std::vector<Triple> points;
  for (const double z : {-mesh.length / 2, mesh.length / 2})
  {
    for (const double sign : {-1., 1.})
    {
      points.push_back({sign * mesh.radius, 0., z});
      points.push_back({0., sign * mesh.radius, z});
    }
  }
  return points;
}

std::vector<Triple> box_points(const MeshParameters &mesh, const unsigned int dimension)
{
  std::vector<Triple> points;
  for (unsigned int corner = 0; corner < (1u << dimension); ++corner)
  {
    Triple point{};
    for (unsigned int c = 0; c < dimension; ++c)
      point[c] = (corner >> c & 1u) != 0 ? mesh.upper_corner[c] : mesh.lower_corner[c];
    points.push_back(point);
  }
  return points;
}

/// The component and the value that all points of a plane boundary share; nothing for a curved one.
std::optional<std::pair<unsigned int, double>>
plane_of(const MeshParameters &mesh, const unsigned int dimension, const std::string &boundary)
{
  const unsigned int last = dimension - 1;
  if (mesh.shape == MeshParameters::Shape::ball)
  {
    const std::size_t component = std::string("xyz").find(boundary);
    return component == std::string::npos
               ? std::nullopt
               : std::optional(std::pair(static_cast<unsigned int>(component), 0.));
  }
  if (mesh.shape == MeshParameters::Shape::cylinder)
    return boundary == "side" ? std::nullopt
                              : std::optional(std::pair(2u, (boundary == "top" ? 0.5 : -0.5) * mesh.length));
  const unsigned int component = boundary == "left" || boundary == "right"   ? 0u
                                 : boundary == "front" || boundary == "back" ? 1u
                                                                             : last;
  const bool upper = boundary == "right" || boundary == "back" || boundary == "top";
  return std::pair(component, upper ? mesh.upper_corner[component] : mesh.lower_corner[component]);
}

/// What knows the boundaries of a file, whether it holds a mesh or a shape.
const SimplexMesh &faces_of_file(const MeshParameters &mesh)
{
  return mesh.mesh_of_file ? *mesh.mesh_of_file : *mesh.surface_of_file;
}

std::vector<Triple> points_of_file(const SimplexMesh &mesh, const std::string &boundary)
{
  std::vector<bool> is_on_it(mesh.vertices.size(), false);
  for (const SimplexMesh::Face &face : mesh.faces)
    if (mesh.boundary_names[face.boundary] == boundary)
      for (unsigned int v = 0; v < mesh.dimension; ++v)
        is_on_it[face.vertices[v]] = true;
  std::vector<Triple> points;
  for (std::size_t vertex = 0; vertex < is_on_it.size(); ++vertex)
    if (is_on_it[vertex])
      points.push_back(mesh.vertices[vertex]);
  return points;
}
} // namespace

std::vector<std::string> boundary_names(const MeshParameters &mesh, const unsigned int dimension)
{
  switch (mesh.shape)
  {
  case MeshParameters::Shape::file:
    return faces_of_file(mesh).boundary_names;
  case MeshParameters::Shape::cylinder:
    return {"side", "bottom", "top"};
  case MeshParameters::Shape::ball:
    if (mesh.part == MeshParameters::Part::whole)
      return {"surface"};
    if (mesh.part == MeshParameters::Part::half)
      return {"surface", dimension == 3 ? "z" : "y"};
    return dimension == 3 ? std::vector<std::string>{"surface", "x", "y", "z"}
                          : std::vector<std::string>{"surface", "x", "y"};
  default:
    return dimension == 3 ? std::vector<std::string>{"left", "right", "front", "back", "bottom", "top"}
                          : std::vector<std::string>{"left", "right", "bottom", "top"};
  }
}

std::vector<Triple> boundary_points(const MeshParameters &mesh, const unsigned int dimension,
                                    const std::string &boundary)
{
  if (mesh.shape == MeshParameters::Shape::file)
    return points_of_file(faces_of_file(mesh), boundary);
  std::vector<Triple> points = mesh.shape == MeshParameters::Shape::box    ? box_points(mesh, dimension)
                               : mesh.shape == MeshParameters::Shape::ball ? ball_points(mesh, dimension)
                                                                           : cylinder_points(mesh);
  if (const auto plane = plane_of(mesh, dimension, boundary))
    points.erase(std::remove_if(points.begin(), points.end(),
                                [&plane](const Triple &point)
                                { return point[plane->first] != plane->second; }),
                 points.end());
  return points;
}

double largest_extent(const MeshParameters &mesh, const unsigned int dimension)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Triple low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
  for (const std::string &boundary : boundary_names(mesh, dimension))
    for (const Triple &point : boundary_points(mesh, dimension, boundary))
      for (unsigned int c = 0; c < dimension; ++c)
      {
        low[c] = std::min(low[c], point[c]);
        high[c] = std::max(high[c], point[c]);
      }
  double largest = 0.;
  for (unsigned int c = 0; c < dimension; ++c)
    largest = std::max(largest, high[c] - low[c]);
  return largest;
}
} // namespace signorini
