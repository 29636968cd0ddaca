// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/base/spatial_vector.h"
#include "signorini/contact/geometry/convex_polytope.h"

#include <array>

namespace signorini::contact
{
/// A simplex and its barycentric coordinates λ_a, which are linear functions in all of space.
template <int dim>
struct SimplexShape
{
  static constexpr unsigned int n_vertices = dim + 1;

  std::array<SpatialVector<dim>, n_vertices> vertices;  ///< in any order
  std::array<SpatialVector<dim>, n_vertices> gradients; ///< ∇λ_a [1/m]
  double volume = 0.; ///< > 0; 0 where the vertices lie in a plane and there are no λ_a

  /// λ at a point.
  Eigen::Matrix<double, dim + 1, 1> coordinates(const SpatialVector<dim> &x) const;

  /// Normal of the face opposite a vertex, outward, as long as the face is large [m²; m in 2-D].
  SpatialVector<dim> area_vector(unsigned int opposite) const { return -dim * volume * gradients[opposite]; }
};

/// Volumes below 1e-12 of the box that the edges at one vertex could span count as none.
template <int dim>
SimplexShape<dim> make_simplex_shape(const std::array<SpatialVector<dim>, dim + 1> &vertices);

/// The two simplices of an overlap.
template <int dim>
using SimplexCouple = std::array<SimplexShape<dim>, 2>;

/// Second moments of barycentric coordinates over a piece of a face, divided by the area of the whole face.
template <int dim>
using FaceMoments =
    Eigen::Matrix<double, ConvexPolytope<dim>::n_coordinates, ConvexPolytope<dim>::n_coordinates>;

/// The overlap of two simplices, or of the second one and the first with its faces moved outwards by `margin`
/// ≥ 0 [m]. Faces have the index of the vertex of the first simplex that they are opposite to as their label,
/// those of the second dim + 1 more. Where the two only touch it is empty: distances from a face below
/// 1e-14 of the height above it (more if the simplices are of very unlike size) are taken for none.
template <int dim>
ConvexPolytope<dim> make_overlap(const SimplexShape<dim> &first, const SimplexShape<dim> &second,
                                 double margin = 0.);

/// The part of the overlap in which λ_m of simplex `of` (0 or 1) is the smallest of its coordinates; cut
/// faces get the label 2 (dim + 1).
template <int dim>
ConvexPolytope<dim> restrict_to_sector(const ConvexPolytope<dim> &overlap, unsigned int of, unsigned int m);

/// ∫ λ dV of all coordinates over the overlap or a part of it, divided by the volume of simplex `of`. The sum
/// of those of one simplex is the volume. Exact.
template <int dim>
typename ConvexPolytope<dim>::Coordinates integrate_coordinates(const ConvexPolytope<dim> &part,
                                                                unsigned int of);

/// ∫ λ λᵀ dS over a face that lies in a face of one of the simplices, divided by the area of that one. Exact.
template <int dim>
FaceMoments<dim> integrate_products(const ConvexPolytope<dim> &part,
                                    const typename ConvexPolytope<dim>::Face &face);

/// The column of integrate_products() with λ_m, which costs less.
template <int dim>
typename ConvexPolytope<dim>::Coordinates
integrate_products_with(const ConvexPolytope<dim> &part, const typename ConvexPolytope<dim>::Face &face,
                        unsigned int m);
} // namespace signorini::contact
