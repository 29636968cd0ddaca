// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/search/interior_search.h"

#include "signorini/contact/geometry/depth.h"
#include "signorini/contact/search/box_tree.h"

#include <limits>

namespace signorini::contact
{
template <int dim>
struct InteriorSearch<dim>::Trees
{
  std::vector<BoundingBox<dim>> facets;
  BoxTree<dim> body_tree;
  std::vector<BoxTree<dim>> facet_trees; ///< one a body

  Trees(const ContactSurface<dim> &surface, const Positions &positions)
  {
    std::vector<BoundingBox<dim>> bodies(surface.n_bodies);
    std::vector<std::vector<unsigned int>> facets_of_body(surface.n_bodies);
    for (unsigned int f = 0; f < surface.facets.size(); ++f)
    {
      facets.push_back(make_facet_box(surface.facets[f], positions));
      bodies[surface.facets[f].body].extend(facets.back());
      facets_of_body[surface.facets[f].body].push_back(f);
    }
    std::vector<unsigned int> all_bodies;
    for (unsigned int body = 0; body < surface.n_bodies; ++body)
    {
      all_bodies.push_back(body);
      facet_trees.push_back(make_tree<dim>(facets, facets_of_body[body]));
    }
    body_tree = make_tree<dim>(bodies, all_bodies);
  }
};

template <int dim>
InteriorSearch<dim>::InteriorSearch(const ContactSurface<dim> &contact_surface,
                                    const Positions &node_positions)
    : surface(contact_surface), positions(node_positions),
      trees(std::make_unique<const Trees>(contact_surface, node_positions))
{
}

template <int dim>
InteriorSearch<dim>::~InteriorSearch() = default;

template <int dim>
std::optional<InteriorPoint<dim>>
InteriorSearch<dim>::find_deepest(const SpatialVector<dim> &x,
                                  const std::function<bool(unsigned int)> &is_considered) const
{
  std::optional<InteriorPoint<dim>> deepest;
  std::vector<TreeEntry<dim>> holding;
  trees->body_tree.query(boost::geometry::index::intersects(make_tree_point<dim>(x)),
                         std::back_inserter(holding));
  for (const TreeEntry<dim> &entry : holding)
    if (is_considered(entry.second))
      if (const auto found = find_in_body(x, entry.second);
          found && (!deepest || found->depth > deepest->depth))
        deepest = found;
  return deepest;
}

template <int dim>
std::optional<InteriorPoint<dim>> InteriorSearch<dim>::find_in_body(const SpatialVector<dim> &x,
                                                                    unsigned int body) const
{
  // The facets of the nearest boxes bound the distance of the foot. The margin keeps all facets that share
  // it, which the sign of the depth needs.
  constexpr unsigned int n_first = 8;
  const BoxTree<dim> &tree = trees->facet_trees[body];
  std::vector<TreeEntry<dim>> entries;
  tree.query(boost::geometry::index::nearest(make_tree_point<dim>(x), n_first), std::back_inserter(entries));
  double bound = std::numeric_limits<double>::infinity(), margin = 0.;
  for (const TreeEntry<dim> &entry : entries)
  {
    bound = std::min(bound,
                     find_closest_point(gather_nodes(surface.facets[entry.second], positions), x).distance);
    margin = std::max(margin, 1e-6 * trees->facets[entry.second].diagonal().norm());
  }
  const double reach = bound + margin;
  entries.clear();
  tree.query(boost::geometry::index::intersects(make_tree_box<dim>(BoundingBox<dim>(x), reach)),
             std::back_inserter(entries));
  std::vector<unsigned int> candidates;
  for (const TreeEntry<dim> &entry : entries)
    if (trees->facets[entry.second].exteriorDistance(x) <= reach)
      candidates.push_back(entry.second);
  const SurfaceFoot<dim> foot =
      FootSearch<dim>(surface.facets, positions, candidates).find(x, std::numeric_limits<double>::infinity());
  if (!(foot.depth > 0.))
    return {};
  return InteriorPoint<dim>{body, foot.facet, foot.depth, foot.closest.position};
}

template struct InteriorPoint<2>;
template struct InteriorPoint<3>;
template class InteriorSearch<2>;
template class InteriorSearch<3>;
} // namespace signorini::contact
