// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/search/nearest_points.h"

#include "signorini/contact/search/box_tree.h"

#include <numeric>

namespace signorini::contact
{
template <int dim>
std::vector<unsigned int> find_nearest_points(const std::vector<SpatialVector<dim>> &points,
                                              const std::vector<SpatialVector<dim>> &queries)
{
  std::vector<BoundingBox<dim>> boxes;
  for (const SpatialVector<dim> &point : points)
    boxes.emplace_back(point);
  std::vector<unsigned int> indices(points.size());
  std::iota(indices.begin(), indices.end(), 0u);
  const BoxTree<dim> tree = make_tree<dim>(boxes, indices);
  std::vector<unsigned int> nearest;
  for (const SpatialVector<dim> &query : queries)
    nearest.push_back(tree.qbegin(boost::geometry::index::nearest(make_tree_point<dim>(query), 1))->second);
  return nearest;
}

template std::vector<unsigned int> find_nearest_points<2>(const std::vector<SpatialVector<2>> &,
                                                          const std::vector<SpatialVector<2>> &);
template std::vector<unsigned int> find_nearest_points<3>(const std::vector<SpatialVector<3>> &,
                                                          const std::vector<SpatialVector<3>> &);
} // namespace signorini::contact
