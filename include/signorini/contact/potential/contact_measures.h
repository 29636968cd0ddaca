// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/base/spatial_vector.h"

#include <map>
#include <utility>
#include <vector>

namespace signorini::contact
{
/// What the contact of this rank's owned facets amounts to at the last evaluation.
template <int dim>
struct ContactMeasures
{
  double max_penetration = 0.;                ///< [m]
  double max_penetration_over_thickness = 0.; ///< over the h of the point's own facet, or the target's room
                                              ///< if less; of volumes, that of the target
  double max_pressure = 0.;                   ///< k_A d, per undeformed area [Pa]
  double max_stiffness = 0.;                  ///< k_A over all pairs [Pa/m]
  double area = 0.;                           ///< undeformed area under positive pressure [m²; m in 2-D]
  unsigned int n_pairs = 0;                   ///< point–target pairs in the list
  unsigned int n_active = 0;                  ///< of these, those with positive depth
  unsigned int deepest_body = 0;              ///< whose point reaches max_penetration_over_thickness
  double deepest_thickness = 0.;              ///< that h [m]
  SpatialVector<dim> deepest_position = SpatialVector<dim>::Zero();
  std::vector<SpatialVector<dim>>
      resultants; ///< contact force on every body [N; N/m in 2-D], without damping
};

/// Contact forces between different ones that touch, with damping where velocities were given [N; N/m in
/// 2-D].
template <int dim>
struct PairForces
{
  using Table = std::map<std::pair<unsigned int, unsigned int>, SpatialVector<dim>>;
  Table bodies;    ///< {one, other} with one < other: the force on `one`
  Table obstacles; ///< {body, obstacle}: the force on the body

  void add(const PairForces &other)
  {
    for (const auto table : {&PairForces::bodies, &PairForces::obstacles})
      for (const auto &[pair, force] : other.*table)
        (this->*table).try_emplace(pair, SpatialVector<dim>::Zero()).first->second += force;
  }
};

/// One sampled point with contact or near it, for reports.
template <int dim>
struct ContactSample
{
  unsigned int facet = 0;
  LocalPoint<dim> xi = LocalPoint<dim>::Zero();
  SpatialVector<dim> position = SpatialVector<dim>::Zero();
  double depth = 0.;    ///< negative: a gap [m]
  double pressure = 0.; ///< k_A d where positive, per undeformed area [Pa]

  /// Undeformed area with which the point counts [m²; m in 2-D]: half of what it stands for where the other
  /// side deforms and is sampled too, so that pressure times area sums up to the resultant over both sides.
  double area = 0.;
  double full_area = 0.; ///< undeformed area that it stands for [m²; m in 2-D]
};
} // namespace signorini::contact
