// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/geometry/closest_point.h"

#include <optional>
#include <vector>

namespace signorini::contact
{
/// Where a point stands with respect to a body's surface.
template <int dim>
struct SurfaceFoot
{
  unsigned int facet = 0; ///< index into the surface's facets of the closest facet
  ClosestPoint<dim> closest;
  double depth = 0.; ///< signed: positive below the surface (inside the body), negative outside [m]
};

/// A point of the surface.
template <int dim>
struct SurfacePlace
{
  unsigned int facet = 0; ///< index into the surface's facets
  LocalPoint<dim> xi;
};

template <int dim>
struct Fan;
template <int dim>
class Facing;

/// Finds feet on the surface that some facets of one body form, and the signs of their depths.
///
/// The sign comes from the normal of the surface at the foot. Where the foot lies on an edge or a corner
/// shared by several facets, that normal is the sum of the facets' unit normals weighted with the angle each
/// of them spans there (J. A. Bærentzen, H. Aanæs, Signed distance computation using the angle weighted
/// pseudonormal, 2005): a facet whose closest point lies at the same place (to round-off of the facet's size)
/// counts with its corner angle at a corner, π on an edge, 2π inside; this needs no adjacency and so holds at
/// hanging nodes too.
///
/// Of facets that are equally close, to 1e-12 of their size, the one whose normal points most against that of
/// the surface at `contactor`, the place of `x`, is taken: a point on the middle axis of a spike belongs to
/// the flank it faces. Without a contactor, or if they face it equally, the first candidate. A point inside a
/// spike whose closest facet looks the way the contactor does (normals within 60°) belongs to one that faces
/// it (likewise) and is farther by no more than 1e-4 of its size: what comes down just beyond the middle axis
/// has not come through the flank behind it. All candidates that hold the foot take part in the sign, so the
/// list must hold every facet within the foot's distance of `x`.
///
/// Where the facets at the foot do not close around it (the rim of an open surface), only a point within 45°
/// of being right below counts as inside; beside the rim there is no inside.
template <int dim>
class FootSearch
{
public:
  /// `candidates` are indices into the surface's facets. All arguments must outlive this object and stay.
  FootSearch(const std::vector<Facet<dim>> &facets, const std::vector<SpatialVector<dim>> &positions,
             const std::vector<unsigned int> &candidates);

  /// The foot of `x`. Facets farther than `cutoff` [m] are left out; if all are, returns a foot with depth
  /// −∞.
  SurfaceFoot<dim> find(const SpatialVector<dim> &x, double cutoff,
                        const SurfacePlace<dim> *contactor = nullptr) const;

private:
  struct Box
  {
    SpatialVector<dim> middle, half_width;

    double squared_distance(const SpatialVector<dim> &x) const
    {
      return ((x - middle).cwiseAbs() - half_width).cwiseMax(0.).squaredNorm();
    }
  };
  struct Nearest
  {
    unsigned int candidate;
    ClosestPoint<dim> closest;
  };

  static Box make_box(const FacetNodes<dim> &nodes);
  FacetNodes<dim> nodes_of(unsigned int candidate) const
  {
    return gather_nodes(facets[candidates[candidate]], positions);
  }

  /// The candidate whose box is nearest to `x`, with the closest point on it; none if it is beyond the
  /// cutoff.
  std::optional<Nearest> find_nearest_box(const SpatialVector<dim> &x, double cutoff) const;

  /// The closest facet, its foot's depth not yet signed.
  SurfaceFoot<dim> find_closest_facet(const SpatialVector<dim> &x, double cutoff, Facing<dim> facing) const;

  /// For a point below the surface whose foot lies on the back of a spike, on the flank that looks the way
  /// the point's own surface does: its foot on the other flank, if that is hardly farther.
  SurfaceFoot<dim> turn_to_front(const SurfaceFoot<dim> &foot, const SpatialVector<dim> &x,
                                 Facing<dim> facing) const;

  /// All candidates that hold the place `foot`, together.
  Fan<dim> gather_fan(const SpatialVector<dim> &foot) const;

  const std::vector<Facet<dim>> &facets;
  const std::vector<SpatialVector<dim>> &positions;
  const std::vector<unsigned int> &candidates;
  std::vector<Box> boxes; ///< one a candidate
};
} // namespace signorini::contact
