// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/geometry/simplex_overlap.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace signorini::contact
{
namespace
{
/// Round-off of barycentric coordinates of order 1.
constexpr double round_off = 1e-14;

constexpr double flat = 1e-12;

template <int dim>
using Coordinates = typename ConvexPolytope<dim>::Coordinates;

/// Volume of the simplex with these corners over that of simplex `of`, signed.
template <int dim>
double relative_volume(const Coordinates<dim> &apex, const std::array<const Coordinates<dim> *, dim> &base,
                       unsigned int of)
{
  // All but one of the coordinates are enough.
  SpatialTensor<dim> edges;
  for (unsigned int i = 0; i < dim; ++i)
    edges.col(i) = (*base[i] - apex).template segment<dim>(of * (dim + 1) + 1);
  return edges.determinant();
}

/// Area of the simplex with these corners over that of the face with this label.
template <int dim>
double relative_area(const std::array<const Coordinates<dim> *, dim> &corners, unsigned int label)
{
  const unsigned int of = label / (dim + 1), opposite = label % (dim + 1);
  const unsigned int u = of * (dim + 1) + (opposite + 1) % (dim + 1);
  const Coordinates<dim> along = *corners[1] - *corners[0];
  if constexpr (dim == 2)
    return std::abs(along[u]);
  else
  {
    const unsigned int v = of * (dim + 1) + (opposite + 2) % (dim + 1);
    const Coordinates<dim> across = *corners[2] - *corners[0];
    return std::abs(along[u] * across[v] - along[v] * across[u]);
  }
}

template <int dim>
std::array<double, 32> distances_where(const ConvexPolytope<dim> &polytope, unsigned int positive)
{
  std::array<double, 32> distances;
  for (std::size_t v = 0; v < polytope.vertices().size(); ++v)
    distances[v] = polytope.vertices()[v][positive];
  return distances;
}
} // namespace

template <int dim>
Eigen::Matrix<double, dim + 1, 1> SimplexShape<dim>::coordinates(const SpatialVector<dim> &x) const
{
  Eigen::Matrix<double, dim + 1, 1> lambda;
  for (unsigned int a = 0; a <= dim; ++a)
    lambda[a] = (a == 0 ? 1. : 0.) + gradients[a].dot(x - vertices[0]);
  return lambda;
}

template <int dim>
SimplexShape<dim> make_simplex_shape(const std::array<SpatialVector<dim>, dim + 1> &vertices)
{
  SimplexShape<dim> shape;
  shape.vertices = vertices;
  SpatialTensor<dim> edges;
  for (unsigned int i = 0; i < dim; ++i)
    edges.col(i) = vertices[i + 1] - vertices[0];
  const double determinant = edges.determinant();
  if (!(std::abs(determinant) > flat * edges.colwise().norm().prod()))
  {
    shape.gradients.fill(SpatialVector<dim>::Zero());
    return shape;
  }
  shape.volume = std::abs(determinant) / (dim == 2 ? 2. : 6.);
  const SpatialTensor<dim> inverse = edges.inverse();
  shape.gradients[0] = -inverse.colwise().sum().transpose();
  for (unsigned int i = 0; i < dim; ++i)
    shape.gradients[i + 1] = inverse.row(i).transpose();
  return shape;
}

template <int dim>
ConvexPolytope<dim> make_overlap(const SimplexShape<dim> &first, const SimplexShape<dim> &second,
                                 double margin)
{
  if (first.volume == 0. || second.volume == 0.)
    return {};
  constexpr unsigned int n = dim + 1;
  using Half = Eigen::Matrix<double, n, 1>;
  std::array<Half, n> of_second;
  for (unsigned int a = 0; a < n; ++a)
    of_second[a] = second.coordinates(first.vertices[a]);
  Half outward;
  for (unsigned int a = 0; a < n; ++a)
    outward[a] = margin * first.gradients[a].norm();

  std::array<Coordinates<dim>, n> corners;
  double largest = 1.;
  for (unsigned int a = 0; a < n; ++a)
  {
    Half lambda = -outward;
    lambda[a] += 1. + outward.sum();
    corners[a].template head<n>() = lambda;
    corners[a].template tail<n>() = of_second[a];
    if (margin > 0.)
    {
      corners[a].template tail<n>().setZero();
      for (unsigned int b = 0; b < n; ++b)
        corners[a].template tail<n>() += lambda[b] * of_second[b];
    }
    largest = std::max(largest, corners[a].cwiseAbs().maxCoeff());
  }
  ConvexPolytope<dim> overlap(corners);
  for (unsigned int face = 0; face < n && !overlap.is_empty(); ++face)
    overlap.clip(distances_where(overlap, n + face), n + face, round_off * largest);
  return overlap;
}

template <int dim>
ConvexPolytope<dim> restrict_to_sector(const ConvexPolytope<dim> &overlap, unsigned int of, unsigned int m)
{
  constexpr unsigned int first = dim + 1;
  // Most sectors are empty; that is seen without a copy.
  Coordinates<dim> excess = Coordinates<dim>::Zero();
  for (const Coordinates<dim> &corner : overlap.vertices())
    excess = excess.cwiseMax(corner - Coordinates<dim>::Constant(corner[of * first + m]));
  for (unsigned int k = of * first; k < (of + 1) * first; ++k)
    if (k != of * first + m && excess[k] <= round_off)
      return {};

  ConvexPolytope<dim> sector = overlap;
  for (unsigned int k = 0; k <= dim && !sector.is_empty(); ++k)
  {
    if (k == m)
      continue;
    std::array<double, 32> distances = distances_where(sector, of * first + k);
    for (std::size_t v = 0; v < sector.vertices().size(); ++v)
      distances[v] -= sector.vertices()[v][of * first + m];
    sector.clip(distances, 2 * first, round_off);
  }
  return sector;
}

template <int dim>
Coordinates<dim> integrate_coordinates(const ConvexPolytope<dim> &part, unsigned int of)
{
  Coordinates<dim> integral = Coordinates<dim>::Zero();
  if (part.is_empty())
    return integral;
  const Coordinates<dim> &apex = part.vertices()[part.faces()[0].vertices[0]];
  for (const auto &face : part.faces())
    part.for_each_part(face,
                       [&](const auto &base)
                       {
                         Coordinates<dim> sum = apex;
                         for (const auto *corner : base)
                           sum += *corner;
                         integral += relative_volume<dim>(apex, base, of) / (dim + 1) * sum;
                       });
  // Faces run anticlockwise in the coordinates of the first simplex, and of the second unless one is
  // mirrored.
  const bool is_mirrored = integral.template segment<dim + 1>(of * (dim + 1)).sum() < 0.;
  return is_mirrored ? -integral : integral;
}

template <int dim>
FaceMoments<dim> integrate_products(const ConvexPolytope<dim> &part,
                                    const typename ConvexPolytope<dim>::Face &face)
{
  FaceMoments<dim> moments = FaceMoments<dim>::Zero();
  part.for_each_part(face,
                     [&](const auto &corners)
                     {
                       const double weight = relative_area<dim>(corners, face.label) / (dim * (dim + 1));
                       Coordinates<dim> sum = Coordinates<dim>::Zero();
                       for (const auto *corner : corners)
                       {
                         moments.noalias() += weight * *corner * corner->transpose();
                         sum += *corner;
                       }
                       moments.noalias() += weight * sum * sum.transpose();
                     });
  return moments;
}

template <int dim>
Coordinates<dim> integrate_products_with(const ConvexPolytope<dim> &part,
                                         const typename ConvexPolytope<dim>::Face &face, unsigned int m)
{
  Coordinates<dim> moments = Coordinates<dim>::Zero();
  part.for_each_part(face,
                     [&](const auto &corners)
                     {
                       const double weight = relative_area<dim>(corners, face.label) / (dim * (dim + 1));
                       Coordinates<dim> sum = Coordinates<dim>::Zero();
                       for (const auto *corner : corners)
                       {
                         moments += weight * (*corner)[m] * *corner;
                         sum += *corner;
                       }
                       moments += weight * sum[m] * sum;
                     });
  return moments;
}

template struct SimplexShape<2>;
template SimplexShape<2> make_simplex_shape<2>(const std::array<SpatialVector<2>, 3> &);
template ConvexPolytope<2> make_overlap(const SimplexShape<2> &, const SimplexShape<2> &, double);
template ConvexPolytope<2> restrict_to_sector(const ConvexPolytope<2> &, unsigned int, unsigned int);
template Coordinates<2> integrate_coordinates(const ConvexPolytope<2> &, unsigned int);
template FaceMoments<2> integrate_products(const ConvexPolytope<2> &, const ConvexPolytope<2>::Face &);
template Coordinates<2> integrate_products_with(const ConvexPolytope<2> &, const ConvexPolytope<2>::Face &,
                                                unsigned int);
template struct SimplexShape<3>;
template SimplexShape<3> make_simplex_shape<3>(const std::array<SpatialVector<3>, 4> &);
template ConvexPolytope<3> make_overlap(const SimplexShape<3> &, const SimplexShape<3> &, double);
template ConvexPolytope<3> restrict_to_sector(const ConvexPolytope<3> &, unsigned int, unsigned int);
template Coordinates<3> integrate_coordinates(const ConvexPolytope<3> &, unsigned int);
template FaceMoments<3> integrate_products(const ConvexPolytope<3> &, const ConvexPolytope<3>::Face &);
template Coordinates<3> integrate_products_with(const ConvexPolytope<3> &, const ConvexPolytope<3>::Face &,
                                                unsigned int);
} // namespace signorini::contact
