// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/potential/unseen_contact.h"

#include <algorithm>

namespace signorini::contact
{
template <int dim>
std::vector<unsigned int> find_unseen_contact(const ContactSurface<dim> &surface, const PairList<dim> &pairs,
                                              const std::vector<SpatialVector<dim>> &positions,
                                              const std::vector<double> &known_depth)
{
  std::vector<bool> is_unseen(surface.facets.size(), false);
  for (unsigned int i = 0; i < pairs.obstacles().size(); ++i)
  {
    std::vector<typename Obstacle<dim>::Foot> feet;
    pairs.obstacles()[i]->find_feet(positions, feet);
    for (unsigned int f = 0; f < surface.facets.size(); ++f)
    {
      const Facet<dim> &facet = surface.facets[f];
      if (facet.owned && !pairs.is_excluded_obstacle(facet.body, i))
        is_unseen[f] = is_unseen[f] ||
                       std::any_of(facet.nodes.begin(), facet.nodes.begin() + facet.n_nodes(),
                                   [&](unsigned int node) { return feet[node].depth > known_depth[node]; });
    }
  }
  for (const FacetNeighbours &near : pairs.neighbours())
  {
    const Facet<dim> &facet = surface.facets[near.facet];
    if (!facet.owned || is_unseen[near.facet])
      continue;
    const FootSearch<dim> feet(surface.facets, positions, near.candidates);
    is_unseen[near.facet] =
        std::any_of(facet.nodes.begin(), facet.nodes.begin() + facet.n_nodes(),
                    [&](unsigned int node) {
                      return feet.find(positions[node], pairs.reach(near.facet)).depth > known_depth[node];
                    });
  }
  std::vector<unsigned int> unseen;
  for (unsigned int f = 0; f < is_unseen.size(); ++f)
    if (is_unseen[f])
      unseen.push_back(f);
  return unseen;
}

template std::vector<unsigned int> find_unseen_contact(const ContactSurface<2> &, const PairList<2> &,
                                                       const std::vector<SpatialVector<2>> &,
                                                       const std::vector<double> &);
template std::vector<unsigned int> find_unseen_contact(const ContactSurface<3> &, const PairList<3> &,
                                                       const std::vector<SpatialVector<3>> &,
                                                       const std::vector<double> &);
} // namespace signorini::contact
