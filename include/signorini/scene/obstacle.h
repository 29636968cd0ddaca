// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/base/spatial_vector.h"

#include <string>

namespace signorini
{
/// A rigid thing that bodies may touch but not enter.
template <int dim>
class Obstacle
{
public:
  /// Where a point stands with respect to the obstacle's surface.
  struct Foot
  {
    double depth = 0.;                   ///< positive inside the obstacle [m]
    SpatialVector<dim> normal;           ///< outward unit normal, −∇depth
    SpatialTensor<dim> depth_hessian;    ///< ∇∇depth [1/m]
  };

  explicit Obstacle(std::string obstacle_name) : name_(std::move(obstacle_name)) {}
  virtual ~Obstacle() = default;
  Obstacle(const Obstacle &) = delete;
  Obstacle &operator=(const Obstacle &) = delete;

  const std::string &name() const { return name_; }
  virtual Foot find_foot(const SpatialVector<dim> &x) const = 0;

private:
  std::string name_;
};

/// The half-space { x : (x − point)·normal ≤ 0 }.
template <int dim>
class RigidPlane : public Obstacle<dim>
{
public:
  /// `outward_normal` need not have unit length; it points to where bodies may be.
  RigidPlane(std::string obstacle_name, const SpatialVector<dim> &point, const SpatialVector<dim> &outward_normal);
  typename Obstacle<dim>::Foot find_foot(const SpatialVector<dim> &x) const override;

private:
  SpatialVector<dim> point;
  SpatialVector<dim> normal;
};

/// The ball (disk in 2-D) of the given radius.
template <int dim>
class RigidSphere : public Obstacle<dim>
{
public:
  RigidSphere(std::string obstacle_name, const SpatialVector<dim> &centre, double radius);
  typename Obstacle<dim>::Foot find_foot(const SpatialVector<dim> &x) const override;

private:
  SpatialVector<dim> centre;
  double radius;
};
} // namespace signorini
