// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/scene/scene.h"

#include "signorini/base/exceptions.h"
#include "signorini/base/to_point.h"
#include "signorini/parameters/mesh_parameters.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace signorini
{
template <int dim>
SpatialVector<dim> to_spatial_vector(const Triple &triple)
{
  SpatialVector<dim> vector;
  for (unsigned int d = 0; d < dim; ++d)
    vector[d] = triple[d];
  return vector;
}

namespace
{
template <int dim>
void add_supports_and_loads(const BodyParameters &body, unsigned int index, Scene<dim> &scene)
{
  const std::vector<std::string> names = boundary_names(body.mesh, dim);
  const auto find_id = [&names](const std::string &name)
  { return static_cast<unsigned int>(std::find(names.begin(), names.end(), name) - names.begin()); };
  for (const SupportParameters &support : body.supports)
    for (unsigned int component = 0; component < dim; ++component)
      if (support.displacement[component])
        scene.supports.push_back({index, support.boundary, find_id(support.boundary), component,
                                  Expression(*support.displacement[component]),
                                  fmt::format("{}: Body {}/Support {}/{}", support.places[component],
                                              body.name, support.boundary, "xyz"[component])});
  for (const LoadParameters &load : body.loads)
  {
    Load<dim> traction{index,
                       load.boundary,
                       find_id(load.boundary),
                       {},
                       fmt::format("{}: Body {}/Load {}/Traction", load.place, body.name, load.boundary)};
    for (unsigned int component = 0; component < dim; ++component)
      traction.traction.emplace_back(load.traction[component]);
    scene.loads.push_back(std::move(traction));
  }
}

template <int dim>
std::shared_ptr<const Obstacle<dim>> make_obstacle(const ObstacleParameters &parameters)
{
  const SpatialVector<dim> point = to_spatial_vector<dim>(parameters.point);
  switch (parameters.shape)
  {
  case ObstacleParameters::Shape::plane:
    return std::make_shared<RigidPlane<dim>>(parameters.name, point,
                                             to_spatial_vector<dim>(parameters.normal));
  case ObstacleParameters::Shape::sphere:
    return std::make_shared<RigidSphere<dim>>(parameters.name, point, parameters.radius);
  case ObstacleParameters::Shape::cylinder:
    return std::make_shared<RigidCylinder<dim>>(parameters.name, point,
                                                to_spatial_vector<dim>(parameters.axis), parameters.radius);
  default:
    return std::make_shared<RigidBox<dim>>(parameters.name, to_spatial_vector<dim>(parameters.lower_corner),
                                           to_spatial_vector<dim>(parameters.upper_corner));
  }
}
} // namespace

template <int dim>
double evaluate(const Expression &expression, const std::string &description, const dealii::Point<dim> &x,
                double t)
{
  const Triple point = to_triple<dim>(x);
  const double value = expression.value(point, t);
  if (!std::isfinite(value))
    throw InputError(Complaint(fmt::format("{} is {} at x = {}, y = {}, z = {}, t = {}", description,
                                           std::isnan(value) ? "not a number" : "infinite", point[0],
                                           point[1], point[2], t))
                         .found(expression.formula())
                         .expected("finite values wherever it is used")
                         .advise("correct the formula, or restrict it with if(condition, value, other)"));
  return value;
}

template <int dim>
Scene<dim> make_scene(const Parameters &parameters)
{
  Scene<dim> scene;
  scene.gravity = to_spatial_vector<dim>(parameters.gravity);
  for (const BodyParameters &body : parameters.bodies)
  {
    add_supports_and_loads(body, scene.n_bodies(), scene);
    scene.body_names.push_back(body.name);
    scene.materials.push_back(body.material);
    scene.initial_velocity.push_back(to_spatial_vector<dim>(body.initial_velocity));
    scene.initial_spin.push_back(body.initial_spin);
  }
  const double end_time = std::visit([](const auto &solver) { return solver.end_time; }, parameters.solver);
  for (const ObstacleParameters &obstacle : parameters.obstacles)
  {
    scene.obstacles.push_back(make_obstacle<dim>(obstacle));
    scene.obstacle_motions.emplace_back(
        obstacle.displacement,
        fmt::format("{}: Obstacle {}/Displacement", obstacle.place_of_displacement, obstacle.name), end_time);
  }
  return scene;
}

template <int dim>
bool Scene<dim>::is_any_obstacle_moving() const
{
  return std::any_of(obstacle_motions.begin(), obstacle_motions.end(),
                     [](const ObstacleMotion<dim> &motion) { return !motion.is_fixed(); });
}

template <int dim>
bool Scene<dim>::blame_jump(double start, double end, Complaint &fault) const
{
  for (unsigned int i = 0; i < obstacles.size(); ++i)
    if (const std::optional<ObstacleJump> jump = obstacle_motions[i].find_jump(start, end))
    {
      fault.what += fmt::format(", for obstacle '{}' jumps by {:.3g} m at t = {:.6g}", obstacles[i]->name(),
                                jump->size, jump->time);
      fault.at(obstacle_motions[i].place())
          .advise("let its Displacement grow from the one place to the other in a finite time");
      return true;
    }
  return false;
}

template struct Scene<2>;
template struct Scene<3>;
template double evaluate<2>(const Expression &, const std::string &, const dealii::Point<2> &, double);
template double evaluate<3>(const Expression &, const std::string &, const dealii::Point<3> &, double);
template Scene<2> make_scene<2>(const Parameters &);
template Scene<3> make_scene<3>(const Parameters &);
template SpatialVector<2> to_spatial_vector<2>(const Triple &);
template SpatialVector<3> to_spatial_vector<3>(const Triple &);
} // namespace signorini
