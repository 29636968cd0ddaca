// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/parameters/scene_needs.h"

#include "signorini/parameters/body_parameters.h"
#include "signorini/parameters/expression.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <variant>

namespace signorini
{
namespace
{
using MaybeFault = std::optional<SceneFault>;

/// How many, in words as far as they are used.
std::string count(const std::size_t number, const std::string &one, const std::string &several)
{
  const std::string word = number == 0   ? "no"
                           : number == 1 ? "one"
                           : number == 2 ? "two"
                                         : std::to_string(number);
  return word + " " + (number < 2 ? one : several);
}

std::string count_bodies(const Parameters &parameters)
{
  return count(parameters.bodies.size(), "body", "bodies");
}

std::string count_obstacles(const Parameters &parameters)
{
  return count(parameters.obstacles.size(), "obstacle", "obstacles");
}

/// The first fault that `find_fault(path, body)` sees in a body.
template <typename FindFault>
SceneNeed every_body(const std::string &text, const FindFault &find_fault)
{
  return {text,
          [find_fault](const ParameterText &file, const Parameters &parameters) -> MaybeFault
          {
            for (const BodyParameters &body : parameters.bodies)
              if (const MaybeFault fault = find_fault(file, body_subsection(body.name), body))
                return fault;
            return {};
          }};
}

/// Where a fault is shown that no line of the file commits.
std::string place_of_case(const ParameterText &text)
{
  return text.where("Exact solution", "Case");
}

/// An entry at the top level, which may be absent.
std::string place_at_top(const ParameterText &text, const std::string &key)
{
  return text.find("", key) != nullptr ? text.where("", key) : place_of_case(text);
}

SceneFault fault_of_entry(const ParameterText &text, const std::string &path, const std::string &key,
                          const std::string &default_value)
{
  return {text.where(path, key), join_path(path, key) + " = " + text.value(path, key, default_value)};
}

/// Names a number in which two materials differ.
std::string difference(const MaterialParameters &first, const MaterialParameters &other)
{
  if (first.model != other.model)
    return "Model";
  if (first.youngs_modulus != other.youngs_modulus)
    return "Young's modulus";
  if (first.poissons_ratio != other.poissons_ratio)
    return "Poisson's ratio";
  return first.density != other.density ? "Density" : "";
}

/// Up to the round-off in upper − lower.
bool have_same_size(const MeshParameters &first, const MeshParameters &other, const unsigned int dimension)
{
  for (unsigned int d = 0; d < dimension; ++d)
  {
    const double size = first.upper_corner[d] - first.lower_corner[d];
    if (std::abs(other.upper_corner[d] - other.lower_corner[d] - size) > 1e-9 * size)
      return false;
  }
  return true;
}

/// Sum of the curvatures 1/R of all balls and spheres [1/m].
double total_curvature(const Parameters &parameters)
{
  double curvature = 0.;
  for (const BodyParameters &body : parameters.bodies)
    if (body.mesh.shape == MeshParameters::Shape::ball)
      curvature += 1. / (body.mesh.radius * body.placement.scale);
  for (const ObstacleParameters &obstacle : parameters.obstacles)
    if (obstacle.shape == ObstacleParameters::Shape::sphere)
      curvature += 1. / obstacle.radius;
  return curvature;
}

bool differ(const double value, const double exact)
{
  return std::abs(value - exact) > 1e-6 * exact;
}

/// Magnitude of a traction that is the same all over its boundary; nothing for others.
std::optional<double> uniform_traction(const LoadParameters &load, const unsigned int dimension,
                                       const double time)
{
  double square = 0.;
  for (unsigned int c = 0; c < dimension; ++c)
  {
    const Expression traction(load.traction[c]);
    if (traction.uses("x") || traction.uses("y") || traction.uses("z"))
      return {};
    square += std::pow(traction.value({}, time), 2);
  }
  return std::sqrt(square);
}

MaybeFault find_unequal_box(const ParameterText &text, const Parameters &parameters)
{
  const BodyParameters &first = parameters.bodies.front();
  for (const BodyParameters &body : parameters.bodies)
  {
    const std::string path = body_subsection(body.name);
    if (const std::string key = difference(first.material, body.material); !key.empty())
    {
      SceneFault fault = fault_of_entry(text, path + "/Material", key, "linear elastic");
      fault.found += fmt::format(", other than that of body '{}'", first.name);
      return fault;
    }
    if (!have_same_size(first.mesh, body.mesh, parameters.dimension))
      return SceneFault{text.where(path + "/Mesh"),
                        fmt::format("bodies '{}' and '{}' differ in size", first.name, body.name)};
  }
  return {};
}
} // namespace

SceneNeed dimension_equal_to(const unsigned int dimension)
{
  return {fmt::format("Dimension = {}", dimension),
          [dimension](const ParameterText &text, const Parameters &parameters) -> MaybeFault
          {
            if (parameters.dimension == dimension)
              return {};
            return SceneFault{place_at_top(text, "Dimension"),
                              fmt::format("Dimension = {}", parameters.dimension)};
          }};
}

SceneNeed contact()
{
  return {"'Contact'",
          [](const ParameterText &text, const Parameters &parameters) -> MaybeFault
          {
            if (parameters.contact)
              return {};
            return SceneFault{place_of_case(text), "there is no subsection 'Contact'"};
          }};
}

SceneNeed surface_potential()
{
  return {"'Potential = surface' where bodies touch each other",
          [](const ParameterText &text, const Parameters &parameters) -> MaybeFault
          {
            if (!parameters.contact || parameters.bodies.size() < 2 ||
                parameters.contact->potential == ContactParameters::Potential::surface)
              return {};
            SceneFault fault = fault_of_entry(text, "Contact", "Potential", "surface");
            fault.found += ", which knows no pressures";
            return fault;
          }};
}

SceneNeed contact_damping()
{
  return {"'Contact' with 'Damping'",
          [](const ParameterText &text, const Parameters &parameters) -> MaybeFault
          {
            if (!parameters.contact)
              return contact().find_fault(text, parameters);
            if (!parameters.contact->damping)
              return SceneFault{text.where("Contact"), "'Contact' has no subsection 'Damping'"};
            return {};
          }};
}

SceneNeed number_of_bodies(const unsigned int number)
{
  return {count(number, "body", "bodies"),
          [number](const ParameterText &text, const Parameters &parameters) -> MaybeFault
          {
            if (parameters.bodies.size() == number)
              return {};
            return SceneFault{place_at_top(text, "Bodies"), count_bodies(parameters)};
          }};
}

SceneNeed number_of_obstacles(const unsigned int number)
{
  return {count(number, "obstacle", "obstacles"),
          [number](const ParameterText &text, const Parameters &parameters) -> MaybeFault
          {
            if (parameters.obstacles.size() == number)
              return {};
            return SceneFault{place_at_top(text, "Obstacles"), count_obstacles(parameters)};
          }};
}

SceneNeed one_touching_pair()
{
  return {"one body and one obstacle, or two bodies and no obstacle",
          [](const ParameterText &text, const Parameters &parameters) -> MaybeFault
          {
            const std::size_t n_bodies = parameters.bodies.size(), n_obstacles = parameters.obstacles.size();
            if (n_bodies <= 2 && n_bodies + n_obstacles == 2)
              return {};
            return SceneFault{place_at_top(text, "Bodies"),
                              count_bodies(parameters) + " and " + count_obstacles(parameters)};
          }};
}

SceneNeed fixed_obstacles(const std::string &needed, const std::vector<ObstacleParameters::Shape> &shapes)
{
  return {needed,
          [shapes](const ParameterText &text, const Parameters &parameters) -> MaybeFault
          {
            for (const ObstacleParameters &obstacle : parameters.obstacles)
              if (std::find(shapes.begin(), shapes.end(), obstacle.shape) == shapes.end())
                return fault_of_entry(text, "Obstacle " + obstacle.name, "Shape", "plane");
              else if (!obstacle.displacement.empty())
                return fault_of_entry(text, "Obstacle " + obstacle.name, "Displacement", "");
            return {};
          }};
}

SceneNeed boxes_only()
{
  return every_body(
      "bodies that are boxes",
      [](const ParameterText &text, const std::string &path, const BodyParameters &body) -> MaybeFault
      {
        if (body.mesh.shape == MeshParameters::Shape::box)
          return {};
        return fault_of_entry(text, path + "/Mesh", "Shape", "box");
      });
}

SceneNeed hexahedra_only()
{
  return every_body(
      "meshes of hexahedra (quadrilaterals)",
      [](const ParameterText &text, const std::string &path, const BodyParameters &body) -> MaybeFault
      {
        if (body.mesh.cell_type == MeshParameters::CellType::hexahedra)
          return {};
        return fault_of_entry(text, path + "/Mesh", "Cell type", "hexahedra");
      });
}

SceneNeed linear_elastic_bodies()
{
  return every_body(
      "linear elastic bodies",
      [](const ParameterText &text, const std::string &path, const BodyParameters &body) -> MaybeFault
      {
        if (body.material.model == MaterialParameters::Model::linear_elastic)
          return {};
        return fault_of_entry(text, path + "/Material", "Model", "linear elastic");
      });
}

SceneNeed no_transverse_contraction()
{
  return every_body("a Poisson's ratio of 0",
                    [](const ParameterText &text, const std::string &path, const BodyParameters &body)
                    {
                      return body.material.poissons_ratio != 0.
                                 ? MaybeFault(fault_of_entry(text, path + "/Material", "Poisson's ratio", ""))
                                 : std::nullopt;
                    });
}

SceneNeed no_viscosity()
{
  return every_body("no 'Viscosity'",
                    [](const ParameterText &text, const std::string &path, const BodyParameters &body)
                    {
                      return body.material.viscosity > 0.
                                 ? MaybeFault(fault_of_entry(text, path + "/Material", "Viscosity", ""))
                                 : std::nullopt;
                    });
}

SceneNeed shifts_only()
{
  return every_body(
      "no rotation or scale in 'Placement'",
      [](const ParameterText &text, const std::string &path, const BodyParameters &body) -> MaybeFault
      {
        if (body.placement.rotation_angle != 0.)
          return fault_of_entry(text, path + "/Placement", "Rotation angle", "0");
        if (body.placement.scale != 1.)
          return fault_of_entry(text, path + "/Placement", "Scale", "1");
        return {};
      });
}

SceneNeed no_grading()
{
  return every_body(
      "no 'Grading'",
      [](const ParameterText &text, const std::string &path, const BodyParameters &body) -> MaybeFault
      {
        const std::string grading = path + "/Mesh/Grading";
        if (!body.mesh.grading)
          return {};
        return SceneFault{text.where(grading), grading};
      });
}

SceneNeed equal_boxes()
{
  return {"boxes of the same material and size", [](const ParameterText &text, const Parameters &parameters)
          {
            const MaybeFault fault = boxes_only().find_fault(text, parameters);
            return fault ? fault : find_unequal_box(text, parameters);
          }};
}

SceneNeed a_load()
{
  return {"a 'Load'",
          [](const ParameterText &text, const Parameters &parameters) -> MaybeFault
          {
            if (std::any_of(parameters.bodies.begin(), parameters.bodies.end(),
                            [](const BodyParameters &body) { return !body.loads.empty(); }))
              return {};
            return SceneFault{place_of_case(text), "no body has a subsection 'Load NAME'"};
          }};
}

SceneNeed matching_radius()
{
  return {"a ball or a sphere, and its radius (of two: 1/(1/R1 + 1/R2)) as 'Radius'",
          [](const ParameterText &text, const Parameters &parameters) -> MaybeFault
          {
            const double curvature = total_curvature(parameters);
            if (curvature == 0.)
              return SceneFault{place_of_case(text), "no body is a ball and no obstacle a sphere"};
            const double radius = parameters.exact_solution->values.at("Radius");
            if (!differ(radius, 1. / curvature))
              return {};
            return SceneFault{
                text.where("Exact solution", "Radius"),
                fmt::format("Radius = {}, but the bodies and obstacles have {}", radius, 1. / curvature)};
          }};
}

SceneNeed matching_pressure()
{
  return {"'Pressure' equal to the traction of every uniform load",
          [](const ParameterText &text, const Parameters &parameters) -> MaybeFault
          {
            const double pressure = parameters.exact_solution->values.at("Pressure");
            const double end = std::visit([](const auto &run) { return run.end_time; }, parameters.solver);
            for (const BodyParameters &body : parameters.bodies)
              for (const LoadParameters &load : body.loads)
                if (const auto traction = uniform_traction(load, parameters.dimension, end);
                    traction && differ(*traction, pressure))
                  return SceneFault{text.where("Exact solution", "Pressure"),
                                    fmt::format("Pressure = {}, but the load at {} has {} at t = {}",
                                                pressure, load.place, *traction, end)};
            return {};
          }};
}
} // namespace signorini
