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

FacetShape<2> evaluate_line(const unsigned int degree, const LocalPoint<2> &xi)
{
  FacetShape<2> shape;
  shape.n_nodes = degree + 1;
  const LineShape line = evaluate_line_shape(degree, xi[0]);
  for (unsigned int i = 0; i <= degree; ++i)
  {
    shape.value[i] = line.value[i];
    shape.first[i] = {line.first[i]};
    shape.second[i] = {line.second[i]};
  }
  return shape;
}

FacetShape<3> evaluate_tensor_product(const unsigned int degree, const LocalPoint<3> &xi)
{
  FacetShape<3> shape;
  const LineShape row = evaluate_line_shape(degree, xi[0]), column = evaluate_line_shape(degree, xi[1]);
  for (unsigned int j = 0; j <= degree; ++j)
    for (unsigned int i = 0; i <= degree; ++i, ++shape.n_nodes)
    {
      const unsigned int node = shape.n_nodes;
      shape.value[node] = row.value[i] * column.value[j];
      shape.first[node] = {row.first[i] * column.value[j], row.value[i] * column.first[j]};
      shape.second[node] = {row.second[i] * column.value[j], row.first[i] * column.first[j],
                            row.value[i] * column.second[j]};
    }
  return shape;
}

std::array<double, 3> barycentric_coordinates(const LocalPoint<3> &xi)
{
  return {1. - xi[0] - xi[1], xi[0], xi[1]};
}

FacetShape<3> evaluate_triangle(const unsigned int degree, const LocalPoint<3> &xi)
{
  constexpr std::array<std::array<double, 2>, 3> slope{{{-1., -1.}, {1., 0.}, {0., 1.}}};
  const std::array<double, 3> b = barycentric_coordinates(xi);
  FacetShape<3> shape;
  shape.n_nodes = (degree == 1 ? 3 : 6);
  for (unsigned int i = 0; i < 3; ++i)
  {
    if (degree == 1)
    {
      shape.value[i] = b[i];
      shape.first[i] = slope[i];
      continue;
    }
    shape.value[i] = b[i] * (2. * b[i] - 1.);
    const unsigned int j = (i + 1) % 3, middle = 3 + i;
    shape.value[middle] = 4. * b[i] * b[j];
    for (unsigned int a = 0; a < 2; ++a)
    {
      shape.first[i][a] = (4. * b[i] - 1.) * slope[i][a];
      shape.first[middle][a] = 4. * (slope[i][a] * b[j] + b[i] * slope[j][a]);
      for (unsigned int c = 0; c <= a; ++c)
      {
        shape.second[i][a + c] = 4. * slope[i][a] * slope[i][c];
        shape.second[middle][a + c] = 4. * (slope[i][a] * slope[j][c] + slope[i][c] * slope[j][a]);
      }
    }
  }
  return shape;
}
} // namespace

template <int dim>
FacetShape<dim> evaluate_facet_shape(const FacetElement<dim> &element, const LocalPoint<dim> &xi)
{
  assert(element.degree == 1 || element.degree == 2);
  if constexpr (dim == 2)
    return evaluate_line(element.degree, xi);
  else if (element.type == FacetType::triangle)
    return evaluate_triangle(element.degree, xi);
  else
    return evaluate_tensor_product(element.degree, xi);
}

template <int dim>
FacetNodes<dim> gather_nodes(const Facet<dim> &facet, const std::vector<SpatialVector<dim>> &positions)
{
  FacetNodes<dim> nodes;
  static_cast<FacetElement<dim> &>(nodes) = facet;
  const unsigned int n_nodes = facet.n_nodes();
  for (unsigned int i = 0; i < n_nodes; ++i)
    nodes.position[i] = positions[facet.nodes[i]];
  return nodes;
}

