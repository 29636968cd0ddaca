// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/base/spatial_vector.h"

#include <vector>

namespace signorini::contact
{
/// Where all obstacles are at one time.
template <int dim>
struct ObstaclePlaces
{
  double time = 0.;                           ///< [s]
  std::vector<SpatialVector<dim>> shifts;     ///< from the places they were given at [m]
  std::vector<SpatialVector<dim>> velocities; ///< [m/s]

  template <typename Archive>
  void serialize(Archive &archive, unsigned int /*version*/)
  {
    archive &time &shifts &velocities;
  }
};

/// Resultants on all bodies together, one an obstacle [N; N/m in 2-D].
template <int dim>
struct ObstacleForces
{
  std::vector<SpatialVector<dim>> conservative; ///< where bodies rub, with the friction
  std::vector<SpatialVector<dim>> damping;

  template <typename Archive>
  void serialize(Archive &archive, unsigned int /*version*/)
  {
    archive &conservative &damping;
  }
};
} // namespace signorini::contact
