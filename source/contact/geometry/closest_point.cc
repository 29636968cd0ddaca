// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/geometry/closest_point.h"

#include "signorini/contact/geometry/patch.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace signorini::contact
{
namespace
{
template <int dim>
using LocalTensor = Eigen::Matrix<double, dim - 1, dim - 1>;

template <int dim>
constexpr int second_index(const int a, const int b)
{
  return dim == 2 ? 0 : a + b;
}

/// Hessian of ½|r|².
template <int dim>
LocalTensor<dim> compute_hessian(const Jet<dim> &jet)
{
  LocalTensor<dim> hessian;
  for (int a = 0; a < dim - 1; ++a)
    for (int b = 0; b <= a; ++b)
      hessian(a, b) = hessian(b, a) =
          jet.first[a].dot(jet.first[b]) + jet.value.dot(jet.second[second_index<dim>(a, b)]);
  return hessian;
}

template <int dim>
bool is_positive_definite(const LocalTensor<dim> &h)
{
  if constexpr (dim == 2)
    return h(0, 0) > 0.;
  else
    return h(0, 0) > 0. && h(1, 1) > 0. && h(0, 0) * h(1, 1) * (1. - 1e-12) > h(0, 1) * h(0, 1);
}

/// A positive definite stand-in for an indefinite Hessian: the true curvature along a side the minimum is
/// pressed against, so that Newton's method still converges fast there; elsewhere that of a facet without
/// curvature.
template <int dim>
LocalTensor<dim> make_convex_hessian(const Jet<dim> &jet, const LocalTensor<dim> &hessian,
                                     const LocalPoint<dim> &gradient, const LocalPoint<dim> &s)
{
  LocalTensor<dim> convex;
  for (int a = 0; a < dim - 1; ++a)
    for (int b = 0; b < dim - 1; ++b)
      convex(a, b) = jet.first[a].dot(jet.first[b]);
  convex.diagonal().array() += 1e-10 * convex.trace() + std::numeric_limits<double>::min();
  if constexpr (dim == 3)
    for (int a = 0; a < 2; ++a)
      if (std::abs(s[a]) == 1. && s[a] * gradient[a] < 0. && hessian(1 - a, 1 - a) > 0.)
      {
        convex(0, 1) = convex(1, 0) = 0.;
        convex(1 - a, 1 - a) = hessian(1 - a, 1 - a);
      }
  return convex;
}

/// Minimum of the quadratic model g·(t − s) + ½(t − s)·H(t − s) over t in the square, H positive definite.
template <int dim>
LocalPoint<dim> minimise_model(const LocalPoint<dim> &g, const LocalTensor<dim> &h, const LocalPoint<dim> &s)
{
  if constexpr (dim == 2)
    return LocalPoint<dim>(std::clamp(s[0] - g[0] / h(0, 0), -1., 1.));
  else
  {
    const double determinant = h(0, 0) * h(1, 1) - h(0, 1) * h(0, 1);
    const LocalPoint<dim> inner =
        s - LocalPoint<dim>(h(1, 1) * g[0] - h(0, 1) * g[1], h(0, 0) * g[1] - h(0, 1) * g[0]) / determinant;
    if (std::abs(inner[0]) <= 1. && std::abs(inner[1]) <= 1.)
      return inner;

    // The model falls from its minimum over the square straight towards `inner`, so that minimum lies on a
    // side that `inner` is beyond of.
    LocalPoint<dim> best = s;
    double best_value = std::numeric_limits<double>::max();
    for (int a = 0; a < 2; ++a)
      if (std::abs(inner[a]) > 1.)
      {
        const int b = 1 - a;
        LocalPoint<dim> t;
        t[a] = std::copysign(1., inner[a]);
        t[b] = std::clamp(s[b] - (g[b] + h(a, b) * (t[a] - s[a])) / h(b, b), -1., 1.);
        const LocalPoint<dim> p = t - s;
        const double value = g.dot(p) + 0.5 * p.dot(h * p);
        if (value < best_value)
        {
          best_value = value;
          best = t;
        }
      }
    return best;
  }
}

/// A place on the square and ½|r|² there.
template <int dim>
struct Minimum
{
  LocalPoint<dim> s = LocalPoint<dim>::Zero();
  SpatialVector<dim> r;
  double value = std::numeric_limits<double>::max();
};

/// Newton's method on the square: each step goes to the exact minimum of the quadratic model over the square,
/// which finds the active sides at once. A step p leaves an error of about `contraction`·|p|².
template <int dim, int degree>
Minimum<dim> descend(const Patch<dim, degree> &patch, const LocalPoint<dim> &start, const double contraction)
{
  constexpr unsigned int max_n_steps = 50;
  Minimum<dim> now;
  now.s = start;
  Jet<dim> jet = evaluate_jet(patch, now.s);
  now.value = 0.5 * jet.value.squaredNorm();
  for (unsigned int step = 0; step < max_n_steps; ++step)
  {
    LocalPoint<dim> gradient;
    for (int a = 0; a < dim - 1; ++a)
      gradient[a] = jet.value.dot(jet.first[a]);
    LocalTensor<dim> hessian = compute_hessian(jet);
    if (!is_positive_definite<dim>(hessian))
      hessian = make_convex_hessian(jet, hessian, gradient, now.s);
    const LocalPoint<dim> target = minimise_model<dim>(gradient, hessian, now.s), p = target - now.s;
    const double length = p.template lpNorm<Eigen::Infinity>(), slope = gradient.dot(p);
    if (length == 0.)
      break;

    // What round-off in r can do to ½|r|²: without it the last steps would be refused and half the digits
    // lost.
    double noise = jet.value.norm();
    for (int a = 0; a < dim - 1; ++a)
      noise += jet.first[a].norm();
    noise *= 4e-15 * jet.value.norm();

    double part = 1., value = 0.;
    LocalPoint<dim> s = target;
    for (; part > 1e-6; part *= 0.5, s = now.s + part * p)
    {
      jet = evaluate_jet(patch, s);
      value = 0.5 * jet.value.squaredNorm();
      if (value <= now.value + noise + 1e-4 * part * slope)
        break;
    }
    if (part <= 1e-6) // no descent left above round-off
    {
      jet = evaluate_jet(patch, now.s);
      break;
    }
    now.s = s;
    now.value = value;
    if (part == 1. && contraction * length * length < 1e-18)
      break;
  }
  now.r = jet.value;
  return now;
}

/// Where ½|r|² is surely convex on the whole square: how fast Newton's method contracts; otherwise a negative
/// number. Bounds how far the Hessian may leave its value at the middle, entry by entry, and so does not care
/// for the facet's aspect ratio.
template <int dim, int degree>
double bound_contraction(const Patch<dim, degree> &patch)
{
  constexpr int n = degree + 1, n_second = FacetShape<dim>::n_second;
  double drift = 0.;
  std::array<double, dim - 1> first_drift{};
  std::array<double, n_second> second_drift{}, second_middle{};
  for (int k = 1; k < patch.n_coefficients; ++k)
  {
    const int i = k % n, j = k / n;
    const double size = patch.coefficient[k].norm();
    drift += size;
    if (k > 1)
      first_drift[0] += i * size;
    (i == 2 && j == 0 ? second_middle : second_drift)[0] += i * (i - 1) * size;
    if constexpr (dim == 3)
    {
      if (k != n)
        first_drift[1] += j * size;
      (i == 1 && j == 1 ? second_middle : second_drift)[1] += i * j * size;
      (i == 0 && j == 2 ? second_middle : second_drift)[2] += j * (j - 1) * size;
    }
  }

  const Jet<dim> middle = evaluate_jet(patch, LocalPoint<dim>(LocalPoint<dim>::Zero()));
  const LocalTensor<dim> hessian = compute_hessian(middle);
  std::array<double, dim - 1> tangent;
  for (int a = 0; a < dim - 1; ++a)
    tangent[a] = middle.first[a].norm();
  const double distance = middle.value.norm();
  const auto bound_drift = [&](const int a, const int b)
  {
    const int c = second_index<dim>(a, b);
    return tangent[a] * first_drift[b] + tangent[b] * first_drift[a] + first_drift[a] * first_drift[b] +
           drift * (second_middle[c] + second_drift[c]) + distance * second_drift[c];
  };

  const double drift_00 = bound_drift(0, 0), low_00 = hessian(0, 0) - drift_00;
  if (low_00 <= 0.)
    return -1.;
  if constexpr (dim == 2)
    return 4. * drift_00 / low_00;
  else
  {
    const double drift_11 = bound_drift(1, 1), low_11 = hessian(1, 1) - drift_11;
    const double drift_01 = bound_drift(0, 1), high_01 = std::abs(hessian(0, 1)) + drift_01;
    if (low_11 <= 0. || low_00 * low_11 <= high_01 * high_01)
      return -1.;
    return 4. * (drift_00 / low_00 + drift_11 / low_11 + 2. * drift_01 / std::sqrt(low_00 * low_11)) /
           (1. - high_01 * high_01 / (low_00 * low_11));
  }
}

/// Lowers `best` to the minimum over the part of the square with the given middle and half width: descends
/// from its middle, and halves it until the function is convex there or the part is surely too far away.
template <int dim, int degree>
void search_part(const Patch<dim, degree> &part, const LocalPoint<dim> &middle, const double half_width,
                 Minimum<dim> &best)
{
  constexpr double smallest_half_width = 1. / 16.;
  double reach = 0.;
  for (int k = 1; k < part.n_coefficients; ++k)
    reach += part.coefficient[k].norm();
  const double lowest = std::max(0., part.coefficient[0].norm() - reach);
  if (0.5 * lowest * lowest >= best.value)
    return;

  const double contraction = bound_contraction(part);
  Minimum<dim> found = descend(part, LocalPoint<dim>(LocalPoint<dim>::Zero()), std::max(contraction, 1e6));
  if (found.value < best.value)
  {
    best = found;
    best.s = middle + half_width * found.s;
  }
  if (contraction >= 0. || half_width <= smallest_half_width)
    return;
  for (int child = 0; child < (1 << (dim - 1)); ++child)
  {
    LocalPoint<dim> offset;
    for (int a = 0; a < dim - 1; ++a)
      offset[a] = ((child >> a) & 1) ? 0.5 : -0.5;
    search_part(make_part(part, offset), LocalPoint<dim>(middle + half_width * offset), 0.5 * half_width,
                best);
  }
}

template <int dim, int degree>
ClosestPoint<dim> find_on_patch(const FacetNodes<dim> &nodes, const SpatialVector<dim> &x)
{
  const Patch<dim, degree> patch = make_patch<dim, degree>(nodes, x);
  const double contraction = bound_contraction(patch);
  Minimum<dim> best;
  if (contraction >= 0.)
    best = descend(patch, LocalPoint<dim>(LocalPoint<dim>::Zero()), contraction);
  else
  {
    search_part(patch, LocalPoint<dim>(LocalPoint<dim>::Zero()), 1., best);
    best = descend(patch, LocalPoint<dim>(best.s), 1e6);
  }

  ClosestPoint<dim> closest;
  closest.position = x + best.r;
  closest.distance = best.r.norm();
  for (int a = 0; a < dim - 1; ++a)
  {
    closest.xi[a] = 0.5 + 0.5 * best.s[a];
    closest.free[a] = (closest.xi[a] > 0. && closest.xi[a] < 1.);
  }
  return closest;
}
} // namespace

template <int dim>
ClosestPoint<dim> find_closest_point(const FacetNodes<dim> &nodes, const SpatialVector<dim> &x)
{
  return nodes.degree == 1 ? find_on_patch<dim, 1>(nodes, x) : find_on_patch<dim, 2>(nodes, x);
}

template ClosestPoint<2> find_closest_point(const FacetNodes<2> &, const SpatialVector<2> &);
template ClosestPoint<3> find_closest_point(const FacetNodes<3> &, const SpatialVector<3> &);
} // namespace signorini::contact
