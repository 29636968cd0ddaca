// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/geometry/facet_shape.h"

#include <Eigen/Geometry>

#include <random>

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

/// The flat unit facet in the plane of the first axes, outward normal along the last (2-D: along −y).
template <int dim>
FacetNodes<dim> make_unit_facet(const unsigned int degree)
{
  FacetNodes<dim> nodes;
  nodes.degree = degree;
  nodes.n_nodes = (dim == 2 ? degree + 1 : (degree + 1) * (degree + 1));
  for (unsigned int i = 0; i < nodes.n_nodes; ++i)
  {
    nodes.position[i].setZero();
    nodes.position[i][0] = static_cast<double>(i % (degree + 1)) / degree;
    if (dim == 3)
      nodes.position[i][1] = static_cast<double>(i / (degree + 1)) / degree;
  }
  return nodes;
}

/// A unit facet whose nodes are each moved by up to `warp` a direction, then turned and shifted.
template <int dim>
FacetNodes<dim> make_warped_facet(const unsigned int degree, const double warp, Dice &dice)
{
  FacetNodes<dim> nodes = make_unit_facet<dim>(degree);
  const SpatialTensor<dim> rotation = dice.rotation<dim>();
  const SpatialVector<dim> shift = dice.point<dim>(-1., 1.);
  for (unsigned int i = 0; i < nodes.n_nodes; ++i)
    nodes.position[i] = rotation * (nodes.position[i] + dice.point<dim>(-warp, warp)) + shift;
  return nodes;
}
} // namespace signorini::contact::testing
