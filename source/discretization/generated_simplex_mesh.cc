// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/discretization/generated_simplex_mesh.h"

#include "signorini/discretization/body_mesh.h"
#include "signorini/discretization/cut_box.h"
#include "signorini/mesh/geometry_file.h"
#include "signorini/mesh/gmsh_model.h"
#include "signorini/mesh/make_simplex_mesh.h"
#include "signorini/mesh/simplex_geometry.h"
#include "signorini/parameters/mesh_parameters.h"

#include <gmsh.h>

#include <algorithm>
#include <limits>

namespace signorini
{
namespace
{
namespace occ = gmsh::model::occ;
using Entities = std::vector<std::pair<int, int>>;

/// Own coordinates are origin + length times those of Gmsh's model, whose tolerances are made for lengths
/// about 1.
struct Unit
{
  Triple origin{};
  double length = 1.;

  Triple own(const Triple &x) const
  {
    return {origin[0] + length * x[0], origin[1] + length * x[1], origin[2] + length * x[2]};
  }
};

Unit make_box(const MeshParameters &parameters, const unsigned int dimension)
{
  Unit unit{parameters.lower_corner, 0.};
  Triple size{};
  for (unsigned int d = 0; d < dimension; ++d)
  {
    size[d] = parameters.upper_corner[d] - parameters.lower_corner[d];
    unit.length = std::max(unit.length, size[d]);
  }
  for (double &extent : size)
    extent /= unit.length;
  if (dimension == 3)
    occ::addBox(0., 0., 0., size[0], size[1], size[2]);
  else
    occ::addRectangle(0., 0., 0., size[0], size[1]);
  return unit;
}

/// The part of a unit ball or disk on the upper side of the cuts.
Unit make_ball(const MeshParameters &parameters, const unsigned int dimension)
{
  const int dim = static_cast<int>(dimension);
  const int ball = dimension == 3 ? occ::addSphere(0., 0., 0., 1.) : occ::addDisk(0., 0., 0., 1., 1.);
  if (parameters.part != MeshParameters::Part::whole)
  {
    Triple low{-2., -2., -2.};
    for (unsigned int d = 0; d < dimension; ++d)
      if (parameters.part == MeshParameters::Part::orthant || d + 1 == dimension)
        low[d] = 0.;
    const int kept = dimension == 3 ? occ::addBox(low[0], low[1], low[2], 4., 4., 4.)
                                    : occ::addRectangle(low[0], low[1], 0., 4., 4.);
    Entities result;
    std::vector<Entities> origins;
    occ::intersect({{dim, ball}}, {{dim, kept}}, result, origins);
  }
  return {{}, parameters.radius};
}

Unit make_cylinder(const MeshParameters &parameters)
{
  const double unit = std::max(parameters.radius, parameters.length);
  const double length = parameters.length / unit;
  occ::addCylinder(0., 0., -length / 2., 0., 0., length, parameters.radius / unit);
  return {{}, unit};
}

/// The greatest distance of some points of a face (an edge in 2-D) of the model from a boundary.
double farthest_from(const std::string &boundary, const MeshParameters &parameters,
                     const std::vector<Triple> &points, const unsigned int dimension)
{
  double farthest = 0.;
  for (const Triple &x : points)
    farthest = std::max(
        farthest, dimension == 3
                      ? distance_to_boundary<3>(parameters, boundary, dealii::Point<3>(x[0], x[1], x[2]))
                      : distance_to_boundary<2>(parameters, boundary, dealii::Point<2>(x[0], x[1])));
  return farthest;
}

/// Points all over the surface (curve) that carries a face of the model.
std::vector<Triple> sample(const std::pair<int, int> &face, const Unit &unit)
{
  std::vector<double> low, high, parametric, coordinates;
  gmsh::model::getParametrizationBounds(face.first, face.second, low, high);
  for (const double first : {0.1, 0.4, 0.8})
    for (const double second : {0.2, 0.5, 0.7})
    {
      parametric.push_back(low[0] + first * (high[0] - low[0]));
      if (face.first == 2)
        parametric.push_back(low[1] + second * (high[1] - low[1]));
    }
  gmsh::model::getValue(face.first, face.second, parametric, coordinates);
  std::vector<Triple> points;
  for (std::size_t i = 0; i < coordinates.size(); i += 3)
    points.push_back(unit.own({coordinates[i], coordinates[i + 1], coordinates[i + 2]}));
  return points;
}

/// Every face of the model becomes part of the boundary it lies on.
void name_boundaries(const MeshParameters &parameters, const unsigned int dimension, const Unit &unit)
{
  const std::vector<std::string> names = boundary_names(parameters, dimension);
  std::vector<std::vector<int>> tags(names.size());
  Entities faces;
  gmsh::model::getEntities(faces, static_cast<int>(dimension) - 1);
  for (const std::pair<int, int> &face : faces)
  {
    const std::vector<Triple> points = sample(face, unit);
    std::vector<double> distances;
    for (const std::string &name : names)
      distances.push_back(farthest_from(name, parameters, points, dimension));
    tags[std::min_element(distances.begin(), distances.end()) - distances.begin()].push_back(face.second);
  }
  for (std::size_t boundary = 0; boundary < names.size(); ++boundary)
    if (!tags[boundary].empty())
      gmsh::model::setPhysicalName(
          faces[0].first, gmsh::model::addPhysicalGroup(faces[0].first, tags[boundary]), names[boundary]);
}

Unit make_shape(const GmshSession &gmsh, const MeshParameters &parameters, const unsigned int dimension)
{
  if (parameters.shape == MeshParameters::Shape::file)
    return {{}, load_geometry(gmsh, parameters.file, dimension)};
  Unit unit;
  gmsh.run(Complaint("the shape cannot be made"),
           [&]()
           {
             if (parameters.shape == MeshParameters::Shape::box)
               unit = make_box(parameters, dimension);
             else if (parameters.shape == MeshParameters::Shape::ball)
               unit = make_ball(parameters, dimension);
             else
               unit = make_cylinder(parameters);
             occ::synchronize();
             name_boundaries(parameters, dimension, unit);
           });
  return unit;
}

/// Makes the edges of cells straight that are folded, until none is: their neighbours may become so by it.
void straighten_folded_cells(FileMesh &mesh)
{
  for (bool is_changed = true; is_changed;)
  {
    is_changed = false;
    for (const FileMesh::Cell &cell : mesh.cells)
    {
      QuadraticCell nodes{};
      for (unsigned int v = 0; v < cell.n_nodes; ++v)
        nodes[v] = mesh.nodes[cell.nodes[v]];
      if (least_relative_jacobian(nodes, mesh.dimension) > 0.)
        continue;
      is_changed = true;
      for (unsigned int e = 0; mesh.n_corners() + e < cell.n_nodes; ++e)
        mesh.nodes[cell.nodes[mesh.n_corners() + e]] =
            midpoint(nodes[edges_of_cell[e][0]], nodes[edges_of_cell[e][1]]);
    }
  }
}
} // namespace

SimplexMesh generate_simplex_mesh(const MeshParameters &parameters, const unsigned int dimension,
                                  const unsigned int degree, const SizeField &size)
{
  const GmshSession gmsh;
  const Unit unit = make_shape(gmsh, parameters, dimension);
  const std::string name =
      parameters.shape == MeshParameters::Shape::file ? parameters.file : "generated mesh";
  make_gmsh_mesh(gmsh, name, dimension, [&](const Triple &x) { return size(unit.own(x)) / unit.length; });
  if (degree == 2)
    gmsh.run(Complaint("the mesh cannot be made quadratic").at(name),
             []() { gmsh::model::mesh::setOrder(2); });
  FileMesh mesh = take_gmsh_mesh(name, dimension);
  for (Triple &node : mesh.nodes)
    node = unit.own(node);
  if (degree == 2)
    straighten_folded_cells(mesh);
  return make_simplex_mesh(mesh, parameters.regions);
}

SimplexMesh make_simplex_body_mesh(const MeshParameters &parameters, const unsigned int dimension,
                                   const unsigned int degree)
{
  if (parameters.mesh_of_file)
    return *parameters.mesh_of_file;
  if (parameters.element_size == 0.)
    return make_cut_box(parameters, dimension);
  return generate_simplex_mesh(parameters, dimension, degree, make_size_field(parameters, dimension));
}
} // namespace signorini
