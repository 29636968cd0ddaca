// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/potential/body_feet.h"
#include "signorini/contact/potential/contact_measures.h"
#include "signorini/contact/potential/obstacle_places.h"
#include "signorini/contact/potential/pair_list.h"

#include <algorithm>
#include <functional>
#include <optional>

namespace signorini::contact
{
/// The surface contact potential of a scene,
///
///   W(x) = Σ_q A_q ½ k_A,q (d_q + o_q)²   over points q with d_q + o_q > 0,   k_A = α / (h_c/E_c + h_t/E_t),
///
/// with the depths d_q and the offsets o_q = λ_q/k_A,q of the multipliers, which are 0 unless
/// set_multipliers() was called: a point presses with λ_q where nothing overlaps.
///
/// and its exact derivatives. Points q lie on the faces of every deformable body (its undeformed area
/// measures A_q); where the other side is deformable too, both sides are sampled and each counts half, so
/// that neither is preferred. With y(ξ) the closest point of the other surface, ½ d² = min_ξ ½ |x − y(ξ)|²,
/// hence the gradient needs no derivative of ξ, and the Hessian is a Schur complement over the free
/// directions of ξ.
///
/// Forces act on the surface's nodes; each pair's forces sum to zero, and so do their moments.
/// E_t = ∞ and h_t = 0 for obstacles, which are met at any depth; another body only as deep as the layer
/// thickness of the point's own facet. k_A of a pair is fixed when the pair is made (by the closest facet
/// then) and, with face quadrature, kept as long as the point stays near that body; what the stored energy
/// changes by when face segments are made anew is returned by update().
///
/// Use: update(x) whenever positions changed, evaluate(x), then any of the const functions.
/// All sums run over owned facets only; add over ranks for totals.
template <int dim>
class ContactPotential
{
public:
  using Positions = std::vector<SpatialVector<dim>>;
  using Obstacles = std::vector<std::shared_ptr<const Obstacle<dim>>>;

  /// `contact_surface` must outlive this object; its own facets must stay, those of other ranks may change in
  /// search() only. Throws std::invalid_argument for settings or facets without sense.
  ContactPotential(const ContactSurface<dim> &contact_surface, Obstacles obstacles,
                   PotentialSettings settings);

  /// Moves the obstacles, which do not move before the first call. Called again with the time of the present
  /// places it does nothing; update() and evaluate() must follow it at another.
  void move_obstacles(const ObstaclePlaces<dim> &places);

  /// Where the obstacles are, and where they were at the time before: the same after the first call.
  const ObstaclePlaces<dim> &obstacle_places() const { return places; }
  const ObstaclePlaces<dim> &obstacle_places_before() const { return places_before; }

  /// Renews neighbours and points where that is needed: never more often than every half skin of motion with
  /// face quadrature, at every call with face segments. Returns the jump of the stored energy [J] that the
  /// renewal caused at these positions, exactly 0 if no point and no stiffness changed, and 0 the first time.
  double update(const Positions &positions);

  /// The same where neighbours must be searched, whether is_stale() here or on another rank only.
  /// `take_facets` is called in between: it may change the facets of other ranks in the surface, and returns
  /// the positions of all nodes that there are afterwards.
  double search(const Positions &positions, const std::function<Positions()> &take_facets);

  /// Whether some node or obstacle moved so far since the last renewal that neighbours may be missing.
  bool is_stale(const Positions &positions) const;

  /// Finds the feet of all points. Everything below speaks of these positions.
  void evaluate(const Positions &positions);

  /// See PairList::set_penalty_factor(); the energy is another one afterwards.
  void set_penalty_factor(double penalty_factor);

  /// See PairList::set_multipliers(); the energy is another one afterwards.
  void set_multipliers(NodalPressures<dim> multipliers);

  double energy() const; ///< [J]

  /// Adds −∂W/∂x.
  void add_forces(std::vector<SpatialVector<dim>> &forces) const;

  /// Adds the forces of the damping σ_c = 2ξ√(k_A m_A)·ḋ, with k_A d + σ_c clipped at 0, apart from the
  /// conservative ones. Does nothing without a damping ratio. Returns the dissipated power [W], ≥ 0.
  double add_damping_forces(const std::vector<SpatialVector<dim>> &velocities,
                            std::vector<SpatialVector<dim>> &forces) const;

  /// Adds the forces of add_forces() to `forces` and those of add_damping_forces() to `damping_forces`, in
  /// one pass over the points.
  void add_all_forces(const std::vector<SpatialVector<dim>> &velocities,
                      std::vector<SpatialVector<dim>> &forces,
                      std::vector<SpatialVector<dim>> &damping_forces) const;

