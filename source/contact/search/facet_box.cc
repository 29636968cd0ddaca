// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/search/facet_box.h"

namespace signorini::contact
{
namespace
{
/// The middle one of the control points of the parabola through three points.
template <typename Point>
Point middle_control_point(const Point &first, const Point &middle, const Point &last)
{
  return 2. * middle - .5 * (first + last);
}
} // namespace

template <int dim>
BoundingBox<dim> make_facet_box(const Facet<dim> &facet, const std::vector<SpatialVector<dim>> &positions)
{
  std::array<SpatialVector<dim>, Facet<dim>::max_n_nodes> point;
  for (unsigned int a = 0; a < facet.n_nodes(); ++a)
    point[a] = positions[facet.nodes[a]];

  if (facet.degree == 2)
  {
    for (unsigned int row = 0; row + 2 < facet.n_nodes(); row += 3)
      point[row + 1] = middle_control_point<SpatialVector<dim>>(point[row], point[row + 1], point[row + 2]);
    if constexpr (dim == 3)
      for (unsigned int column = 0; column < 3; ++column)
        point[3 + column] =
            middle_control_point<SpatialVector<dim>>(point[column], point[3 + column], point[6 + column]);
  }

  BoundingBox<dim> box;
  for (unsigned int a = 0; a < facet.n_nodes(); ++a)
    box.extend(point[a]);
  return box;
}

template BoundingBox<2> make_facet_box(const Facet<2> &, const std::vector<SpatialVector<2>> &);
template BoundingBox<3> make_facet_box(const Facet<3> &, const std::vector<SpatialVector<3>> &);
} // namespace signorini::contact
