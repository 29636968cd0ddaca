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

/// Turns the nodes of a facet of degree 2 into its control points.
template <int dim>
void find_control_points(const FacetElement<dim> &element,
                         std::array<SpatialVector<dim>, FacetElement<dim>::max_n_nodes> &point)
{
  using Point = SpatialVector<dim>;
  if constexpr (dim == 3)
    if (element.type == FacetType::triangle)
    {
      for (unsigned int i = 0; i < 3; ++i)
        point[3 + i] = middle_control_point<Point>(point[i], point[3 + i], point[(i + 1) % 3]);
      return;
    }
  for (unsigned int row = 0; row + 2 < element.n_nodes(); row += 3)
    point[row + 1] = middle_control_point<Point>(point[row], point[row + 1], point[row + 2]);
  if constexpr (dim == 3)
    for (unsigned int column = 0; column < 3; ++column)
      point[3 + column] = middle_control_point<Point>(point[column], point[3 + column], point[6 + column]);
}
} // namespace

template <int dim>
BoundingBox<dim> make_facet_box(const Facet<dim> &facet, const std::vector<SpatialVector<dim>> &positions)
{
  std::array<SpatialVector<dim>, FacetElement<dim>::max_n_nodes> point;
  for (unsigned int a = 0; a < facet.n_nodes(); ++a)
    point[a] = positions[facet.nodes[a]];
  if (facet.degree == 2)
    find_control_points(facet, point);

  BoundingBox<dim> box;
  for (unsigned int a = 0; a < facet.n_nodes(); ++a)
    box.extend(point[a]);
  return box;
}

template BoundingBox<2> make_facet_box(const Facet<2> &, const std::vector<SpatialVector<2>> &);
template BoundingBox<3> make_facet_box(const Facet<3> &, const std::vector<SpatialVector<3>> &);
} // namespace signorini::contact
