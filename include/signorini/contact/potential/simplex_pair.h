// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/geometry/simplex_overlap.h"

#include <array>
#include <optional>

namespace signorini::contact
{
/// Two simplices A, B of different bodies with the energy
///
///   W = W_A + W_B,   W_A = ∫ over A∩B of φ_A dV,   φ_A = κ_A min_m λ_m^A,   W_B alike.
///
/// All derivatives come from integrals over ∂B∩A. Let s_q = λ_q^B at a vertex q of B, −λ_q^A at one of A, n
/// the outward normal of B, and S_q = ∫ over ∂B∩A of φ_A s_q n dS. Because φ_A = 0 on ∂A, a variation δx of
/// the vertices changes W_A = |V_A| Ψ(λ^A of B's vertices) by
///
///   ∂W_A/∂x_q = S_q + { W_A ∇λ_q^A if q ∈ A },
///
/// and the second variation has the blocks
///
///   H_pq = Σ_{f,m} κ_A ∇λ_m^A ⊗ n_f ∫ over f∩R_m of s_p s_q dS
///        + { ∇λ_p^B ⊗ S_q − S_q ⊗ ∇λ_p^B if p ∈ B } + { S_p ⊗ ∇λ_q^A − ∇λ_q^A ⊗ S_p if q ∈ A }
///        + { W_A (∇λ_p^A ⊗ ∇λ_q^A − ∇λ_q^A ⊗ ∇λ_p^A) if p, q ∈ A },
///
/// f being the faces of B and R_m the part of A where λ_m is smallest (doc/theory.md). Vertices of A count
/// before those of B.
template <int dim>
struct SimplexPair
{
  static constexpr unsigned int n_vertices = 2 * (dim + 1);
  using Forces = std::array<SpatialVector<dim>, n_vertices>;
  using Tangent = Eigen::Matrix<double, dim * n_vertices, dim * n_vertices>;

  std::array<const SimplexShape<dim> *, 2> shapes;
  std::array<double, 2> strengths; ///< κ [Pa]

  /// What an overlap amounts to.
  struct State
  {
    double energy = 0.;                                   ///< W [J]
    Forces forces;                                        ///< −∂W/∂x [N]
    SpatialVector<dim> area = SpatialVector<dim>::Zero(); ///< ∫ n dS over ∂B∩A [m²; m in 2-D]
    std::array<bool, n_vertices>
        is_face_in_contact{};             ///< of the face opposite: whether a part is within the other
    std::array<double, 2> shares{0., 0.}; ///< of the volumes of A, of B that lie in the other
    std::array<double, 2> depths{0., 0.}; ///< the largest below the nearest face of A, of B [m]
    std::array<double, 2> largest_potentials{0., 0.};    ///< max φ_A, max φ_B [Pa]
    std::array<SpatialVector<dim>, 2> deepest_positions; ///< where these depths are

    State()
    {
      forces.fill(SpatialVector<dim>::Zero());
      deepest_positions.fill(SpatialVector<dim>::Zero());
    }
  };

  /// Nothing where they do not overlap. Depths and potentials are those at the corners of the overlap's parts
  /// with one smallest coordinate.
  std::optional<State> evaluate() const;

  /// Whether they overlap; sets `tangent` to H of W if so. Where they do not, simplices no farther apart than
  /// `verge` [m] count as just touching.
  bool compute_tangent(double verge, Tangent &tangent) const;

  /// Adds to every vertex p a bound of Σ_q ‖H_pq‖ [N/m] that holds as long as the relative motion of the two
  /// simplices stays within `motion` [m] and they keep their shape.
  void add_row_sum_bounds(double motion, std::array<double, n_vertices> &bounds) const;
};
} // namespace signorini::contact
