// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/scene/obstacle.h"

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

template class Obstacle<2>;
template class Obstacle<3>;
template class RigidPlane<2>;
template class RigidPlane<3>;
template class RigidSphere<2>;
template class RigidSphere<3>;
} // namespace signorini
