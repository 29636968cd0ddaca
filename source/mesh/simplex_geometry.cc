// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/mesh/simplex_geometry.h"

#include "signorini/mesh/file_mesh.h"

#include <algorithm>
#include <cmath>

namespace signorini
{
namespace
{
Triple difference(const Triple &a, const Triple &b)
{
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Triple cross_product(const Triple &a, const Triple &b)
{
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double scalar_product(const Triple &a, const Triple &b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double length(const Triple &a)
{
  return std::sqrt(scalar_product(a, a));
}

/// Of the columns; in 2-D of the first two.
double determinant_of_columns(const std::array<Triple, 3> &columns, const unsigned int dimension)
{
  const Triple normal = cross_product(columns[0], columns[1]);
  return dimension == 3 ? scalar_product(normal, columns[2]) : normal[2];
}

/// Jacobian determinant of the quadratic map at barycentric coordinates.
double jacobian(const QuadraticCell &cell, const std::array<double, 4> &at, const unsigned int dimension)
{
  std::array<Triple, 4> derivatives{}; // by each barycentric coordinate
  const unsigned int n_edges = dimension == 3 ? 6 : 3;
  for (unsigned int c = 0; c < 3; ++c)
  {
    for (unsigned int v = 0; v <= dimension; ++v)
      derivatives[v][c] = (4. * at[v] - 1.) * cell[v][c];
    for (unsigned int e = 0; e < n_edges; ++e)
    {
      const auto [a, b] = edges_of_cell[e];
      derivatives[a][c] += 4. * at[b] * cell[dimension + 1 + e][c];
      derivatives[b][c] += 4. * at[a] * cell[dimension + 1 + e][c];
    }
  }
  std::array<Triple, 3> columns{};
  for (unsigned int d = 0; d < dimension; ++d)
    columns[d] = difference(derivatives[d + 1], derivatives[0]);
  return determinant_of_columns(columns, dimension);
}
} // namespace

double distance(const Triple &a, const Triple &b)
{
  return length(difference(a, b));
}

Triple midpoint(const Triple &a, const Triple &b)
{
  return {(a[0] + b[0]) / 2., (a[1] + b[1]) / 2., (a[2] + b[2]) / 2.};
}

double determinant(const std::array<Triple, 4> &corners, const unsigned int dimension)
{
  std::array<Triple, 3> columns{};
  for (unsigned int d = 0; d < dimension; ++d)
    columns[d] = difference(corners[d + 1], corners[0]);
  return determinant_of_columns(columns, dimension);
}

double least_relative_jacobian(const QuadraticCell &cell, const unsigned int dimension)
{
  const double straight = determinant({cell[0], cell[1], cell[2], cell[3]}, dimension);
  double least = 1.;
  for (unsigned int v = 0; v <= dimension; ++v)
  {
    std::array<double, 4> at{};
    at[v] = 1.;
    least = std::min(least, jacobian(cell, at, dimension) / straight);
  }
  for (unsigned int e = 0; e < (dimension == 3 ? 6 : 3); ++e)
  {
    std::array<double, 4> at{};
    at[edges_of_cell[e][0]] = at[edges_of_cell[e][1]] = 0.5;
    least = std::min(least, jacobian(cell, at, dimension) / straight);
  }
  return least;
}

double radius_ratio(const std::array<Triple, 4> &corners, const unsigned int dimension)
{
  if (dimension == 2)
  {
    const double a = distance(corners[1], corners[2]), b = distance(corners[2], corners[0]),
                 c = distance(corners[0], corners[1]);
    return (b + c - a) * (c + a - b) * (a + b - c) / (a * b * c);
  }
  const Triple a = difference(corners[1], corners[0]), b = difference(corners[2], corners[0]),
               c = difference(corners[3], corners[0]);
  const Triple ab = cross_product(a, b), bc = cross_product(b, c), ca = cross_product(c, a);
  const Triple opposite = cross_product(difference(b, a), difference(c, a));
  const double areas = (length(ab) + length(bc) + length(ca) + length(opposite)) / 2.;
  const double six_volumes = scalar_product(ab, c);
  Triple towards_centre{};
  for (unsigned int d = 0; d < 3; ++d)
    towards_centre[d] =
        scalar_product(a, a) * bc[d] + scalar_product(b, b) * ca[d] + scalar_product(c, c) * ab[d];
  const double in_radius = six_volumes / (2. * areas),
               circumradius = length(towards_centre) / (2. * std::abs(six_volumes));
  return 3. * in_radius / circumradius;
}
} // namespace signorini
