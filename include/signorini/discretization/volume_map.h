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

  /// Elements of all ranks, which Simplex::cell counts; those of this rank are in a row.
  unsigned int n_cells() const { return n_all_cells; }
  unsigned int first_own_cell() const { return begin_of_own_cells; }
  unsigned int n_own_cells() const { return this->discretization->cells.n_cells; }

  /// Positions of the volume's nodes, from its origin [m] (collective).
  std::vector<SpatialVector<dim>> positions(const Vector &displacement) const;

private:
  ContactVolume<dim> contact_volume;
  unsigned int n_all_cells = 0, begin_of_own_cells = 0;
};
} // namespace signorini
