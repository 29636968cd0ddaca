// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/discretization/node_map.h"
#include "signorini/discretization/outer_facet.h"
#include "signorini/discretization/supports.h"

#include <map>

namespace signorini
{
/// Joins the contact surface to the degrees of freedom. A rank holds the outer faces of its own cells, which
/// stay, and those of other ranks that it was given last; whoever asks for these works on a copy.
template <int dim>
class SurfaceMap : public NodeMap<dim>
{
public:
  /// Collects the outer faces of this rank's cells (collective).
  SurfaceMap(const Scene<dim> &scene, const Discretization<dim> &discretization);

  const ContactSurface<dim> &surface() const { return contact_surface; }

  unsigned int n_own_facets() const { return n_facets; }
  unsigned int n_own_nodes() const { return n_nodes_of_own; }

  /// Those of all ranks.
  unsigned int n_all_facets() const { return n_facets_of_all; }

  /// Gives every other rank some of the own facets, `given` [rank], rising, and holds what it is given
  /// itself, in the place of what it held of other ranks (collective). Own facets and nodes keep their
  /// numbers.
  void exchange(const std::map<unsigned int, std::vector<unsigned int>> &given);

  /// Positions of the surface's nodes, from the surface's origin [m] (collective).
  std::vector<SpatialVector<dim>> positions(const Vector &displacement) const;

  /// Values at all nodes that are held of those at each rank's own nodes, which come first in `nodal`, the
  /// same wherever a node is an own one (collective).
  std::vector<SpatialVector<dim>> extend(std::vector<SpatialVector<dim>> nodal) const
  {
    this->spread_known(n_nodes_of_own, nodal);
    return nodal;
  }

private:
  void number_facets(std::vector<OuterFacet<dim>> &own);
  void find_extremes();
  /// Appends facets, and those of their nodes that are new.
  void append(const std::vector<OuterFacet<dim>> &facets,
              std::vector<typename NodeMap<dim>::NodeDofs> &dofs_of_nodes);
  void pack(unsigned int facet, std::vector<double> &packed) const;

  ContactSurface<dim> contact_surface;
  unsigned int n_facets = 0, n_nodes_of_own = 0, n_facets_of_all = 0;
};
} // namespace signorini
