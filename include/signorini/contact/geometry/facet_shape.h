// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/discretization/contact_surface.h"

#include <array>
#include <optional>
#include <vector>

namespace signorini::contact
{
/// Values and local derivatives of a facet's shape functions at one local point.
template <int dim>
struct FacetShape
{
  static constexpr unsigned int n_second = (dim == 2 ? 1 : 3); ///< 11 (2-D); 11, 12, 22 (3-D)

  unsigned int n_nodes = 0;
  std::array<double, Facet<dim>::max_n_nodes> value{};
  std::array<std::array<double, dim - 1>, Facet<dim>::max_n_nodes> first{};
  std::array<std::array<double, n_second>, Facet<dim>::max_n_nodes> second{};
};

/// Evaluates all shape functions of a facet at `xi`.
template <int dim>
FacetShape<dim> evaluate_facet_shape(const FacetElement<dim> &element, const LocalPoint<dim> &xi);

/// Local coordinates of node i of a facet.
template <int dim>
LocalPoint<dim> node_coordinates(const FacetElement<dim> &element, unsigned int i);

/// Largest sum of the magnitudes of all shape functions: how far a point of a facet may move at most when its
/// nodes move by one.
template <int dim>
constexpr double lebesgue_constant(const FacetElement<dim> &element)
{
  if (element.degree == 1)
    return 1.;
  if (element.type == FacetType::triangle)
    return 5. / 3.;
  return dim == 2 ? 1.25 : 1.25 * 1.25;
}

/// The piecewise linear function that is 1 at node i of a facet and 0 at its other nodes: nowhere negative,
/// and over the nodes they sum to 1.
template <int dim>
double evaluate_hat_function(const FacetElement<dim> &element, unsigned int i, const LocalPoint<dim> &xi);

/// A straight-edged part of a facet.
struct SubFacet
{
  unsigned int n_corners = 0;
  std::array<unsigned int, 4> corner{}; ///< nodes of the facet, counter-clockwise
};

/// The parts of a facet in 3-D, with all nodes for corners: one of degree 1, four of degree 2.
const std::vector<SubFacet> &get_sub_facets(const FacetElement<3> &element);

/// Positions of one facet's nodes, in the order of `Facet::nodes`.
template <int dim>
struct FacetNodes : FacetElement<dim>
{
  std::array<SpatialVector<dim>, FacetElement<dim>::max_n_nodes> position;
};

/// Collects the nodes of `facet` out of the positions of all surface nodes.
template <int dim>
FacetNodes<dim> gather_nodes(const Facet<dim> &facet, const std::vector<SpatialVector<dim>> &positions);

/// Points of a facet in equal steps of its local coordinates, corners included, no farther apart than
/// `spacing` [m], but at most 65 a direction.
template <int dim>
std::vector<SpatialVector<dim>>
make_lattice(const Facet<dim> &facet, const std::vector<SpatialVector<dim>> &positions, double spacing);

/// Position and tangents of a facet at one local point.
template <int dim>
struct FacetFrame
{
  SpatialVector<dim> position;
  std::array<SpatialVector<dim>, dim - 1> tangent; ///< ∂x/∂ξ_α
  SpatialVector<dim> area_normal;                  ///< outward normal scaled by dA/dξ
};

template <int dim>
FacetFrame<dim> evaluate_facet_frame(const FacetNodes<dim> &nodes, const LocalPoint<dim> &xi);

/// The vectors t^α across a unit vector `normal` that are dual to the tangents, t^α·t_β = δ_αβ [1/m]: an
/// offset from the facet has the local coordinates t^α·offset where a line along `normal` meets the facet's
/// plane. Nothing where such lines hardly meet it.
template <int dim>
std::optional<std::array<SpatialVector<dim>, dim - 1>> find_oblique_dual(const FacetFrame<dim> &frame,
                                                                         const SpatialVector<dim> &normal);
} // namespace signorini::contact
