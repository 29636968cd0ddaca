// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/search/facet_box.h"

#include <boost/geometry/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <utility>
#include <vector>

// Trees over bounding boxes; only for the sources of contact/search, as boost's headers are long.
namespace signorini::contact
{
template <int dim>
using TreePoint = boost::geometry::model::point<double, dim, boost::geometry::cs::cartesian>;
template <int dim>
using TreeBox = boost::geometry::model::box<TreePoint<dim>>;
template <int dim>
using TreeEntry = std::pair<TreeBox<dim>, unsigned int>;
template <int dim>
using BoxTree = boost::geometry::index::rtree<TreeEntry<dim>, boost::geometry::index::linear<16>>;

template <int dim>
TreePoint<dim> make_tree_point(const SpatialVector<dim> &x)
{
  if constexpr (dim == 2)
    return {x[0], x[1]};
  else
    return {x[0], x[1], x[2]};
}

template <int dim>
TreeBox<dim> make_tree_box(const BoundingBox<dim> &box, double margin)
{
  const SpatialVector<dim> margins = SpatialVector<dim>::Constant(margin);
  return {make_tree_point<dim>(box.min() - margins), make_tree_point<dim>(box.max() + margins)};
}

/// A tree over the boxes with the given indices. Handing over all entries at once packs the tree.
template <int dim>
BoxTree<dim> make_tree(const std::vector<BoundingBox<dim>> &boxes, const std::vector<unsigned int> &indices)
{
  std::vector<TreeEntry<dim>> entries;
  entries.reserve(indices.size());
  for (const unsigned int i : indices)
    if (!boxes[i].isEmpty())
      entries.emplace_back(make_tree_box<dim>(boxes[i], 0.), i);
  return BoxTree<dim>(entries);
}
} // namespace signorini::contact
