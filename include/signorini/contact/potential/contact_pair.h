// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/geometry/depth.h"

#include <algorithm>
#include <array>
#include <limits>

namespace signorini::contact
{
/// A point on an owned facet (the contactor) and what it may touch: another body or an obstacle (the target).
template <int dim>
struct ContactPair
{
  unsigned int facet = 0;      ///< the contactor
  unsigned int target = 0;     ///< index of the body or of the obstacle
  unsigned int neighbours = 0; ///< bodies only: index into the neighbour list
  double area = 0.;            ///< A_q: undeformed area the point counts with [m²; m in 2-D]
  double stiffness = 0.;       ///< k_A [Pa/m]
  double offset = 0.;          ///< λ/k_A of the point's multiplier, added to its depth [m]
  double damping = 0.;         ///< 2ξ√(k_A m_A) [Pa s/m]
  LocalPoint<dim> xi;          ///< the point on the contactor
  std::array<double, Facet<dim>::max_n_nodes> shape{}; ///< the contactor's shape functions there

  template <typename Archive>
  void serialize(Archive &archive, unsigned int /*version*/)
  {
    archive &facet &target &neighbours &xi &shape &area &stiffness &offset &damping;
  }
};

/// What tells a pair from all others and stays when pairs are made anew: facet, target, ξ.
template <int dim>
using PairKey = std::array<double, dim + 1>;

template <int dim>
PairKey<dim> key_of(const ContactPair<dim> &pair)
{
  PairKey<dim> key;
  key[0] = pair.facet;
  key[1] = pair.target;
  std::copy(pair.xi.begin(), pair.xi.end(), key.begin() + 2);
  return key;
}

/// Where a pair's point stands with respect to its target.
template <int dim>
struct PairFoot
{
  double depth = -std::numeric_limits<double>::infinity(); ///< −∞ where the target is out of reach
  SpatialVector<dim> normal;                               ///< outward unit normal of the target
  SpatialVector<dim> position;                             ///< x
  unsigned int facet = 0;                                  ///< bodies only: the target's closest facet, …
  LocalPoint<dim> xi;                                      ///< … the foot on it …
  std::array<double, Facet<dim>::max_n_nodes> shape{};     ///< … and its shape functions there

  /// g = x − y
  SpatialVector<dim> gap() const { return -depth * normal; }

  template <typename Archive>
  void serialize(Archive &archive, unsigned int /*version*/)
  {
    archive &depth &normal &position &facet &xi &shape;
  }
};

/// The nodes a pair acts on, with weights B so that g = Σ_a B_a x_a (+ a point fixed in space, for
/// obstacles).
template <int dim>
struct PairStencil
{
  static constexpr unsigned int max_n_nodes = 2 * Facet<dim>::max_n_nodes;

  PairStencil() {} // leaves the arrays as they are: to clear them costs more than to use them

  unsigned int n_nodes = 0;
  std::array<unsigned int, max_n_nodes> node;
  std::array<double, max_n_nodes> weight;

  void add(const Facet<dim> &facet, const std::array<double, Facet<dim>::max_n_nodes> &shape, double sign)
  {
    for (unsigned int a = 0; a < facet.n_nodes(); ++a, ++n_nodes)
    {
      node[n_nodes] = facet.nodes[a];
      weight[n_nodes] = sign * shape[a];
    }
  }
};

/// The elastic slip that a point would have if all of it were elastic, as a linear function of the nodes'
/// positions: s = trial + Σ_a (B_a P + L_a nᵀ) Δx_a with P = I − n nᵀ. The levers L, across n, stand for how
/// the target turns below a point that is not on its surface; a force f on the contactor, across n, is B_a f
/// + (L_a·f) n on node a.
template <int dim>
struct LinearSlip
{
  using Levers = std::array<SpatialVector<dim>, PairStencil<dim>::max_n_nodes>;

  LinearSlip() { levers.fill(SpatialVector<dim>::Zero()); }

  double coefficient = 0.;                               ///< of friction, μ; none if 0
  SpatialVector<dim> trial = SpatialVector<dim>::Zero(); ///< across the normal [m]
  Levers levers;                                         ///< of the nodes of the stencil [1]
};

/// A point whose depth is taken for a linear function of the nodes' positions.
template <int dim>
struct LinearPoint
{
  const PairStencil<dim> &stencil;
  const SpatialVector<dim> &normal; ///< the depth falls by normal·Σ_a B_a Δx_a
  double depth = 0.;                ///< [m]
  double area = 0.;                 ///< [m²; m in 2-D]
  double stiffness = 0.;            ///< k_A [Pa/m]
  double damping = 0.;              ///< c_A [Pa s/m]
  double start_depth = 0.;          ///< at the start of the step [m]
  LinearSlip<dim> slip = {};        ///< its stiffness is k_A, too
};
} // namespace signorini::contact