template <int dim>
FacetFrame<dim> evaluate_facet_frame(const FacetNodes<dim> &nodes, const LocalPoint<dim> &xi)
{
  const FacetShape<dim> shape = evaluate_facet_shape(nodes, xi);
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
std::optional<std::array<SpatialVector<dim>, dim - 1>> find_oblique_dual(const FacetFrame<dim> &frame,
                                                                         const SpatialVector<dim> &normal)
{
  constexpr double least_slope = 1e-3;
  SpatialTensor<dim> axes;
  double volume = 1.;
  for (unsigned int i = 0; i < dim - 1; ++i)
  {
    axes.col(i) = frame.tangent[i];
    volume *= frame.tangent[i].norm();
  }
  axes.col(dim - 1) = normal;
  if (!(std::abs(axes.determinant()) > least_slope * volume))
    return {};
  const SpatialTensor<dim> inverse = axes.inverse();
  std::array<SpatialVector<dim>, dim - 1> dual;
  for (unsigned int i = 0; i < dim - 1; ++i)
    dual[i] = inverse.row(i).transpose();
  return dual;
}

template <int dim>
std::vector<SpatialVector<dim>> make_lattice(const Facet<dim> &facet,
                                             const std::vector<SpatialVector<dim>> &positions, double spacing)
{
  constexpr double most = 64.;
  const FacetNodes<dim> nodes = gather_nodes(facet, positions);
  const bool is_triangle = facet.type == FacetType::triangle;
  const auto count_steps = [&](const unsigned int a, const unsigned int b)
  {
    const double length = (nodes.position[b] - nodes.position[a]).norm();
    return static_cast<unsigned int>(std::clamp(std::ceil(length / spacing), 1., most));
  };
  std::array<unsigned int, 2> n_steps{{0, 0}};
  if (is_triangle)
    n_steps.fill(std::max({count_steps(0, 1), count_steps(1, 2), count_steps(2, 0)}));
  else
    for (unsigned int direction = 0; direction < dim - 1; ++direction)
      n_steps[direction] = count_steps(0, facet.degree * (direction == 0 ? 1 : facet.degree + 1));

  std::vector<SpatialVector<dim>> points;
  for (unsigned int j = 0; j <= n_steps[1]; ++j)
    for (unsigned int i = 0; i + (is_triangle ? j : 0) <= n_steps[0]; ++i)
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
LocalPoint<dim> node_coordinates(const FacetElement<dim> &element, unsigned int i)
{
  if constexpr (dim == 3)
    if (element.type == FacetType::triangle)
    {
      constexpr std::array<std::array<double, 2>, 6> triangle{
          {{0., 0.}, {1., 0.}, {0., 1.}, {0.5, 0.}, {0.5, 0.5}, {0., 0.5}}};
      return {triangle[i][0], triangle[i][1]};
    }
  const unsigned int n_line = element.degree + 1;
  LocalPoint<dim> xi;
  for (int d = 0; d < dim - 1; ++d)
    xi[d] = static_cast<double>(d == 0 ? i % n_line : i / n_line) / element.degree;
  return xi;
}

template <int dim>
double evaluate_hat_function(const FacetElement<dim> &element, unsigned int i, const LocalPoint<dim> &xi)
{
  if constexpr (dim == 3)
    if (element.type == FacetType::triangle)
    {
      const std::array<double, 3> b = barycentric_coordinates(xi);
      if (element.degree == 1)
        return std::max(0., b[i]);
      if (i < 3)
        return std::max(0., 2. * b[i] - 1.);
      const double first = b[i - 3], second = b[(i - 2) % 3], opposite = b[(i - 1) % 3];
      return std::max(0., std::min({2. * first, 2. * second, 1. - 2. * opposite}));
    }
  const LocalPoint<dim> node = node_coordinates(element, i);
  double value = 1.;
  for (int d = 0; d < dim - 1; ++d)
    value *= std::max(0., 1. - element.degree * std::abs(xi[d] - node[d]));
  return value;
}

const std::vector<SubFacet> &get_sub_facets(const FacetElement<3> &element)
{
  static const std::vector<SubFacet> quadrilateral{{4, {0, 1, 3, 2}}};
  static const std::vector<SubFacet> quadratic_quadrilateral{
      {4, {0, 1, 4, 3}}, {4, {1, 2, 5, 4}}, {4, {3, 4, 7, 6}}, {4, {4, 5, 8, 7}}};
  static const std::vector<SubFacet> triangle{{3, {0, 1, 2}}};
  static const std::vector<SubFacet> quadratic_triangle{
      {3, {0, 3, 5}}, {3, {3, 1, 4}}, {3, {5, 4, 2}}, {3, {3, 4, 5}}};
  if (element.type == FacetType::triangle)
    return element.degree == 1 ? triangle : quadratic_triangle;
  return element.degree == 1 ? quadrilateral : quadratic_quadrilateral;
}

template std::vector<SpatialVector<2>> make_lattice(const Facet<2> &, const std::vector<SpatialVector<2>> &,
                                                    double);
template std::vector<SpatialVector<3>> make_lattice(const Facet<3> &, const std::vector<SpatialVector<3>> &,
                                                    double);
template LocalPoint<2> node_coordinates(const FacetElement<2> &, unsigned int);
template LocalPoint<3> node_coordinates(const FacetElement<3> &, unsigned int);
template double evaluate_hat_function(const FacetElement<2> &, unsigned int, const LocalPoint<2> &);
template double evaluate_hat_function(const FacetElement<3> &, unsigned int, const LocalPoint<3> &);
template FacetShape<2> evaluate_facet_shape(const FacetElement<2> &, const LocalPoint<2> &);
template FacetShape<3> evaluate_facet_shape(const FacetElement<3> &, const LocalPoint<3> &);
template FacetNodes<2> gather_nodes(const Facet<2> &, const std::vector<SpatialVector<2>> &);
template FacetNodes<3> gather_nodes(const Facet<3> &, const std::vector<SpatialVector<3>> &);
template FacetFrame<2> evaluate_facet_frame(const FacetNodes<2> &, const LocalPoint<2> &);
template FacetFrame<3> evaluate_facet_frame(const FacetNodes<3> &, const LocalPoint<3> &);
template std::optional<std::array<SpatialVector<2>, 1>> find_oblique_dual(const FacetFrame<2> &,
                                                                          const SpatialVector<2> &);
template std::optional<std::array<SpatialVector<3>, 2>> find_oblique_dual(const FacetFrame<3> &,
                                                                          const SpatialVector<3> &);
} // namespace signorini::contact
