// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/geometry/facet_shape.h"

// Inline throughout: this is the innermost loop of contact search.
namespace signorini::contact
{
/// r(s) = y − x as a polynomial in s ∈ [−1, 1]^(dim−1); the coefficient of s_0^i s_1^j has index i + (degree
/// + 1) j. Powers about the middle make bounds over the whole square one sum of norms.
template <int dim, int degree>
struct Patch
{
  static constexpr int n_line = degree + 1;
  static constexpr int n_coefficients = (dim == 2 ? n_line : n_line * n_line);

  std::array<SpatialVector<dim>, n_coefficients> coefficient;

  /// Calls `change(first, stride)` for every line of coefficients along direction `a`.
  template <typename Change>
  void for_each_line(const int a, const Change &change)
  {
    const int stride = (a == 0 ? 1 : n_line), next = (a == 0 ? n_line : 1);
    for (int line = 0; line < (dim == 2 ? 1 : n_line); ++line)
      change(&coefficient[line * next], stride);
  }
};

/// r and its derivatives at one place.
template <int dim>
struct Jet
{
  SpatialVector<dim> value;
  std::array<SpatialVector<dim>, dim - 1> first;
  std::array<SpatialVector<dim>, FacetShape<dim>::n_second> second;
};

/// Value and two derivatives of a polynomial in one variable.
template <int dim>
struct LineJet
{
  SpatialVector<dim> value, first, second;
};

/// The polynomial c_0 + c_1 s (+ c_2 s²).
template <int dim, int degree>
LineJet<dim> evaluate_line(const SpatialVector<dim> *c, const double s)
{
  if constexpr (degree == 1)
    return {c[0] + s * c[1], c[1], SpatialVector<dim>::Zero()};
  else
    return {c[0] + s * (c[1] + s * c[2]), c[1] + 2. * s * c[2], 2. * c[2]};
}

template <int dim, int degree>
Jet<dim> evaluate_jet(const Patch<dim, degree> &patch, const LocalPoint<dim> &s)
{
  if constexpr (dim == 2)
  {
    const auto line = evaluate_line<dim, degree>(patch.coefficient.data(), s[0]);
    return {line.value, {line.first}, {line.second}};
  }
  else
  {
    constexpr int n = degree + 1;
    std::array<SpatialVector<dim>, n> value, first, second;
    for (int j = 0; j < n; ++j)
    {
      const auto row = evaluate_line<dim, degree>(&patch.coefficient[n * j], s[0]);
      value[j] = row.value;
      first[j] = row.first;
      second[j] = row.second;
    }
    const auto v = evaluate_line<dim, degree>(value.data(), s[1]);
    const auto f = evaluate_line<dim, degree>(first.data(), s[1]);
    if constexpr (degree == 1)
      return {v.value, {f.value, v.first}, {SpatialVector<dim>::Zero(), f.first, SpatialVector<dim>::Zero()}};
    else
      return {v.value,
              {f.value, v.first},
              {evaluate_line<dim, degree>(second.data(), s[1]).value, f.first, v.second}};
  }
}

/// The facet as seen from x.
template <int dim, int degree>
Patch<dim, degree> make_patch(const FacetNodes<dim> &nodes, const SpatialVector<dim> &x)
{
  Patch<dim, degree> patch;
  for (int i = 0; i < patch.n_coefficients; ++i)
    patch.coefficient[i] = nodes.position[i] - x;
  for (int a = 0; a < dim - 1; ++a)
    patch.for_each_line(a,
                        [](SpatialVector<dim> *c, const int stride)
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
                        });
  return patch;
}

/// The quarter (half) of `patch` whose middle is at `middle`, stretched to [−1, 1]^(dim−1) again.
template <int dim, int degree>
Patch<dim, degree> make_part(Patch<dim, degree> patch, const LocalPoint<dim> &middle)
{
  for (int a = 0; a < dim - 1; ++a)
    patch.for_each_line(a,
                        [m = middle[a]](SpatialVector<dim> *c, const int stride)
                        {
                          if constexpr (degree == 1)
                          {
                            c[0] += m * c[stride];
                            c[stride] *= 0.5;
                          }
                          else
                          {
                            c[0] += m * (c[stride] + m * c[2 * stride]);
                            c[stride] = 0.5 * c[stride] + m * c[2 * stride];
                            c[2 * stride] *= 0.25;
                          }
                        });
  return patch;
}
} // namespace signorini::contact
