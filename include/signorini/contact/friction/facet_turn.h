// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/geometry/facet_shape.h"

namespace signorini::contact
{
/// Tangents of a facet at one of its points, and what is dual to them.
template <int dim>
struct FacetBasis
{
  FacetShape<dim> shape;
  std::array<SpatialVector<dim>, dim - 1> tangent; ///< t_α = ∂x/∂ξ_α [m]
  std::array<SpatialVector<dim>, dim - 1> dual;    ///< t^α in the tangent plane, t^α·t_β = δ_αβ [1/m]
  SpatialVector<dim> normal;                       ///< m, outward, of unit length

  FacetBasis(const FacetNodes<dim> &nodes, const LocalPoint<dim> &xi);
};

/// The rotation by which a point of a facet has turned with the material around it: that of the polar
/// decomposition of Σ_α t_α ⊗ t^α_before + m ⊗ m_before. A rigid motion of the nodes gives back its own
/// rotation.
template <int dim>
SpatialTensor<dim> find_turn(const FacetBasis<dim> &before, const FacetBasis<dim> &now);

/// The vector that a vector in the plane of normal `from` becomes under the shortest turn of that normal to
/// `to`, both of unit length; zero for opposite normals, between which there is no shortest turn.
template <int dim>
SpatialVector<dim> turn_to_plane(const SpatialVector<dim> &in_plane, const SpatialVector<dim> &from,
                                 const SpatialVector<dim> &to);

/// Force on node b of a facet [N] of forces on all its nodes without resultant and with the moment r × f of a
/// force f at the arm r. `couple` is S = f rᵀ − r fᵀ (in 3-D S v = (r × f) × v), and
///
///   f_b = ½ Σ_α N_b,α (I + m mᵀ) S t^α,
///
/// the transpose of how find_turn() follows small motions of the nodes.
template <int dim>
SpatialVector<dim> couple_force(const FacetBasis<dim> &basis, unsigned int b,
                                const SpatialTensor<dim> &couple);
} // namespace signorini::contact
