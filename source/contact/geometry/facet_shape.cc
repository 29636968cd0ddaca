// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/geometry/facet_shape.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace signorini::contact
{
namespace
{
/// Value, first and second derivative of the Lagrange polynomials of one direction.
struct LineShape
{
  std::array<double, 3> value, first, second;
};

LineShape evaluate_line_shape(const unsigned int degree, const double s)
{
  if (degree == 1)
    return {{1. - s, s, 0.}, {-1., 1., 0.}, {0., 0., 0.}};
  return {{(1. - s) * (1. - 2. * s), 4. * s * (1. - s), s * (2. * s - 1.)},
          {4. * s - 3., 4. - 8. * s, 4. * s - 1.},
          {4., -8., 4.}};
}
} // namespace

template <int dim>
FacetShape<dim> evaluate_facet_shape(const unsigned int degree, const LocalPoint<dim> &xi)
{
  assert(degree == 1 || degree == 2);
  FacetShape<dim> shape;
  const LineShape row = evaluate_line_shape(degree, xi[0]);
  if constexpr (dim == 2)
  {
    shape.n_nodes = degree + 1;
    for (unsigned int i = 0; i <= degree; ++i)
    {
      shape.value[i] = row.value[i];
      shape.first[i] = {row.first[i]};
      shape.second[i] = {row.second[i]};
    }
  }
  else
  {
    const LineShape column = evaluate_line_shape(degree, xi[1]);
    unsigned int node = 0;
    for (unsigned int j = 0; j <= degree; ++j)
      for (unsigned int i = 0; i <= degree; ++i, ++node)
      {
        shape.value[node] = row.value[i] * column.value[j];
        shape.first[node] = {row.first[i] * column.value[j], row.value[i] * column.first[j]};
        shape.second[node] = {row.second[i] * column.value[j], row.first[i] * column.first[j],
                              row.value[i] * column.second[j]};
      }
    shape.n_nodes = node;
  }
  return shape;
}

template <int dim>
FacetNodes<dim> gather_nodes(const Facet<dim> &facet, const std::vector<SpatialVector<dim>> &positions)
{
  FacetNodes<dim> nodes;
  nodes.degree = facet.degree;
  nodes.n_nodes = facet.n_nodes();
  for (unsigned int i = 0; i < nodes.n_nodes; ++i)
    nodes.position[i] = positions[facet.nodes[i]];
  return nodes;
}

template <int dim>
FacetFrame<dim> evaluate_facet_frame(const FacetNodes<dim> &nodes, const LocalPoint<dim> &xi)
{
  const FacetShape<dim> shape = evaluate_facet_shape<dim>(nodes.degree, xi);
  FacetFrame<dim> frame;
  frame.position.setZero();
  for (auto &tangent : frame.tangent)
    tangent.setZero();
  for (unsigned int i = 0; i < shape.n_nodes; ++i)
  {
    frame.position += shape.value[i] * nodes.position[i];
    for (unsigned int a = 0; a < dim - 1; ++a)
      frame.tangent[a] += shape.first[i][a] * nodes.position[i];
  }
  if constexpr (dim == 2)
    frame.area_normal = SpatialVector<2>(frame.tangent[0].y(), -frame.tangent[0].x());
  else
    frame.area_normal = frame.tangent[0].cross(frame.tangent[1]);
  return frame;
}

template <int dim>
std::vector<SpatialVector<dim>> make_lattice(const Facet<dim> &facet,
                                             const std::vector<SpatialVector<dim>> &positions, double spacing)
{
  constexpr double most = 64.;
  const FacetNodes<dim> nodes = gather_nodes(facet, positions);
  std::array<unsigned int, 2> n_steps{{0, 0}};
  for (unsigned int direction = 0; direction < dim - 1; ++direction)
  {
    const unsigned int end = facet.degree * (direction == 0 ? 1 : facet.degree + 1);
    const double length = (nodes.position[end] - nodes.position[0]).norm();
    n_steps[direction] = static_cast<unsigned int>(std::clamp(std::ceil(length / spacing), 1., most));
  }
  std::vector<SpatialVector<dim>> points;
  for (unsigned int j = 0; j <= n_steps[1]; ++j)
    for (unsigned int i = 0; i <= n_steps[0]; ++i)
    {
      LocalPoint<dim> xi;
      xi[0] = static_cast<double>(i) / n_steps[0];
      if constexpr (dim == 3)
        xi[1] = static_cast<double>(j) / n_steps[1];
      points.push_back(evaluate_facet_frame(nodes, xi).position);
    }
  return points;
}

template <int dim>
LocalPoint<dim> node_coordinates(const Facet<dim> &facet, unsigned int i)
{
  LocalPoint<dim> xi;
  for (int d = 0; d < dim - 1; ++d)
    xi[d] = static_cast<double>(d == 0 ? i % (facet.degree + 1) : i / (facet.degree + 1)) / facet.degree;
  return xi;
}

template <int dim>
double evaluate_hat_function(const Facet<dim> &facet, unsigned int i, const LocalPoint<dim> &xi)
{
  const LocalPoint<dim> node = node_coordinates(facet, i);
  double value = 1.;
  for (int d = 0; d < dim - 1; ++d)
    value *= std::max(0., 1. - facet.degree * std::abs(xi[d] - node[d]));
  return value;
}

template std::vector<SpatialVector<2>> make_lattice(const Facet<2> &, const std::vector<SpatialVector<2>> &,
                                                    double);
template std::vector<SpatialVector<3>> make_lattice(const Facet<3> &, const std::vector<SpatialVector<3>> &,
                                                    double);
template LocalPoint<2> node_coordinates(const Facet<2> &, unsigned int);
template LocalPoint<3> node_coordinates(const Facet<3> &, unsigned int);
template double evaluate_hat_function(const Facet<2> &, unsigned int, const LocalPoint<2> &);
template double evaluate_hat_function(const Facet<3> &, unsigned int, const LocalPoint<3> &);
template FacetShape<2> evaluate_facet_shape<2>(unsigned int, const LocalPoint<2> &);
template FacetShape<3> evaluate_facet_shape<3>(unsigned int, const LocalPoint<3> &);
template FacetNodes<2> gather_nodes(const Facet<2> &, const std::vector<SpatialVector<2>> &);
template FacetNodes<3> gather_nodes(const Facet<3> &, const std::vector<SpatialVector<3>> &);
template FacetFrame<2> evaluate_facet_frame(const FacetNodes<2> &, const LocalPoint<2> &);
template FacetFrame<3> evaluate_facet_frame(const FacetNodes<3> &, const LocalPoint<3> &);
} // namespace signorini::contact
