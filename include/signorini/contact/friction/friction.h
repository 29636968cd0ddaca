// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/friction/facet_turn.h"
#include "signorini/contact/friction/slip_history.h"
#include "signorini/contact/friction/slip_motion.h"
#include "signorini/contact/potential/contact_potential.h"
#include "signorini/contact/potential/coulomb_law.h"

namespace signorini::contact
{
/// The traction under which a point slides in a step.
enum class SlidUnder
{
  mean_traction, ///< of the start and the end: of second order in the step
  last_traction  ///< that of the end: what an implicit step balances, never negative
};

/// Coulomb friction of the points of a surface potential, from step to step (doc/theory.md, section 6a).
///
/// A point in contact has an elastic slip s in the tangent plane of its target and the traction τ = −k_A s on
/// its facet, |τ| ≤ μ p with the pressure p ≥ 0, damping included. The slip grows by what the point moves, in
/// one step, beyond the material point of the target that is carried along its normal to the same place: so a
/// rigid motion of both is no slip. Both bodies get the traction at that place, hence their forces and
/// moments cancel.
///
/// Use, once for each accepted step: evaluate(), any of the const functions, commit(). A step that is tried
/// again evaluates again. In a step whose contact is found implicitly linearize() and follow() stand in the
/// place of evaluate(), after those of the potential. Sums run over owned facets only; add over ranks for
/// totals.
template <int dim>
class Friction
{
public:
  using Positions = std::vector<SpatialVector<dim>>;

  /// `potential` must outlive this object; `coefficient`: μ ≥ 0. Throws std::invalid_argument for face
  /// segments, whose points do not stay, and for a coefficient without sense.
  Friction(const ContactPotential<dim> &potential, double coefficient, SlidUnder slid_under);

  /// Slips from the positions of the last commit() to those that the potential was evaluated at, by the
  /// pressures with damping at the velocities of the nodes. The first time nothing has moved yet.
  void evaluate(const std::vector<SpatialVector<dim>> &velocities);

  /// Takes the slips since the last commit() for linear functions of the nodes' positions, around those that
  /// the potential is linear around, of points that overlap by more than `least` [m]. Their forces have no
  /// moment about the positions `acting`.
  void linearize(double least, const Positions &acting);

  /// ContactPotential::for_each_linear_point() with these slips.
  void for_each_linear_point(double least, const std::function<void(const LinearPoint<dim> &)> &visit) const;

  /// The slips where the potential has followed the nodes to, by the pressures there.
  void follow();

  /// The points that touch, as of the last evaluation.
  std::vector<PlacedSlip<dim>> placed_slips() const;

  /// To be called before the first evaluation, which then gives every point that touches the slip of the
  /// nearest of `slips` with the same partners, as far as its cone allows.
  void remember(std::vector<PlacedSlip<dim>> slips) { remembered = std::move(slips); }

  /// Whether it has been evaluated: from then on it remembers where the nodes were at the last commit.
  /// Whoever gives the surface other facets of other ranks must give this the positions of their nodes before
  /// anything else is asked.
  bool has_memory() const { return has_begun; }
  const Positions &positions_of_last_commit() const { return old_positions; }
  void set_positions_of_last_commit(Positions positions) { old_positions = std::move(positions); }

  double energy() const; ///< Σ A ½ k_A |s|² [J]

  /// For an iteration that looks for a balance: takes the pressures of the last evaluation for those of
  /// held_energy(), and lets points stick that would slide the other way than at the last hold(). Between the
  /// two directions lies the narrow range of stick, which an iteration that sees only one of them leaps over
  /// for ever.
  void hold();

  /// Lets all points obey Coulomb's law again.
  void release();

  /// Σ A k_A (½ |s|² + |s| |Δs_slid|) / share with the slip s that held pressures would leave of the trial
  /// slip: the function of the positions, convex in the slip, whose gradient the forces are at held pressures
  /// and shares [J].
  double held_energy() const;

  /// Adds the forces of the tractions to those of the nodes.
  void add_forces(std::vector<SpatialVector<dim>> &forces) const;

  /// Calls `add(nodes, block)` for every point that touches, those on the very verge as if they stuck, with
  /// minus the derivative of these forces by the
  /// positions of the nodes, node-major, see compute_body_friction_tangent(); after evaluate() or follow() at
  /// rest.
  void for_each_tangent(const std::function<void(const std::vector<unsigned int> &nodes,
                                                 const Eigen::MatrixXd &block)> &add) const;

  /// Accepts the step last evaluated. Returns what it dissipated [J]: of every point A times its traction,
  /// times the way it slid; a point that parts gives up what it stored. With the mean of the tractions not
  /// negative but for points that turn round while they lose most of their pressure in the same step.
  double commit();

  /// Resultants of the tractions by pair.
  PairForces<dim> pair_forces() const
  {
    return potential.sum_by_pair([this](const NearPair &near) { return force_of(near); });
  }

  /// What the points remember between two steps, for boost's archives.
  template <typename Archive>
  void serialize(Archive &archive, unsigned int /*version*/)
  {
    archive &history &has_begun &old_positions &old_shifts;
  }

private:
  using NearPair = typename ContactPotential<dim>::NearPair;

  void begin();

  /// Since the last commit.
  SlipMotion<dim> find_motion(const NearPair &near) const;
  /// How an obstacle moved since the last commit [m].
  SpatialVector<dim> find_shift(unsigned int obstacle) const;
  void slip(const NearPair &near, double pressure, FrictionPoint<dim> &point) const;
  /// The levers of LinearSlip about the positions `acting`.
  static typename LinearSlip<dim>::Levers find_levers(const NearPair &near, const Positions &acting);
  /// ∂(slip)/∂x and the rest of the tangent of a point whose slip is linear; overwrites `block`.
  void compute_linear_tangent(const NearPair &near, Eigen::MatrixXd &block) const;

  static auto partners_of(const NearPair &near)
  {
    return typename PlacedSlip<dim>::Partners(near.contactor.body, near.pair.target, near.target == nullptr);
  }

  /// The point of a pair in the history, which may be const or not.
  template <typename History>
  auto &point_of(const NearPair &near, History &all) const
  {
    const PairList<dim> &pairs = potential.pair_list();
    return near.target != nullptr ? all.bodies[&near.pair - pairs.body_pairs().data()]
                                  : all.obstacles[&near.pair - pairs.obstacle_pairs().data()];
  }

  /// On the contactor [N].
  SpatialVector<dim> force_of(const NearPair &near) const;

  const ContactPotential<dim> &potential;
  double coefficient;
  SlidUnder slid_under;
  SlipHistory<dim> history;
  std::vector<PlacedSlip<dim>> remembered;   ///< until the first evaluation
  bool has_begun = false;                    ///< whether it has been evaluated
  Positions old_positions;                   ///< of the last commit
  Positions old_shifts;                      ///< of the obstacles, then
  std::vector<LinearSlip<dim>> linear_slips; ///< after linearize(), one a pair, body pairs first
  Positions linear_positions;                ///< that these are trial slips at
};
} // namespace signorini::contact
