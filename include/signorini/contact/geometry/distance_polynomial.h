// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/geometry/facet_shape.h"
#include "signorini/contact/geometry/local_domain.h"

#include <cmath>

// Inline throughout: this is the innermost loop of contact search.
namespace signorini::contact
{
/// A polynomial on s ∈ [−1, 1]^n_directions of up to `degree` in each direction: the coefficient of s_0^i
/// s_1^j has index i + (degree + 1) j. Powers about the middle make a bound over the whole square one sum of
/// magnitudes.
template <typename Value, int n_directions, int degree>
struct SquarePolynomial
{
  static constexpr int n_line = degree + 1;
  static constexpr int n_coefficients = (n_directions == 1 ? n_line : n_line * n_line);

  std::array<Value, n_coefficients> coefficient;

  /// Calls `change(first, stride)` for every line of coefficients along direction `a`.
  template <typename Change>
  void for_each_line(const int a, const Change &change)
  {
    const int stride = (a == 0 ? 1 : n_line), next = (a == 0 ? n_line : 1);
    for (int line = 0; line < n_coefficients / n_line; ++line)
      change(&coefficient[line * next], stride);
  }
};

/// r(s) = y − x for a facet; s = 2ξ − 1.
template <int dim, int degree>
using Patch = SquarePolynomial<SpatialVector<dim>, dim - 1, degree>;

/// ½|r(s)|².
template <int dim, int degree>
using DistancePolynomial = SquarePolynomial<double, dim - 1, 2 * degree>;

/// Value and two derivatives of a function of s.
template <int dim>
struct LocalJet
{
  double value;
  LocalPoint<dim> gradient;
  LocalTensor<dim> hessian;
};

/// Turns the nodes of a triangle into those of the square that it is half of: the same polynomial continued,
/// whose mixed second difference is the same everywhere.
template <int degree>
void continue_to_square(std::array<SpatialVector<3>, (degree + 1) * (degree + 1)> &node)
{
  constexpr int n = degree + 1;
  SpatialVector<3> mixed = SpatialVector<3>::Zero();
  if constexpr (degree == 2)
  {
    node = {node[0], node[3], node[1], node[5], node[4], node[4], node[2], node[4], node[4]};
    mixed = node[n + 1] - node[n] - node[1] + node[0];
  }
  for (int j = 1; j <= degree; ++j)
    for (int i = n - j; i <= degree; ++i)
      node[i + n * j] = node[i - 1 + n * j] + node[i + n * (j - 1)] - node[i - 1 + n * (j - 1)] + mixed;
}

/// The facet as seen from x.
template <int dim, FacetType type, int degree>
Patch<dim, degree> make_patch(const FacetNodes<dim> &nodes, const SpatialVector<dim> &x)
{
  Patch<dim, degree> patch;
  for (int i = 0; i < patch.n_coefficients; ++i)
    patch.coefficient[i] = nodes.position[i] - x;
  if constexpr (type == FacetType::triangle)
    continue_to_square<degree>(patch.coefficient);
  const auto change_to_powers = [](SpatialVector<dim> *c, const int stride)
  {
    const SpatialVector<dim> begin = c[0], end = c[degree * stride];
    if constexpr (degree == 1)
      c[0] = 0.5 * (begin + end);
    else
    {
      c[0] = c[stride];
      c[2 * stride] = 0.5 * (begin + end) - c[0];
    }
    c[stride] = 0.5 * (end - begin);
  };
  for (int a = 0; a < dim - 1; ++a)
    patch.for_each_line(a, change_to_powers);
  return patch;
}

template <int dim, int degree>
SpatialVector<dim> evaluate_patch(const Patch<dim, degree> &patch, const LocalPoint<dim> &s)
{
  constexpr int n = degree + 1;
  const auto evaluate_row = [&](const int j)
  {
    SpatialVector<dim> r = patch.coefficient[n * j + degree];
    for (int i = degree - 1; i >= 0; --i)
      r = patch.coefficient[n * j + i] + s[0] * r;
    return r;
  };
  SpatialVector<dim> r = evaluate_row(patch.n_coefficients / n - 1);
  if constexpr (dim == 3)
    for (int j = degree - 1; j >= 0; --j)
      r = evaluate_row(j) + s[1] * r;
  return r;
}

template <int dim, int degree>
DistancePolynomial<dim, degree> make_distance_polynomial(const Patch<dim, degree> &patch)
{
  constexpr int n = degree + 1, n_product = 2 * degree + 1;
  DistancePolynomial<dim, degree> product;
  product.coefficient.fill(0.);
  for (int k = 0; k < patch.n_coefficients; ++k)
  {
    product.coefficient[2 * (k % n) + n_product * 2 * (k / n)] += 0.5 * patch.coefficient[k].squaredNorm();
    for (int l = 0; l < k; ++l)
      product.coefficient[k % n + l % n + n_product * (k / n + l / n)] +=
          patch.coefficient[k].dot(patch.coefficient[l]);
  }
  return product;
}

/// Value, first and second derivative of the polynomial Σ c_i s^i.
template <int n>
std::array<double, 3> evaluate_line(const double *c, const double s)
{
  double value = c[n - 1], first = 0., half_second = 0.;
  for (int i = n - 2; i >= 0; --i)
  {
    half_second = half_second * s + first;
    first = first * s + value;
    value = value * s + c[i];
  }
  return {value, first, 2. * half_second};
}

template <int dim, int degree>
LocalJet<dim> evaluate_jet(const SquarePolynomial<double, dim - 1, degree> &polynomial,
                           const LocalPoint<dim> &s)
{
  constexpr int n = degree + 1;
  LocalJet<dim> jet;
  if constexpr (dim == 2)
  {
    const auto line = evaluate_line<n>(polynomial.coefficient.data(), s[0]);
    jet.value = line[0];
    jet.gradient[0] = line[1];
    jet.hessian(0, 0) = line[2];
  }
  else
  {
    std::array<std::array<double, n>, 3> row;
    for (int j = 0; j < n; ++j)
    {
      const auto line = evaluate_line<n>(&polynomial.coefficient[n * j], s[0]);
      for (int order = 0; order < 3; ++order)
        row[order][j] = line[order];
    }
    const auto value = evaluate_line<n>(row[0].data(), s[1]);
    const auto first = evaluate_line<n>(row[1].data(), s[1]);
    jet.value = value[0];
    jet.gradient = {first[0], value[1]};
    jet.hessian << evaluate_line<n>(row[2].data(), s[1])[0], first[1], first[1], value[2];
  }
  return jet;
}

/// The polynomial on the quarter (half) of the square whose middle is at `middle`, stretched to [−1, 1]
/// again.
template <int dim, int degree>
SquarePolynomial<double, dim - 1, degree> make_part(SquarePolynomial<double, dim - 1, degree> polynomial,
                                                    const LocalPoint<dim> &middle)
{
  for (int a = 0; a < dim - 1; ++a)
    polynomial.for_each_line(a,
                             [m = middle[a]](double *c, const int stride)
                             {
                               for (int i = 0; i < degree; ++i)
                                 for (int j = degree - 1; j >= i; --j)
                                   c[j * stride] += m * c[(j + 1) * stride];
                               for (int i = 1; i <= degree; ++i)
                                 c[i * stride] = std::ldexp(c[i * stride], -i);
                             });
  return polynomial;
}
} // namespace signorini::contact
