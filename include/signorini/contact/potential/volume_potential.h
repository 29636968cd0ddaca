// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/potential/contact_measures.h"
#include "signorini/contact/potential/simplex_pair.h"
#include "signorini/contact/search/simplex_search.h"

#include <functional>
#include <set>
#include <utility>
#include <vector>

namespace signorini::contact
{
struct VolumePotentialSettings
{
  double penalty_factor = 10.; ///< α > 0

  /// Skin of the search over the smallest height of a simplex, > 0. A wide one makes searches rare, but
  /// add_row_sum_bounds() loose.
  double skin_over_height = 0.05;
  std::vector<std::pair<unsigned int, unsigned int>> excluded_body_pairs; ///< in either order
};

/// The volume contact potential of a scene (Munjiza 2004, section 2.6),
///
///   W(x) = Σ over pairs of ∫ over A∩B of (φ_A + φ_B) dV,   φ_A = ½ k_A H_A min_m λ_m^A,
///   k_A = α / (h_A/E_A + h_B/E_B),
///
/// over all simplices A, B of different bodies, and its exact derivatives for nodes that deform them
/// (SimplexPair). Two flat layers pressed into each other by d ≪ h push with k_A d (1 − O(d/h)), as those of
/// ContactPotential do with k_A d. φ falls to 0 on inner faces as well: forces are jagged along edges of
/// elements, and turn round where a depth exceeds H/(dim + 1).
///
/// H, h and E are those of the undeformed mesh, so W is one fixed function of the positions whatever pairs
/// are listed. Simplices turned inside out count as those that they cover; flat ones touch nothing.
///
/// Use: update(x) whenever positions changed, evaluate(x), then any of the const functions. All sums run over
/// the pairs of this rank only (see SimplexSearch); add over ranks for totals. Bodies meet no obstacles here.
template <int dim>
class VolumePotential
{
public:
  using Positions = std::vector<SpatialVector<dim>>;

  /// `contact_volume` must outlive this object and have its heights, see compute_heights(). Throws
  /// std::invalid_argument for settings or simplices without sense.
  VolumePotential(const ContactVolume<dim> &contact_volume, VolumePotentialSettings potential_settings);

  /// Searches pairs if that is needed, no more often than every half skin of motion. Returns the jump of the
  /// stored energy [J], which is always 0.
  double update(const Positions &positions);

  /// Whether some node moved so far since the last search that pairs may be missing.
  bool is_stale(const Positions &positions) const { return search.is_stale(positions); }

  /// Finds all overlaps. Everything below speaks of these positions.
  void evaluate(const Positions &positions);

  double energy() const; ///< [J]

  /// Adds −∂W/∂x on the nodes.
  void add_forces(std::vector<SpatialVector<dim>> &forces) const;

  /// Calls `add(nodes, block)` for every overlap with its Hessian block of size dim·n_nodes, node-major.
  /// Pairs on the very verge of contact count as overlapping here, so that bodies laid exactly upon each
  /// other hold each other.
  void for_each_tangent(const std::function<void(const std::vector<unsigned int> &nodes,
                                                 const Eigen::MatrixXd &block)> &add) const;

  /// Calls `add(nodes)` with the nodes that may couple until pairs are searched again.
  void for_each_coupling(const std::function<void(const std::vector<unsigned int> &nodes)> &add) const;

  /// This rank's pairs, each listed where its first simplex is owned.
  const typename SimplexSearch<dim>::Pairs &pairs() const { return search.pairs(); }

  /// How often pairs were searched: couplings stay the same between two searches.
  unsigned int n_searches() const { return search.n_rebuilds(); }

  /// Adds to every node a bound s_a of the row sum Σ_b ‖∂²W/∂x_a∂x_b‖ [N/m] that holds until pairs are
  /// searched again, as long as the simplices near each other keep their shapes. The largest eigenvalue of
  /// M⁻¹ ∂²W/∂x∂x is at most max_a s_a/m_a (Gershgorin, block by block).
  void add_row_sum_bounds(std::vector<double> &stiffness) const;

  /// The share of its volume that each simplex has in others, by the pairs of this rank, [simplex].
  std::vector<double> sunk_shares() const;

  /// The depth of a simplex with the share s in others is H (1 − (1 − s)^{1/dim}), as that of a flat layer
  /// pressed in from its outer face, or that of the corners of an overlap below the nearest face, inner ones
  /// included, if more; it is taken over the h of the simplex. The pressure is 2 max φ, k_A d at flat layers;
  /// the area that of the second body's deformed surface in the first one, inner faces cancelling; the
  /// deepest body the other one. `all_sunk_shares`: those of all ranks.
  ContactMeasures<dim> measure(const std::vector<double> &all_sunk_shares) const;
  ContactMeasures<dim> measure() const { return measure(sunk_shares()); }

  /// Resultants by pair of bodies.
  PairForces<dim> pair_forces() const;

  /// Adds 2W of every overlap, half to either element, to a list by element, [Simplex::cell]: the square of
  /// what the penalty leaves of the error in the energy norm [J; J/m in 2-D].
  void add_cell_errors(std::vector<double> &errors) const;

  /// Faces of elements, inner ones included, which lie in another body at least in part, each by its nodes in
  /// ascending order.
  std::set<std::vector<unsigned int>> faces_in_contact() const;

private:
  using State = typename SimplexPair<dim>::State;

  double stiffness(unsigned int pair) const; ///< k_A [Pa/m]
  SimplexPair<dim> make_pair(unsigned int pair) const;
  const Simplex<dim> &simplex(unsigned int pair, unsigned int side) const;
  unsigned int vertex(unsigned int pair, unsigned int index) const;
  /// Nodes that some vertices are made of, in ascending order.
  template <typename Vertices>
  std::vector<unsigned int> collect_nodes(const Vertices &vertices) const;
  std::vector<unsigned int> nodes_of(unsigned int pair) const;

  /// Force on the pair's first simplex.
  static SpatialVector<dim> force_on_first(const State &state);

  struct Overlap
  {
    unsigned int pair; ///< index into the pairs of the search
    State state;
  };

  const ContactVolume<dim> &volume;
  VolumePotentialSettings settings;
  double skin; ///< [m]
  SimplexSearch<dim> search;

  std::vector<SimplexShape<dim>> shapes; ///< one a simplex, of those that have a pair
  std::vector<bool> has_pair;            ///< one a simplex
  std::vector<Overlap> overlaps;
};
} // namespace signorini::contact
