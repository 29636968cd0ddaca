// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/friction/differentiable.h"
#include "signorini/contact/geometry/facet_shape.h"

namespace signorini::contact
{
/// Tangents of a facet at one of its points, and what is dual to them. `Number`: double or Differentiable.
template <int dim, typename Number = double>
struct FacetBasis
{
  using Vector = VectorOf<dim, Number>;
  using Tangents = std::array<Vector, dim - 1>;
  using Slopes = std::array<Eigen::Matrix<Number, dim - 1, 1>, Facet<dim>::max_n_nodes>;

  Tangents tangent; ///< t_α = ∂x/∂ξ_α [m]
  Tangents dual;    ///< t^α in the tangent plane, t^α·t_β = δ_αβ [1/m]
  Vector normal;    ///< m, outward, of unit length
  Slopes slope;     ///< ∂N_b/∂ξ of the shape functions

  FacetBasis(const FacetNodes<dim> &nodes, const LocalPoint<dim> &xi);
  FacetBasis(const Tangents &tangents, const Slopes &slopes);
};

/// The rotation by which a point of a facet has turned with the material around it: that of the polar
/// decomposition of Σ_α t_α ⊗ t^α_before + m ⊗ m_before. A rigid motion of the nodes gives back its own
/// rotation.
template <int dim, typename Number>
TensorOf<dim, Number> find_turn(const FacetBasis<dim, Number> &before, const FacetBasis<dim, Number> &now);

/// The vector that a vector in the plane of normal `from` becomes under the shortest turn of that normal to
/// `to`, both of unit length; zero for opposite normals, between which there is no shortest turn.
template <int dim, typename Number = double>
VectorOf<dim, Number> turn_to_plane(const VectorOf<dim, Number> &in_plane, const VectorOf<dim, Number> &from,
                                    const VectorOf<dim, Number> &to);

/// Force on node b of a facet [N] of forces on all its nodes without resultant and with the moment r × f of a
/// force f at the arm r. `couple` is S = f rᵀ − r fᵀ (in 3-D S v = (r × f) × v), and
///
///   f_b = ½ Σ_α N_b,α (I + m mᵀ) S t^α,
///
/// the transpose of how find_turn() follows small motions of the nodes.
template <int dim, typename Number>
VectorOf<dim, Number> couple_force(const FacetBasis<dim, Number> &basis, unsigned int b,
                                   const TensorOf<dim, Number> &couple);
} // namespace signorini::contact
