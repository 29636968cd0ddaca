// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/base/spatial_vector.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace signorini
{
/// What a facet is in its local coordinates.
enum class FacetType : unsigned char
{
  tensor_product, ///< over [0, 1]^(dim−1): a line in 2-D, a quadrilateral in 3-D
  triangle        ///< over ξ_0, ξ_1 ≥ 0, ξ_0 + ξ_1 ≤ 1; 3-D only
};

/// A Lagrange element of degree 1 or 2.
///
/// Node (i, j) of a tensor product, at the local point (i/degree, j/degree), has index i + (degree + 1) j. A
/// triangle has its corners (0, 0), (1, 0), (0, 1) first, then the middles of the sides 0–1, 1–2, 2–0.
template <int dim>
struct FacetElement
{
  static constexpr unsigned int max_n_nodes = (dim == 2 ? 3 : 9);

  unsigned int degree = 1; ///< polynomial degree, 1 or 2
  FacetType type = FacetType::tensor_product;

  unsigned int n_nodes() const
  {
    const unsigned int n_line = degree + 1;
    if (dim == 2)
      return n_line;
    return type == FacetType::triangle ? n_line * (n_line + 1) / 2 : n_line * n_line;
  }
};

/// One element face that may touch something.
///
/// The nodes run so that the normal t_0 × t_1 (in 2-D: t_0 turned by −90°, (t_y, −t_x)) points out of the
/// body.
template <int dim>
struct Facet : FacetElement<dim>
{
  bool owned = true; ///< whether this rank integrates over it
  std::array<unsigned int, FacetElement<dim>::max_n_nodes>
      nodes{};                 ///< indices into the surface's nodes; the first n_nodes() count
  unsigned int body = 0;       ///< index of the body it belongs to
  double layer_thickness = 0.; ///< h: size of the element behind the face, along its normal; of simplices a
                               ///< mean around the face [m]
  double room = 0.; ///< depth down to which the nearest way out leads through this face: h, or h/2 where the
                    ///< body is one element thick [m]
  double youngs_modulus = 0.; ///< E of that element [Pa]
  double density = 0.;        ///< ρ of that element [kg/m³]
  unsigned int number = 0;    ///< among the facets of all ranks: orders that must not depend on the ranks
};

/// Pressures at the nodes of every facet, [facet][node of the facet] [Pa]; a node's may differ from facet to
/// facet.
template <int dim>
using NodalPressures = std::vector<std::array<double, Facet<dim>::max_n_nodes>>;

/// The outer faces of the bodies of a scene, as the contact module sees them: facets on nodes, nothing of the
/// elements behind. A rank holds its own facets first, which it integrates over and which stay, and after
/// them those of other ranks that come near; own nodes come first as well.
template <int dim>
struct ContactSurface
{
  /// What facets of any rank have, also those that are not held.
  struct Extremes
  {
    double layer_thickness = std::numeric_limits<double>::max(); ///< the smallest h [m]
    double room = std::numeric_limits<double>::max();            ///< the smallest one [m]
    std::vector<FacetElement<dim>> elements;                     ///< all kinds of them
  };

  /// All positions are from here [m]: near the bodies, so that depths keep their digits in scenes far from
  /// the origin of the coordinates.
  SpatialVector<dim> origin = SpatialVector<dim>::Zero();
  std::vector<SpatialVector<dim>> reference_positions; ///< one a node, undeformed [m]
  std::vector<Facet<dim>> facets;
  unsigned int n_bodies = 0;
  Extremes elsewhere; ///< of other ranks; may count those of this one as well

  unsigned int n_nodes() const { return static_cast<unsigned int>(reference_positions.size()); }

  /// Of all ranks; the largest double for a surface without facets [m].
  double smallest_room() const
  {
    double smallest = elsewhere.room;
    for (const Facet<dim> &facet : facets)
      smallest = std::min(smallest, facet.room);
    return smallest;
  }

  double smallest_layer_thickness() const ///< likewise [m]
  {
    double smallest = elsewhere.layer_thickness;
    for (const Facet<dim> &facet : facets)
      smallest = std::min(smallest, facet.layer_thickness);
    return smallest;
  }
};
} // namespace signorini
