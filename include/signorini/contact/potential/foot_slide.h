// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/potential/contact_pair.h"

#include <Eigen/Core>

namespace signorini::contact
{
/// Position and derivatives of a facet at one of its points.
template <int dim>
struct FacetJet
{
  FacetShape<dim> shape;
  SpatialVector<dim> position = SpatialVector<dim>::Zero();
  std::array<SpatialVector<dim>, dim - 1> first;                    ///< tangents, y,α
  std::array<SpatialVector<dim>, FacetShape<dim>::n_second> second; ///< y,αβ at α + β

  FacetJet(const FacetNodes<dim> &nodes, const LocalPoint<dim> &xi);
};

/// How the foot of a point slides over its target facet as nodes move. With F(x, ξ) = ½ |g|² and
/// g = Σ_a B_a(ξ) x_a the foot stays at a minimum over the directions in which it may slide,
/// dξ = −F_ξξ⁻¹ F_ξx dx,  F_xξα = Bᵀ g,α + B,αᵀ g,  F_ξαβ = y,α·y,β − g·y,αβ.
template <int dim>
struct FootSlide
{
  static constexpr int max_n = dim * PairStencil<dim>::max_n_nodes;

  Eigen::Matrix<double, Eigen::Dynamic, dim - 1, Eigen::ColMajor, max_n, dim - 1> coupling; ///< F_xξ [m]
  /// ∂ξ/∂x, node-major [1/m]; zero at a centre of curvature, where the foot is not unique.
  Eigen::Matrix<double, dim - 1, Eigen::Dynamic, (dim == 2 ? Eigen::RowMajor : Eigen::ColMajor), dim - 1,
                max_n>
      by_nodes;
};

/// `target`: the nodes of the target facet, at the end of the stencil.
template <int dim>
FootSlide<dim> find_foot_slide(const PairFoot<dim> &foot, const PairStencil<dim> &stencil,
                               const FacetNodes<dim> &target);

/// Whether the normal of the foot at `xi`, that far from its point [m], is that of its facet: inside the
/// facet, or too close to it for the gap to have a direction. Else it is the gap's.
template <int dim>
bool has_normal_of_facet(const Facet<dim> &target, const LocalPoint<dim> &xi, double distance);
} // namespace signorini::contact
