// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/geometry/facet_shape.h"

#include <Eigen/Geometry>

#include <random>
#include <vector>

namespace signorini::contact::testing
{
/// Number of random cases: all, or few where the sanitizers make each a hundred times dearer.
constexpr unsigned int count_cases(const unsigned int n)
{
#ifdef __SANITIZE_ADDRESS__
  return n / 50 + 1;
#else
  return n;
#endif
}

/// Repeatable random numbers for test cases.
class Dice
{
public:
  explicit Dice(const unsigned int seed) : generator(seed) {}

  double number(const double low, const double high)
  {
    return low + (high - low) * static_cast<double>(generator()) / 4294967295.;
  }

  /// A point of the cube [low, high]^n.
  template <int n>
  Eigen::Matrix<double, n, 1> point(const double low, const double high)
  {
    Eigen::Matrix<double, n, 1> x;
    for (int i = 0; i < n; ++i)
      x[i] = number(low, high);
    return x;
  }

  template <int dim>
  SpatialTensor<dim> rotation()
  {
    if constexpr (dim == 2)
      return Eigen::Rotation2Dd(number(-3.2, 3.2)).toRotationMatrix();
    else
      return Eigen::Quaterniond(point<4>(-1., 1.).normalized()).toRotationMatrix();
  }

private:
  std::mt19937 generator;
};

/// All kinds of facet that there are.
template <int dim>
std::vector<FacetElement<dim>> all_elements()
{
  if constexpr (dim == 2)
    return {{1}, {2}};
  else
    return {{1}, {2}, {1, FacetType::triangle}, {2, FacetType::triangle}};
}

/// The flat unit facet in the plane of the first axes, outward normal along the last (2-D: along −y).
template <int dim>
FacetNodes<dim> make_unit_facet(const FacetElement<dim> &element)
{
  FacetNodes<dim> nodes;
  static_cast<FacetElement<dim> &>(nodes) = element;
  for (unsigned int i = 0; i < nodes.n_nodes(); ++i)
  {
    nodes.position[i].setZero();
    nodes.position[i].template head<dim - 1>() = node_coordinates(element, i);
  }
  return nodes;
}

/// A unit facet whose nodes are each moved by up to `warp` a direction, then turned and shifted.
template <int dim>
FacetNodes<dim> make_warped_facet(const FacetElement<dim> &element, const double warp, Dice &dice)
{
  FacetNodes<dim> nodes = make_unit_facet(element);
  const SpatialTensor<dim> rotation = dice.rotation<dim>();
  const SpatialVector<dim> shift = dice.point<dim>(-1., 1.);
  for (unsigned int i = 0; i < nodes.n_nodes(); ++i)
    nodes.position[i] = rotation * (nodes.position[i] + dice.point<dim>(-warp, warp)) + shift;
  return nodes;
}

/// A point of a facet's local domain, no nearer to its sides than `margin`.
template <int dim>
LocalPoint<dim> make_local_point(const FacetElement<dim> &element, const double margin, Dice &dice)
{
  LocalPoint<dim> xi = dice.point<dim - 1>(margin, 1. - margin);
  while (element.type == FacetType::triangle && xi.sum() > 1. - margin)
    xi = dice.point<dim - 1>(margin, 1. - margin);
  return xi;
}
} // namespace signorini::contact::testing
