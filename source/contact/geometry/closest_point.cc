// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/geometry/closest_point.h"

#include "signorini/contact/geometry/distance_polynomial.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace signorini::contact
{
namespace
{
template <int dim>
bool is_positive_definite(const LocalTensor<dim> &h)
{
  if constexpr (dim == 2)
    return h(0, 0) > 0.;
  else
    return h(0, 0) > 0. && h(1, 1) > 0. && h(0, 0) * h(1, 1) * (1. - 1e-12) > h(0, 1) * h(0, 1);
}

/// A side of the local domain of a facet in 3-D in the coordinates s, counter-clockwise.
struct Side
{
  LocalPoint<3> begin, along;

  /// Positive on the inner side, and 0 for points that minimise_model() put on this one.
  double height(const LocalPoint<3> &s) const { return cross(along, s - begin); }
};

template <FacetType type>
Side make_side(const unsigned int k)
{
  const LocalPoint<3> begin = local_corner(type, k), end = local_corner(type, k + 1);
  return {2. * begin - LocalPoint<3>::Ones(), 2. * (end - begin)};
}

/// A positive definite stand-in for an indefinite Hessian. Where the minimum is pressed against a side, the
/// true curvature along that side, so that Newton's method still converges fast there.
template <int dim, FacetType type>
LocalTensor<dim> make_convex_hessian(const LocalJet<dim> &jet, const LocalPoint<dim> &s)
{
  const double floor = 1e-3 * jet.hessian.diagonal().cwiseAbs().sum() + std::numeric_limits<double>::min();
  if constexpr (dim == 2)
    return LocalTensor<dim>(std::max(std::abs(jet.hessian(0, 0)), floor));
  else
  {
    LocalPoint<dim> along = LocalPoint<dim>::UnitX();
    bool is_pressed = false;
    for (unsigned int k = 0; k < n_local_corners(type) && !is_pressed; ++k)
    {
      const Side side = make_side<type>(k);
      is_pressed = side.height(s) == 0. && cross(side.along, jet.gradient) > 0.;
      if (is_pressed)
        along = side.along.normalized();
    }
    const LocalPoint<dim> across(-along[1], along[0]);
    const double curvature = along.dot(jet.hessian * along);
    return (is_pressed && curvature > 0. ? curvature : std::max(std::abs(curvature), floor)) * along *
               along.transpose() +
           std::max(std::abs(across.dot(jet.hessian * across)), floor) * across * across.transpose();
  }
}

/// Minimum of the quadratic model g·(t − s) + ½(t − s)·H(t − s) over t in the domain, H positive definite.
template <int dim, FacetType type>
LocalPoint<dim> minimise_model(const LocalPoint<dim> &g, const LocalTensor<dim> &h, const LocalPoint<dim> &s)
{
  if constexpr (dim == 2)
    return LocalPoint<dim>(std::clamp(s[0] - g[0] / h(0, 0), -1., 1.));
  else
  {
    const double determinant = h(0, 0) * h(1, 1) - h(0, 1) * h(0, 1);
    const LocalPoint<dim> inner =
        s - LocalPoint<dim>(h(1, 1) * g[0] - h(0, 1) * g[1], h(0, 0) * g[1] - h(0, 1) * g[0]) / determinant;

    // The model falls from its minimum over the domain straight towards `inner`, so that minimum lies on a
    // side that `inner` is beyond of.
    LocalPoint<dim> best = inner;
    double best_value = std::numeric_limits<double>::max();
    for (unsigned int k = 0; k < n_local_corners(type); ++k)
    {
      const Side side = make_side<type>(k);
      if (side.height(inner) >= 0.)
        continue;
      const LocalPoint<dim> h_along = h * side.along;
      const double slope = g.dot(side.along) + h_along.dot(side.begin - s);
      const LocalPoint<dim> t =
          side.begin + std::clamp(-slope / side.along.dot(h_along), 0., 1.) * side.along;
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

/// Newton's method on the domain from `s`: each step goes to the exact minimum of the quadratic model over
/// the domain, which finds the active sides at once. A step p leaves an error of about `contraction`·|p|².
template <int dim, FacetType type, int degree>
LocalPoint<dim> descend(const SquarePolynomial<double, dim - 1, degree> &polynomial, LocalPoint<dim> s,
                        const double contraction)
{
  constexpr unsigned int max_n_steps = 50;
  LocalJet<dim> jet = evaluate_jet<dim, degree>(polynomial, s);
  // What round-off can do to the value: without it the last steps would be refused and half the digits lost.
  double noise = 0.;
  for (const double c : polynomial.coefficient)
    noise += 1e-15 * std::abs(c);
  for (unsigned int step = 0; step < max_n_steps; ++step)
  {
    if (!is_positive_definite<dim>(jet.hessian))
      jet.hessian = make_convex_hessian<dim, type>(jet, s);
    const LocalPoint<dim> target = minimise_model<dim, type>(jet.gradient, jet.hessian, s), p = target - s;
    const double length = p.template lpNorm<Eigen::Infinity>(), slope = jet.gradient.dot(p);
    if (contraction * length * length < 1e-18)
      return target;

    double part = 1.;
    LocalPoint<dim> next = target;
    LocalJet<dim> next_jet = evaluate_jet<dim, degree>(polynomial, next);
    while (next_jet.value > jet.value + noise + 1e-4 * part * slope)
    {
      part *= 0.5;
      if (part < 1e-6)
        return s;
      next = s + part * p;
      next_jet = evaluate_jet<dim, degree>(polynomial, next);
    }
    s = next;
    jet = next_jet;
  }
  return s;
}

/// Where the polynomial is surely convex on the whole square: how fast Newton's method contracts; otherwise a
/// negative number. Bounds how far the Hessian may leave its value at the middle, entry by entry, and so does
/// not care for the facet's aspect ratio.
template <int dim, int degree>
double bound_contraction(const SquarePolynomial<double, dim - 1, degree> &polynomial)
{
  constexpr int n = degree + 1;
  const auto &c = polynomial.coefficient;
  double drift_00 = 0., drift_01 = 0., drift_11 = 0.;
  for (int k = 0; k < polynomial.n_coefficients; ++k)
  {
    const int i = k % n, j = k / n;
    const double size = std::abs(c[k]);
    drift_00 += (k != 2 ? i * (i - 1) * size : 0.);
    drift_01 += (k != n + 1 ? i * j * size : 0.);
    drift_11 += (k != 2 * n ? j * (j - 1) * size : 0.);
  }
  const double low_00 = 2. * c[2] - drift_00;
  if (low_00 <= 0.)
    return -1.;
  if constexpr (dim == 2)
    return 4. * drift_00 / low_00;
  else
  {
    const double low_11 = 2. * c[2 * n] - drift_11, high_01 = std::abs(c[n + 1]) + drift_01;
    if (low_11 <= 0. || low_00 * low_11 <= high_01 * high_01)
      return -1.;
    return 4. * (drift_00 / low_00 + drift_11 / low_11 + 2. * drift_01 / std::sqrt(low_00 * low_11)) /
           (1. - high_01 * high_01 / (low_00 * low_11));
  }
}

/// Below this the polynomial does not fall on the square.
template <int n_directions, int degree>
double bound_value(const SquarePolynomial<double, n_directions, degree> &polynomial)
{
  constexpr int n = degree + 1;
  double low = polynomial.coefficient[0];
  for (int k = 1; k < polynomial.n_coefficients; ++k)
  {
    const double c = polynomial.coefficient[k];
    const bool is_even = (k % n) % 2 == 0 && (k / n) % 2 == 0;
    low -= (is_even ? std::max(0., -c) : std::abs(c));
  }
  return low;
}

/// The same for a polynomial known to be convex there: its tangent plane at the middle bounds it.
template <int n_directions, int degree>
double bound_tangent_plane(const SquarePolynomial<double, n_directions, degree> &polynomial)
{
  const auto &c = polynomial.coefficient;
  return c[0] - std::abs(c[1]) -
         (n_directions == 2 ? std::abs(c[(degree + 1) % polynomial.n_coefficients]) : 0.);
}

constexpr double careful = 1e6; ///< a contraction no polynomial is expected to exceed

/// Looks for the lowest of several minima of the distance to one facet.
template <int dim, FacetType type, int degree>
class GlobalSearch
{
public:
  GlobalSearch(const Patch<dim, degree> &facet, const DistancePolynomial<dim, degree> &squared_distance)
      : patch(facet), polynomial(squared_distance)
  {
    descend_from(LocalPoint<dim>::Zero());
    search_part<type>(polynomial, LocalPoint<dim>::Zero(), 1.);
  }

  const LocalPoint<dim> &place() const { return best; }

private:
  const Patch<dim, degree> &patch;
  const DistancePolynomial<dim, degree> &polynomial;
  LocalPoint<dim> best; ///< always a minimum over a neighbourhood in the whole domain
  double best_value = std::numeric_limits<double>::max();

  double evaluate(const LocalPoint<dim> &s) const
  {
    return 0.5 * evaluate_patch<dim, degree>(patch, s).squaredNorm();
  }

  void descend_from(const LocalPoint<dim> &start)
  {
    best = descend<dim, type, 2 * degree>(polynomial, start, careful);
    best_value = evaluate(best);
  }

  template <FacetType part_type>
  void search_part(const DistancePolynomial<dim, degree> &part, const LocalPoint<dim> &middle,
                   double half_width);
  template <FacetType part_type>
  void search_children(const DistancePolynomial<dim, degree> &part, const LocalPoint<dim> &middle,
                       double half_width);
};

/// Halves the part of the domain in the square with the given middle and half width until the function is
/// convex there, then descends, unless the part is surely not low enough.
template <int dim, FacetType type, int degree>
template <FacetType part_type>
void GlobalSearch<dim, type, degree>::search_part(const DistancePolynomial<dim, degree> &part,
                                                  const LocalPoint<dim> &middle, const double half_width)
{
  constexpr double smallest_half_width = 1. / 16.;
  if (bound_value(part) >= best_value)
    return;
  const double contraction = bound_contraction<dim, 2 * degree>(part);
  const bool is_convex = contraction >= 0.;
  // A convex function lies above its tangent plane, and has no second minimum beside one that is known.
  if (is_convex && (bound_tangent_plane(part) >= best_value ||
                    (best - middle).template lpNorm<Eigen::Infinity>() <= half_width))
    return;
  if (is_convex || half_width <= smallest_half_width)
  {
    const LocalPoint<dim> found =
        middle + half_width * descend<dim, part_type, 2 * degree>(part, LocalPoint<dim>::Zero(),
                                                                  is_convex ? contraction : careful);
    if (evaluate(found) < best_value)
      descend_from(found);
    return;
  }
  search_children<part_type>(part, middle, half_width);
}

/// A triangle is half of its square: one of the square's quarters is whole, two are halves, the last is
/// beyond.
template <int dim, FacetType type, int degree>
template <FacetType part_type>
void GlobalSearch<dim, type, degree>::search_children(const DistancePolynomial<dim, degree> &part,
                                                      const LocalPoint<dim> &middle, const double half_width)
{
  for (int child = 0; child < (1 << (dim - 1)); ++child)
  {
    LocalPoint<dim> offset;
    for (int a = 0; a < dim - 1; ++a)
      offset[a] = ((child >> a) & 1) ? 0.5 : -0.5;
    const LocalPoint<dim> child_middle = middle + half_width * offset;
    if (part_type == FacetType::tensor_product || child == 0)
      search_part<FacetType::tensor_product>(make_part<dim, 2 * degree>(part, offset), child_middle,
                                             0.5 * half_width);
    else if (child < 3)
      search_part<part_type>(make_part<dim, 2 * degree>(part, offset), child_middle, 0.5 * half_width);
  }
}

template <int dim, FacetType type, int degree>
ClosestPoint<dim> find_on_facet(const FacetNodes<dim> &nodes, const SpatialVector<dim> &x)
{
  const Patch<dim, degree> patch = make_patch<dim, type, degree>(nodes, x);
  const auto polynomial = make_distance_polynomial<dim, degree>(patch);
  const double contraction = bound_contraction<dim, 2 * degree>(polynomial);
  LocalPoint<dim> s = LocalPoint<dim>::Zero();
  if (contraction >= 0.)
    s = descend<dim, type, 2 * degree>(polynomial, s, contraction);
  else
    s = GlobalSearch<dim, type, degree>(patch, polynomial).place();

  const SpatialVector<dim> r = evaluate_patch<dim, degree>(patch, s);
  ClosestPoint<dim> closest;
  closest.position = x + r;
  closest.distance = r.norm();
  closest.xi = 0.5 * (LocalPoint<dim>::Ones() + s);
  if constexpr (type == FacetType::triangle)
    if (s.sum() >= 0.)
      closest.xi[1] = 1. - closest.xi[0];
  return closest;
}
} // namespace

template <int dim>
ClosestPoint<dim> find_closest_point(const FacetNodes<dim> &nodes, const SpatialVector<dim> &x)
{
  if constexpr (dim == 3)
    if (nodes.type == FacetType::triangle)
      return nodes.degree == 1 ? find_on_facet<dim, FacetType::triangle, 1>(nodes, x)
                               : find_on_facet<dim, FacetType::triangle, 2>(nodes, x);
  return nodes.degree == 1 ? find_on_facet<dim, FacetType::tensor_product, 1>(nodes, x)
                           : find_on_facet<dim, FacetType::tensor_product, 2>(nodes, x);
}

template ClosestPoint<2> find_closest_point(const FacetNodes<2> &, const SpatialVector<2> &);
template ClosestPoint<3> find_closest_point(const FacetNodes<3> &, const SpatialVector<3> &);
} // namespace signorini::contact