  /// Share of the skin up to which a gap counts as closed in tangents.
  static constexpr double verge = 1e-8;

  /// Calls `add(nodes, block)` for every active pair with its Hessian block of size dim·n_nodes, node-major.
  /// Pairs on the very verge of contact count as active here, so that bodies laid exactly upon each other
  /// hold each other.
  /// With `is_convex` the blocks are A k_A ∇d∇dᵀ alone, which are positive semidefinite.
  void for_each_tangent(
      const std::function<void(const std::vector<unsigned int> &nodes, const Eigen::MatrixXd &block)> &add,
      bool is_convex = false) const;

  /// Calls `add(nodes)` with the nodes that may couple until neighbours are searched again: those of every
  /// owned facet and of all facets of one other body near it.
  void for_each_coupling(const std::function<void(const std::vector<unsigned int> &nodes)> &add) const;

  /// How often neighbours were searched: couplings stay the same between two searches.
  unsigned int n_searches() const { return pairs.n_searches(); }

  /// Adds to every node a the row sums Σ_q A_q k_A |B_a| Σ_b |B_b| [N/m], and the same with the damping
  /// coefficient [N s/m], over all points q in contact or less than a skin away, at their feet of the last
  /// evaluation.
  ///
  /// With s_a these sums, the largest eigenvalue of M⁻¹ ∂²W/∂x∂x is at most max_a s_a/m_a whatever the
  /// directions of the normals: a pair's Hessian lies below A k_A BᵀB ⊗ I (its other terms only soften it),
  /// and the sums bound the 2-norm of that. Likewise for the damping matrix.
  void add_row_sum_bounds(std::vector<double> &stiffness, std::vector<double> &damping) const;

  ContactMeasures<dim> measure() const;

  /// Σ_q A_q (p_q − λ_q)²/k_A over the points of each facet, [facet], = A_q k_A d_q² for those in contact:
  /// the square of what the penalty leaves of the error in the energy norm [J; J/m in 2-D].
  std::vector<double> facet_errors() const;

  /// Resultants by pair; with the damping of these velocities of the nodes, unless there are none.
  PairForces<dim> pair_forces(const std::vector<SpatialVector<dim>> &velocities) const;

  /// Resultants by obstacle; the damping at these velocities of the nodes.
  ObstacleForces<dim> obstacle_forces(const std::vector<SpatialVector<dim>> &velocities) const;

  /// Which owned facets have a point in contact, [facet].
  std::vector<bool> active_facets() const;

  const PairList<dim> &pair_list() const { return pairs; }

  /// Of the last evaluation, and where follow() went since [m].
  const Positions &positions() const { return evaluated_positions; }

  /// All points in contact or less than a skin away whose facet faces the other surface.
  std::vector<ContactSample<dim>> samples() const;

  /// A point near its target; `target` is null for an obstacle.
  struct NearPair
  {
    const ContactPair<dim> &pair;
    const PairFoot<dim> &foot;
    const Facet<dim> &contactor;
    const Facet<dim> *target;
    std::size_t index; ///< among all pairs, those of bodies first
    PairStencil<dim> stencil;

    double overlap() const { return foot.depth + pair.offset; }
    double pressure() const { return pair.stiffness * std::max(overlap(), 0.); }
    SpatialVector<dim> force() const { return pair.area * pressure() * foot.normal; }
  };

  /// For a step that starts at the positions `start` and led to those of the last evaluation: points that
  /// could only have been where they are if they had been inside at the start as well, although they were
  /// not, have come in through another face. They get the foot and the normal that they had at the start,
  /// with the depth that these give them now.
  void find_entries(const Positions &start);

  /// For a step that starts at the positions `start`, ends near those of the last evaluation and gets the
  /// contact forces in between (doc/theory.md, section 7): lets every target take them at the point that the
  /// contactor's point was at `start`, so that they have no moment about these positions. Afterwards all of
  /// the above speaks of the depths as linear functions of the nodes' positions, until the next evaluation.
  void linearize(const Positions &start);

  /// Calls `visit` for all points of the linear depths that overlap by more than `least` [m].
  void for_each_linear_point(double least, const std::function<void(const LinearPoint<dim> &)> &visit) const;

  /// The point of a pair, without a slip.
  LinearPoint<dim> make_linear_point(const NearPair &near) const;

  /// ∇∇depth of the obstacle of a pair, at its point [1/m].
  const SpatialTensor<dim> &obstacle_hessian(const NearPair &near) const
  {
    return obstacle_hessians[near.index - body_feet.all().size()];
  }

