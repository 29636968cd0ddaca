// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/discretization/contact_volume.h"
#include "signorini/discretization/node_map.h"
#include "signorini/scene/scene.h"

namespace signorini
{
/// Joins the simplices of all bodies, for the volume potential, to the degrees of freedom. Every rank holds
/// all of them. For elements of degree 1.
template <int dim>
class VolumeMap : public NodeMap<dim>
{
public:
  /// Takes tetrahedra as they are and splits hexahedra (collective).
  VolumeMap(const Scene<dim> &scene, const Discretization<dim> &discretization);

  const ContactVolume<dim> &volume() const { return contact_volume; }

  /// The cell that a simplex is or is a part of, an own cell of the rank that owns the simplex.
  unsigned int cell_of(unsigned int simplex) const { return cells_of_simplices[simplex]; }

  /// Positions of the volume's nodes, from its origin [m] (collective).
  std::vector<SpatialVector<dim>> positions(const Vector &displacement) const;

private:
  ContactVolume<dim> contact_volume;
  std::vector<unsigned int> cells_of_simplices;
};
} // namespace signorini
