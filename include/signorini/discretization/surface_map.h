// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/discretization/contact_surface.h"
#include "signorini/discretization/node_map.h"
#include "signorini/discretization/supports.h"

namespace signorini
{
/// Joins the contact surface to the degrees of freedom. Every rank holds the whole surface.
template <int dim>
class SurfaceMap : public NodeMap<dim>
{
public:
  /// Collects the outer faces of all bodies.
  SurfaceMap(const Scene<dim> &scene, const Discretization<dim> &discretization);

  const ContactSurface<dim> &surface() const { return contact_surface; }

  /// Positions of the surface's nodes, from the surface's origin [m] (collective).
  std::vector<SpatialVector<dim>> positions(const Vector &displacement) const;

private:
  /// Takes the facets of all ranks; returns which are of simplices.
  std::vector<bool> number_nodes(const std::vector<std::vector<double>> &packed_facets,
                                 unsigned int this_rank);

  ContactSurface<dim> contact_surface;
};
} // namespace signorini
