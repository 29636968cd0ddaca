// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/discretization/surface_map.h"

#include <vector>

namespace signorini
{
/// A boundary face of an own cell, undeformed.
template <int dim>
struct BoundaryFace
{
  unsigned int cell = 0;
  unsigned int body = 0;
  unsigned int boundary_id = 0;            ///< see global_boundary_id()
  std::vector<unsigned int> nodes;         ///< of the cell
  std::vector<SpatialVector<dim>> normals; ///< outward, one a node
  std::vector<dealii::Point<dim>> positions;
  unsigned int facet = 0;                ///< scenes with contact: that of the contact surface
  std::vector<unsigned int> facet_nodes; ///< the facet's nodes, one a node
};

/// All boundary faces of this rank's cells, in the order of the cells; `map` is null in scenes without
/// contact.
template <int dim>
std::vector<BoundaryFace<dim>> collect_boundary_faces(const Discretization<dim> &discretization,
                                                      const SurfaceMap<dim> *map);
} // namespace signorini
