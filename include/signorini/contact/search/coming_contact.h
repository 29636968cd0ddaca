// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/search/facet_box.h"
#include "signorini/scene/obstacle.h"

#include <functional>
#include <vector>

namespace signorini::contact
{
/// Surface nodes that go on as they move now.
template <int dim>
struct StraightMotion
{
  std::vector<SpatialVector<dim>> positions;  ///< one a node, from the surface's origin [m]
  std::vector<SpatialVector<dim>> velocities; ///< one a node [m/s]
  double duration = 0.;                       ///< how long [s]

  /// Mean over the nodes of a facet [m/s].
  SpatialVector<dim> mean_velocity(const Facet<dim> &facet) const;

  /// Bounds how fast any point of a facet moves, as seen by an observer [m/s].
  double largest_speed(const Facet<dim> &facet, const SpatialVector<dim> &of_observer) const;

  /// Holds a facet throughout, as seen by an observer.
  BoundingBox<dim> swept_box(const Facet<dim> &facet, const SpatialVector<dim> &of_observer) const;
};

/// Owned facets that may touch one of another body within the duration, in rising order: those of which a
/// point out of a lattice of 3 (2-D) or 3 × 3 is nearer to a facet than `margins` of its own facet [m] and
/// the way that the two facets can make towards each other. Bodies may move fast together: only relative
/// motion counts; boxes are compared as seen by one who moves with the target body, at `body_velocities`, the
/// means over all facets. `margins` are those of owned facets; others must be held if their swept boxes come
/// within these of owned ones. If `is_allowed_pair` of a body and itself, its own facets count too, without
/// those that are untouchable by four margins and those that have a node in common.
template <int dim>
std::vector<unsigned int>
find_coming_contact(const ContactSurface<dim> &surface, const StraightMotion<dim> &motion,
                    const std::vector<double> &margins,
                    const std::vector<SpatialVector<dim>> &body_velocities,
                    const std::function<bool(unsigned int body, unsigned int other_body)> &is_allowed_pair);

/// The same with an obstacle, which has been moved to where it is from the surface's origin; velocities are
/// those seen from it.
template <int dim>
std::vector<unsigned int>
find_coming_contact(const ContactSurface<dim> &surface, const StraightMotion<dim> &motion,
                    const std::vector<double> &margins, const Obstacle<dim> &obstacle,
                    const std::function<bool(unsigned int body)> &is_allowed_body);
} // namespace signorini::contact
