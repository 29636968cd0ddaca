// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/base/exceptions.h"
#include "signorini/parameters/expression.h"
#include "signorini/parameters/parameters.h"
#include "signorini/scene/obstacle.h"
#include "signorini/scene/obstacle_motion.h"

#include <deal.II/base/point.h>

#include <memory>
#include <vector>

namespace signorini
{
/// A component of the displacement prescribed on one boundary of one body.
template <int dim>
struct Support
{
  unsigned int body = 0;
  std::string boundary;
  unsigned int boundary_id = 0; ///< index of its name among those of the body's boundaries
  unsigned int component = 0;
  Expression displacement; ///< [m]
  std::string description; ///< file, line and name, for messages
};

/// A dead traction on one boundary of one body.
template <int dim>
struct Load
{
  unsigned int body = 0;
  std::string boundary;
  unsigned int boundary_id = 0;     ///< index of its name among those of the body's boundaries
  std::vector<Expression> traction; ///< dim components [Pa]
  std::string description;          ///< file, line and name, for messages
};

/// What acts on what: fixed once built, free of meshes.
template <int dim>
struct Scene
{
  std::vector<std::string> body_names;
  std::vector<MaterialParameters> materials;        ///< one a body
  std::vector<SpatialVector<dim>> initial_velocity; ///< one a body [m/s]
  std::vector<Triple> initial_spin;                 ///< one a body, about its centre of mass [rad/s]
  std::vector<Support<dim>> supports;
  std::vector<Load<dim>> loads;
  SpatialVector<dim> gravity = SpatialVector<dim>::Zero();     ///< [m/s²]
  std::vector<std::shared_ptr<const Obstacle<dim>>> obstacles; ///< where they are at t = 0
  std::vector<ObstacleMotion<dim>> obstacle_motions;           ///< one an obstacle

  unsigned int n_bodies() const { return static_cast<unsigned int>(body_names.size()); }
  bool is_any_obstacle_moving() const;
  /// Blames an obstacle that jumps between two times for the fault, if there is one; whether there is.
  bool blame_jump(double start, double end, Complaint &fault) const;
};

/// Value of a formula at a point and a time. Throws InputError, with `description`, if it is not finite.
template <int dim>
double evaluate(const Expression &expression, const std::string &description, const dealii::Point<dim> &x,
                double t);

template <int dim>
Scene<dim> make_scene(const Parameters &parameters);

/// The first `dim` components.
template <int dim>
SpatialVector<dim> to_spatial_vector(const Triple &triple);
} // namespace signorini
