// SPDX-License-Identifier: LGPL-2.1-or-later
// What exact solutions with friction need of a scene.
#include "signorini/parameters/scene_needs.h"

#include <Eigen/Geometry>

#include <cmath>

namespace signorini
{
namespace
{
Eigen::Vector3d to_vector(const Triple &triple)
{
  return Eigen::Vector3d(triple[0], triple[1], triple[2]);
}
} // namespace

SceneNeed contact_friction()
{
  return {"'Contact' with 'Friction'",
          [](const ParameterText &text, const Parameters &parameters) -> std::optional<SceneFault>
          {
            if (!parameters.contact)
              return contact().find_fault(text, parameters);
            if (!parameters.contact->friction)
              return SceneFault{text.where("Contact"), "'Contact' has no subsection 'Friction'"};
            return {};
          }};
}

SceneNeed sliding_on_a_line()
{
  return {"'Gravity' onto the plane, and it or an initial 'Velocity' or both on one line along the plane",
          [](const ParameterText &text, const Parameters &parameters) -> std::optional<SceneFault>
          {
            constexpr double round_off = 1e-6;
            const std::string place = text.where("Exact solution", "Case");
            const Eigen::Vector3d normal = to_vector(parameters.obstacles.at(0).normal).normalized(),
                                  gravity = to_vector(parameters.gravity),
                                  velocity = to_vector(parameters.bodies.at(0).initial_velocity);
            if (!(gravity.dot(normal) < 0.))
              return SceneFault{place, "'Gravity' does not press the body onto the plane"};
            if (std::abs(velocity.dot(normal)) > round_off * velocity.norm())
              return SceneFault{place, "'Velocity' is not along the plane"};
            const Eigen::Vector3d slope = gravity - gravity.dot(normal) * normal;
            if (slope.cross(velocity).norm() > round_off * gravity.norm() * velocity.norm())
              return SceneFault{place, "'Velocity' is not along the slope"};
            if (slope.norm() <= round_off * gravity.norm() && velocity.norm() == 0.)
              return SceneFault{place, "nothing moves the body along the plane"};
            return {};
          }};
}
} // namespace signorini
