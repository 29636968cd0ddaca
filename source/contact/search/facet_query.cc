// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/search/facet_query.h"

#include "signorini/contact/search/box_tree.h"

#include <boost/iterator/function_output_iterator.hpp>

#include <numeric>

namespace signorini::contact
{
template <int dim>
std::vector<unsigned int> find_facets(const ContactSurface<dim> &surface,
                                      const std::vector<BoundingBox<dim>> &boxes,
                                      const std::vector<FacetQuery<dim>> &queries,
                                      const std::function<bool(unsigned int, unsigned int)> &is_allowed_pair)
{
  std::vector<unsigned int> all(boxes.size());
  std::iota(all.begin(), all.end(), 0);
  const BoxTree<dim> tree = make_tree<dim>(boxes, all);
  std::vector<bool> is_wanted(boxes.size(), false);
  for (const FacetQuery<dim> &query : queries)
    tree.query(boost::geometry::index::intersects(make_tree_box<dim>(query.box, 0.)),
               boost::make_function_output_iterator(
                   [&](const TreeEntry<dim> &entry)
                   {
                     const unsigned int facet = entry.second;
                     if (!is_wanted[facet] && is_allowed_pair(query.body, surface.facets[facet].body))
                       is_wanted[facet] = true;
                   }));
  std::vector<unsigned int> wanted;
  for (unsigned int facet = 0; facet < is_wanted.size(); ++facet)
    if (is_wanted[facet])
      wanted.push_back(facet);
  return wanted;
}

template struct FacetQuery<2>;
template struct FacetQuery<3>;
template std::vector<unsigned int> find_facets(const ContactSurface<2> &, const std::vector<BoundingBox<2>> &,
                                               const std::vector<FacetQuery<2>> &,
                                               const std::function<bool(unsigned int, unsigned int)> &);
template std::vector<unsigned int> find_facets(const ContactSurface<3> &, const std::vector<BoundingBox<3>> &,
                                               const std::vector<FacetQuery<3>> &,
                                               const std::function<bool(unsigned int, unsigned int)> &);
} // namespace signorini::contact
