// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/scene/obstacle.h"

#include <Eigen/Geometry>

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace signorini
{
namespace
{
/// The qualified call is bound at compile time: the loop makes no virtual call.
template <int dim, typename Shape>
void find_feet_of(const Shape &shape, const std::vector<SpatialVector<dim>> &points,
                  std::vector<typename Obstacle<dim>::Foot> &feet)
{
  feet.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    feet[i] = shape.Shape::find_foot(points[i]);
}
} // namespace

template <int dim>
void Obstacle<dim>::find_feet(const std::vector<SpatialVector<dim>> &points, std::vector<Foot> &feet) const
{
  feet.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    feet[i] = find_foot(points[i]);
}

template <int dim>
RigidPlane<dim>::RigidPlane(std::string obstacle_name, const SpatialVector<dim> &plane_point,
                            const SpatialVector<dim> &outward_normal)
    : Obstacle<dim>(std::move(obstacle_name)), point(plane_point), normal(outward_normal.stableNormalized())
{
  if (!(std::abs(normal.norm() - 1.) < 1e-8))
    throw std::invalid_argument(fmt::format(
        "Obstacle '{}': the normal of a plane must be a finite vector other than zero.", this->name()));
}

template <int dim>
std::shared_ptr<const Obstacle<dim>> RigidPlane<dim>::moved(const SpatialVector<dim> &shift) const
{
  return std::make_shared<RigidPlane<dim>>(this->name(), point + shift, normal);
}

template <int dim>
double RigidPlane<dim>::reach(const SpatialVector<dim> &direction) const
{
  return (direction - normal).norm() < 1e-8 ? direction.dot(point) : std::numeric_limits<double>::infinity();
}

template <int dim>
typename Obstacle<dim>::Foot RigidPlane<dim>::find_foot(const SpatialVector<dim> &x) const
{
  return {normal.dot(point - x), normal, SpatialTensor<dim>::Zero()};
}

template <int dim>
void RigidPlane<dim>::find_feet(const std::vector<SpatialVector<dim>> &points, std::vector<Foot> &feet) const
{
  find_feet_of<dim>(*this, points, feet);
}

template <int dim>
RigidSphere<dim>::RigidSphere(std::string obstacle_name, const SpatialVector<dim> &sphere_centre,
                              double sphere_radius)
    : Obstacle<dim>(std::move(obstacle_name)), centre(sphere_centre), radius(sphere_radius)
{
  if (!(radius > 0.) || !std::isfinite(radius))
    throw std::invalid_argument(fmt::format(
        "Obstacle '{}': the radius of a sphere must be positive, but is {}.", this->name(), radius));
}

template <int dim>
std::shared_ptr<const Obstacle<dim>> RigidSphere<dim>::moved(const SpatialVector<dim> &shift) const
{
  return std::make_shared<RigidSphere<dim>>(this->name(), centre + shift, radius);
}

template <int dim>
double RigidSphere<dim>::reach(const SpatialVector<dim> &direction) const
{
  return direction.dot(centre) + radius;
}

template <int dim>
typename Obstacle<dim>::Foot RigidSphere<dim>::find_foot(const SpatialVector<dim> &x) const
{
  const SpatialVector<dim> from_centre = x - centre;
  const double distance = from_centre.norm();
  if (distance <= 1e-12 * radius)
    return {radius - distance, SpatialVector<dim>::Unit(dim - 1), SpatialTensor<dim>::Zero()};

  const SpatialVector<dim> normal = from_centre / distance;
  return {radius - distance, normal,
          (normal * normal.transpose() - SpatialTensor<dim>::Identity()) / distance};
}

template <int dim>
void RigidSphere<dim>::find_feet(const std::vector<SpatialVector<dim>> &points, std::vector<Foot> &feet) const
{
  find_feet_of<dim>(*this, points, feet);
}

template <int dim>
RigidCylinder<dim>::RigidCylinder(std::string obstacle_name, const SpatialVector<dim> &axis_point,
                                  const SpatialVector<dim> &axis_direction, double cylinder_radius)
    : Obstacle<dim>(std::move(obstacle_name)), point(axis_point), axis(axis_direction.stableNormalized()),
      radius(cylinder_radius)
{
  if (!(std::abs(axis.norm() - 1.) < 1e-8))
    throw std::invalid_argument(fmt::format(
        "Obstacle '{}': the axis of a cylinder must be a finite vector other than zero.", this->name()));
  if (!(radius > 0.) || !std::isfinite(radius))
    throw std::invalid_argument(fmt::format(
        "Obstacle '{}': the radius of a cylinder must be positive, but is {}.", this->name(), radius));
}

template <int dim>
std::shared_ptr<const Obstacle<dim>> RigidCylinder<dim>::moved(const SpatialVector<dim> &shift) const
{
  return std::make_shared<RigidCylinder<dim>>(this->name(), point + shift, axis, radius);
}

template <int dim>
double RigidCylinder<dim>::reach(const SpatialVector<dim> &direction) const
{
  return std::abs(direction.dot(axis)) < 1e-8 ? direction.dot(point) + radius
                                              : std::numeric_limits<double>::infinity();
}

template <int dim>
typename Obstacle<dim>::Foot RigidCylinder<dim>::find_foot(const SpatialVector<dim> &x) const
{
  const SpatialTensor<dim> across = SpatialTensor<dim>::Identity() - axis * axis.transpose();
  const SpatialVector<dim> from_axis = across * (x - point);
  const double distance = from_axis.norm();
  if (distance <= 1e-12 * radius)
    return {radius - distance, axis.unitOrthogonal(), SpatialTensor<dim>::Zero()};

  const SpatialVector<dim> normal = from_axis / distance;
  return {radius - distance, normal, (normal * normal.transpose() - across) / distance};
}

template <int dim>
void RigidCylinder<dim>::find_feet(const std::vector<SpatialVector<dim>> &points,
                                   std::vector<Foot> &feet) const
{
  find_feet_of<dim>(*this, points, feet);
}

template <int dim>
RigidBox<dim>::RigidBox(std::string obstacle_name, const SpatialVector<dim> &lower_corner,
                        const SpatialVector<dim> &upper_corner)
    : Obstacle<dim>(std::move(obstacle_name)), lower(lower_corner), upper(upper_corner)
{
  if (!((upper - lower).minCoeff() > 0.) || !(upper - lower).allFinite())
    throw std::invalid_argument(fmt::format(
        "Obstacle '{}': the upper corner of a box must be finite and above the lower one.", this->name()));
}

template <int dim>
std::shared_ptr<const Obstacle<dim>> RigidBox<dim>::moved(const SpatialVector<dim> &shift) const
{
  return std::make_shared<RigidBox<dim>>(this->name(), lower + shift, upper + shift);
}

template <int dim>
double RigidBox<dim>::reach(const SpatialVector<dim> &direction) const
{
  return direction.cwiseProduct(lower).cwiseMax(direction.cwiseProduct(upper)).sum();
}

template <int dim>
typename Obstacle<dim>::Foot RigidBox<dim>::find_foot(const SpatialVector<dim> &x) const
{
  const SpatialVector<dim> from_box = x - x.cwiseMax(lower).cwiseMin(upper);
  const double distance = from_box.norm();
  if (distance == 0.)
    return find_nearest_face(x);

  // Only the components in which the point lies outside take part: one before a face, more at edges.
  const SpatialVector<dim> normal = from_box / distance;
  const SpatialTensor<dim> outside = (from_box.array() != 0.).template cast<double>().matrix().asDiagonal();
  return {-distance, normal, (normal * normal.transpose() - outside) / distance};
}

template <int dim>
typename Obstacle<dim>::Foot RigidBox<dim>::find_nearest_face(const SpatialVector<dim> &x) const
{
  Foot foot{std::numeric_limits<double>::max(), {}, SpatialTensor<dim>::Zero()};
  for (unsigned int d = 0; d < dim; ++d)
    for (const double side : {-1., 1.})
      if (const double depth = side < 0. ? x[d] - lower[d] : upper[d] - x[d]; depth < foot.depth)
      {
        foot.depth = depth;
        foot.normal = side * SpatialVector<dim>::Unit(d);
      }
  return foot;
}

template <int dim>
void RigidBox<dim>::find_feet(const std::vector<SpatialVector<dim>> &points, std::vector<Foot> &feet) const
{
  find_feet_of<dim>(*this, points, feet);
}

template class Obstacle<2>;
template class Obstacle<3>;
template class RigidPlane<2>;
template class RigidPlane<3>;
template class RigidSphere<2>;
template class RigidSphere<3>;
template class RigidCylinder<2>;
template class RigidCylinder<3>;
template class RigidBox<2>;
template class RigidBox<3>;
} // namespace signorini
