// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/parameters/mesh_parameters.h"

#include "signorini/parameters/section_reader.h"
#include "signorini/parameters/strings.h"

#include <fmt/format.h>

#include <algorithm>

namespace signorini
{
namespace
{
const NameTable<MeshParameters::Shape> &shapes()
{
  static const NameTable<MeshParameters::Shape> table{{"box", MeshParameters::Shape::box},
                                                      {"ball", MeshParameters::Shape::ball},
                                                      {"cylinder", MeshParameters::Shape::cylinder}};
  return table;
}

const NameTable<MeshParameters::Part> &parts()
{
  static const NameTable<MeshParameters::Part> table{{"whole", MeshParameters::Part::whole},
                                                     {"half", MeshParameters::Part::half},
                                                     {"orthant", MeshParameters::Part::orthant}};
  return table;
}

void declare_grading(Declarations &declarations, const DeclarationScope &scope, const std::string &path)
{
  SubsectionDeclaration grading(declarations, path, "Smaller cells near a point or a boundary.");
  grading.add("Point", scope.vector(), "", "m",
              "Centre of refinement, in the body's coordinates before placement.");
  grading.add("Boundary", any_text(), "", "",
              "Boundary towards which cells are refined, instead of a point.");
  grading.add_required("Distance", positive_length(), "m",
                       "Cells nearer than this are refined by all levels.");
  grading.add("Levels", integer_from(1, 12), "1", "",
              "Additional refinements there; each level less doubles the distance.");
}

MeshParameters::Grading read_grading(const SectionReader &section, const MeshParameters &mesh,
                                     const unsigned int dimension)
{
  MeshParameters::Grading grading;
  if (section.given("Point") && section.given("Boundary"))
    throw InputError(section.complain("Boundary", "'Point' and 'Boundary' of a grading contradict each other")
                         .advise("remove one of the two"));
  if (!section.given("Point") && !section.given("Boundary"))
    throw InputError(section.complain("a grading needs 'Point' or 'Boundary'").advise("add one of the two"));
  if (section.given("Point"))
    grading.point = section.vector("Point");
  else
    grading.boundary = section.value("Boundary");
  const std::vector<std::string> names = boundary_names(mesh, dimension);
  if (grading.boundary && std::find(names.begin(), names.end(), *grading.boundary) == names.end())
    throw InputError(section.complain("Boundary", "the mesh has no such boundary")
                         .expected("one of " + join(names, ", "))
                         .did_you_mean(nearest_name(*grading.boundary, names))
                         .advise("use a boundary of this shape"));
  grading.distance = section.number("Distance");
  grading.levels = section.integer("Levels");
  return grading;
}

void read_box(const SectionReader &section, const unsigned int dimension, MeshParameters &mesh)
{
  mesh.lower_corner = section.vector("Lower corner");
  mesh.upper_corner = section.vector("Upper corner");
  mesh.cells = section.integers("Cells");
  for (unsigned int c = 0; c < dimension; ++c)
    if (mesh.lower_corner[c] >= mesh.upper_corner[c])
      throw InputError(
          section
              .complain(
                  section.given("Upper corner") ? "Upper corner" : "Lower corner",
                  fmt::format("component {} of 'Upper corner' is not above that of 'Lower corner'", c + 1))
              .expected(
                  fmt::format("upper > lower; here {} and {}", mesh.upper_corner[c], mesh.lower_corner[c]))
              .advise("exchange or correct the corners"));
}

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
} // namespace

void declare_mesh(Declarations &declarations, const DeclarationScope &scope, const std::string &path)
{
  SubsectionDeclaration mesh(declarations, path, "A generated mesh of hexahedra, or quadrilaterals in 2-D.");
  const auto shape_is = [&](const std::string &shape) { return scope.chosen(path, "Shape", shape, "box"); };
  mesh.add("Shape", one_of(names_in(shapes())), "box", "",
           "Box; ball centred at the origin; cylinder centred at the origin around the z axis (3-D only).");
  if (shape_is("ball"))
    mesh.add("Part", one_of(names_in(parts())), "whole", "",
             "Ball: all of it, the half with last coordinate ≥ 0, or the part with all coordinates ≥ 0.");
  if (shape_is("box"))
  {
    mesh.add("Lower corner", scope.vector(), scope.components("0, 0, 0"), "m", "Box: smallest coordinates.");
    mesh.add("Upper corner", scope.vector(), scope.components("1, 1, 1"), "m", "Box: largest coordinates.");
    mesh.add("Cells", list_of(integer_from(1, 1000000), scope.dimension, scope.dimension),
             scope.components("1, 1, 1"), "", "Box: coarse cells in each direction.");
  }
  if (shape_is("ball") || shape_is("cylinder"))
    mesh.add("Radius", positive_length(), "1", "m", "Ball and cylinder: radius.");
  if (shape_is("cylinder"))
    mesh.add("Length", positive_length(), "1", "m", "Cylinder: length along the z axis.");
  mesh.add("Refinements", integer_from(0, 12), "0", "",
           "How often all coarse cells are halved in each direction.");
  if (scope.includes(join_path(path, "Grading")))
    declare_grading(declarations, scope, join_path(path, "Grading"));
}

MeshParameters read_mesh(const ParameterText &text, const Declarations &in_use, const std::string &path,
                         const unsigned int dimension)
{
  const SectionReader section(text, in_use, path, dimension);
  MeshParameters mesh;
  mesh.shape = section.choice("Shape", shapes());
  if (mesh.shape == MeshParameters::Shape::cylinder && dimension == 2)
    throw InputError(section.complain("Shape", "a cylinder needs three dimensions")
                         .expected("box or ball in two dimensions")
                         .advise("set Dimension = 3, or use a ball: in two dimensions it is a disk"));
  if (mesh.shape == MeshParameters::Shape::box)
    read_box(section, dimension, mesh);
  else
    mesh.radius = section.number("Radius");
  if (mesh.shape == MeshParameters::Shape::ball)
    mesh.part = section.choice("Part", parts());
  if (mesh.shape == MeshParameters::Shape::cylinder)
    mesh.length = section.number("Length");
  mesh.refinements = section.integer("Refinements");
  const std::string grading = join_path(path, "Grading");
  if (text.find_subsection(grading) != nullptr)
    mesh.grading = read_grading(SectionReader(text, in_use, grading, dimension), mesh, dimension);
  return mesh;
}

std::vector<std::string> boundary_names(const MeshParameters &mesh, const unsigned int dimension)
{
  switch (mesh.shape)
  {
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
} // namespace signorini