  /// Whether depths are linear: from linearize() to the next evaluation.
  bool is_linear() const { return !start_depths.empty(); }

  /// Moves the nodes on by `increments` [m], to the end of a step of that length [s]. Damping is from here on
  /// that of the step, whatever the velocities.
  void follow(const Positions &increments, double time_step);

  /// Calls `visit(NearPair)` for all pairs that overlap, with their offset, by more than `least`.
  template <typename Visit>
  void for_each_overlap_above(double least, const Visit &visit) const
  {
    const std::vector<PairFoot<dim>> &feet = body_feet.all();
    const auto visit_pair = [&](std::size_t index)
    {
      const bool is_of_bodies = index < feet.size();
      const std::size_t i = is_of_bodies ? index : index - feet.size();
      const ContactPair<dim> &pair = (is_of_bodies ? pairs.body_pairs() : pairs.obstacle_pairs())[i];
      const PairFoot<dim> &foot = (is_of_bodies ? feet : obstacle_feet)[i];
      if (!(foot.depth + pair.offset > least))
        return;
      NearPair near{
          pair,  foot, surface.facets[pair.facet], is_of_bodies ? &surface.facets[foot.facet] : nullptr,
          index, {}};
      near.stencil.add(near.contactor, pair.shape, 1.);
      if (is_of_bodies)
        near.stencil.add(*near.target, foot.shape, -1.);
      visit(near);
    };
    if (!is_linear())
      find_feet(std::max(0., -least));
    if (!is_linear() && least >= 0.)
      for (const unsigned int i : body_feet.touching())
        visit_pair(i);
    else
      for (std::size_t i = 0; i < feet.size(); ++i)
        visit_pair(i);
    for (std::size_t i = 0; i < obstacle_feet.size(); ++i)
      visit_pair(feet.size() + i);
  }

  /// k_A d and the damping at these velocities of the nodes together, ≥ 0 [Pa].
  double total_pressure(const NearPair &near, const std::vector<SpatialVector<dim>> &velocities) const
  {
    return near.pressure() + damping_pressure(near, depth_rate(near, velocities));
  }

  /// Sums the forces that `force` gives for the contactors of all pairs in contact.
  PairForces<dim> sum_by_pair(const std::function<SpatialVector<dim>(const NearPair &)> &force) const;

  /// The pairs and all that they were last evaluated to, for boost's archives.
  template <typename Archive>
  void serialize(Archive &archive, unsigned int /*version*/)
  {
    archive &pairs &places &places_before &has_pairs &is_evaluated;
    archive &evaluated_positions &body_feet &obstacle_feet &obstacle_hessians;
    archive &start_depths &linear_time_step;
    measures_of_forces.reset();
  }

private:
  using ObstacleFoot = typename Obstacle<dim>::Foot;

  /// Lets the feet on bodies be those of other positions.
  void move_to(const Positions &positions);
  /// Finds there what forces need.
  void find_all();
  /// Those less than `gap` outside of their targets.
  void find_feet(double gap) const { body_feet.find_within(gap, evaluated_positions, surface, pairs); }
  double renew(const Positions &positions, double old_energy);
  void evaluate_obstacle_pairs();
  double depth_rate(const NearPair &near, const std::vector<SpatialVector<dim>> &velocities) const;
  double damping_pressure(const NearPair &near, double depth_rate) const;
  ContactMeasures<dim> begin_measures() const;
  void add_to_measures(const NearPair &near, ContactMeasures<dim> &measures) const;

  /// The shape functions of the foot moved so that it lies below or above the point at `start`.
  void shift_action(const ContactPair<dim> &pair, const Positions &start, PairFoot<dim> &foot) const;

  const ContactSurface<dim> &surface;
  PairList<dim> pairs;
  ObstaclePlaces<dim> places, places_before;
  bool has_pairs = false;
  bool is_evaluated = false;

  Positions evaluated_positions;
  mutable BodyFeet<dim> body_feet;                   ///< found as far as they were asked for
  std::vector<PairFoot<dim>> obstacle_feet;          ///< one an obstacle pair
  std::vector<SpatialTensor<dim>> obstacle_hessians; ///< of the depth, one an obstacle pair

  mutable std::optional<ContactMeasures<dim>> measures_of_forces; ///< taken with the last forces, if any

  std::vector<double> start_depths; ///< in implicit steps: at the start, body pairs first [m]
  double linear_time_step = 0.;     ///< of the last follow() [s]

  // Reused from obstacle to obstacle.
  Positions obstacle_points;
  std::vector<ObstacleFoot> raw_obstacle_feet;
};
} // namespace signorini::contact
