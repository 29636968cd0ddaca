// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/potential/contact_pair.h"

#include <Eigen/Core>

#include <vector>

namespace signorini::contact
{
/// Hessian of A ½ k (d + o)² with the offset o of the pair, with respect to the nodes of the stencil,
/// node-major. Without an offset it is that of A ½ k |x − y(ξ)|² at its minimum over ξ:
///
/// With F(x, ξ) = ½ |g|² of FootSlide the Hessian of the minimum is F_xx − F_xξ F_ξξ⁻¹ F_ξx, F_xx = Bᵀ B ⊗ I;
/// with one it is ∇d∇dᵀ + (d + o)/d (that − ∇d∇dᵀ).
/// `target` are the nodes of the target facet at the last evaluation. Overwrites `block`.
template <int dim>
void compute_body_tangent(const ContactPair<dim> &pair, const PairFoot<dim> &foot,
                          const PairStencil<dim> &stencil, const FacetNodes<dim> &target,
                          Eigen::MatrixXd &block);

/// Hessian of A ½ k (d(x) + o)² of an obstacle's depth: A k Bᵀ (n nᵀ + (d + o) ∇∇d) B. Overwrites `block`.
template <int dim>
void compute_obstacle_tangent(const ContactPair<dim> &pair, const PairFoot<dim> &foot,
                              const PairStencil<dim> &stencil, const SpatialTensor<dim> &depth_hessian,
                              Eigen::MatrixXd &block);

/// Adds up the rows and the columns of nodes that are there twice, as where two facets of one body share
/// them.
template <int dim>
void merge_nodes(std::vector<unsigned int> &nodes, Eigen::MatrixXd &block);
} // namespace signorini::contact
