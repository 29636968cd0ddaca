// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/base/spatial_vector.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

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
    double depth = 0.;                ///< positive inside the obstacle [m]
    SpatialVector<dim> normal;        ///< outward unit normal, −∇depth
    SpatialTensor<dim> depth_hessian; ///< ∇∇depth [1/m]
  };

  explicit Obstacle(std::string obstacle_name) : name_(std::move(obstacle_name)) {}
  virtual ~Obstacle() = default;
  Obstacle(const Obstacle &) = delete;
  Obstacle &operator=(const Obstacle &) = delete;

  const std::string &name() const { return name_; }

  /// The same obstacle, moved by `shift`.
  virtual std::shared_ptr<const Obstacle> moved(const SpatialVector<dim> &shift) const = 0;

  virtual Foot find_foot(const SpatialVector<dim> &x) const = 0;

  /// Overwrites `feet` with one foot a point. An obstacle that meets many points should override it, so that
  /// a batch costs one virtual call.
  virtual void find_feet(const std::vector<SpatialVector<dim>> &points, std::vector<Foot> &feet) const;

private:
  std::string name_;
};

/// The half-space { x : (x − point)·normal ≤ 0 }.
template <int dim>
class RigidPlane final : public Obstacle<dim>
{
public:
  using Foot = typename Obstacle<dim>::Foot;

  /// `outward_normal` need not have unit length; it points to where bodies may be.
  /// Throws std::invalid_argument if it is zero or not finite.
  RigidPlane(std::string obstacle_name, const SpatialVector<dim> &plane_point,
             const SpatialVector<dim> &outward_normal);
  std::shared_ptr<const Obstacle<dim>> moved(const SpatialVector<dim> &shift) const override;
  Foot find_foot(const SpatialVector<dim> &x) const override;
  void find_feet(const std::vector<SpatialVector<dim>> &points, std::vector<Foot> &feet) const override;

private:
  SpatialVector<dim> point;
  SpatialVector<dim> normal;
};

/// The ball (disk in 2-D) of the given radius. At its very centre, where depth has no derivative, the normal
/// is the last axis and the Hessian zero.
template <int dim>
class RigidSphere final : public Obstacle<dim>
{
public:
  using Foot = typename Obstacle<dim>::Foot;

  /// Throws std::invalid_argument unless the radius is positive and finite.
  RigidSphere(std::string obstacle_name, const SpatialVector<dim> &sphere_centre, double sphere_radius);
  std::shared_ptr<const Obstacle<dim>> moved(const SpatialVector<dim> &shift) const override;
  Foot find_foot(const SpatialVector<dim> &x) const override;
  void find_feet(const std::vector<SpatialVector<dim>> &points, std::vector<Foot> &feet) const override;

private:
  SpatialVector<dim> centre;
  double radius;
};
} // namespace signorini
