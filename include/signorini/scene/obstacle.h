// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/base/spatial_vector.h"

#include <limits>
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

  /// The largest depth that there is inside [m]; may be infinite.
  virtual double room() const = 0;

  /// How far it reaches: the largest x·direction of its points x, for a unit vector [m]; may be infinite.
  virtual double reach(const SpatialVector<dim> &direction) const = 0;

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
  double room() const override { return std::numeric_limits<double>::infinity(); }
  double reach(const SpatialVector<dim> &direction) const override;
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
  double room() const override { return radius; }
  double reach(const SpatialVector<dim> &direction) const override;
  Foot find_foot(const SpatialVector<dim> &x) const override;
  void find_feet(const std::vector<SpatialVector<dim>> &points, std::vector<Foot> &feet) const override;

private:
  SpatialVector<dim> centre;
  double radius;
};

/// All points nearer than the given radius to an axis without ends; in 2-D a strip. On the axis, where depth
/// has no derivative, the normal is one of those across the axis and the Hessian zero.
template <int dim>
class RigidCylinder final : public Obstacle<dim>
{
public:
  using Foot = typename Obstacle<dim>::Foot;

  /// `axis_direction` need not have unit length. Throws std::invalid_argument if it is zero or not finite, or
  /// unless the radius is positive and finite.
  RigidCylinder(std::string obstacle_name, const SpatialVector<dim> &axis_point,
                const SpatialVector<dim> &axis_direction, double cylinder_radius);
  std::shared_ptr<const Obstacle<dim>> moved(const SpatialVector<dim> &shift) const override;
  double room() const override { return radius; }
  double reach(const SpatialVector<dim> &direction) const override;
  Foot find_foot(const SpatialVector<dim> &x) const override;
  void find_feet(const std::vector<SpatialVector<dim>> &points, std::vector<Foot> &feet) const override;

private:
  SpatialVector<dim> point;
  SpatialVector<dim> axis;
  double radius;
};

/// The box between two corners, its faces across the axes. Inside, the depth is that of the nearest face, of
/// equally near ones that which comes first in the order of the axes, the lower before the upper; so on
/// edges and corners themselves. Outside, depth is minus the distance from the box, and near an edge or a
/// corner the normal points away from it.
template <int dim>
class RigidBox final : public Obstacle<dim>
{
public:
  using Foot = typename Obstacle<dim>::Foot;

  /// Throws std::invalid_argument unless each coordinate of the upper corner is finite and above that of the
  /// lower one.
  RigidBox(std::string obstacle_name, const SpatialVector<dim> &lower_corner,
           const SpatialVector<dim> &upper_corner);
  std::shared_ptr<const Obstacle<dim>> moved(const SpatialVector<dim> &shift) const override;
  double room() const override { return 0.5 * (upper - lower).minCoeff(); }
  double reach(const SpatialVector<dim> &direction) const override;
  Foot find_foot(const SpatialVector<dim> &x) const override;
  void find_feet(const std::vector<SpatialVector<dim>> &points, std::vector<Foot> &feet) const override;

private:
  Foot find_nearest_face(const SpatialVector<dim> &x) const;

  SpatialVector<dim> lower;
  SpatialVector<dim> upper;
};
} // namespace signorini
