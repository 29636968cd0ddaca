// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/base/exceptions.h"
#include "signorini/solvers/force_balance.h"
#include "signorini/solvers/newton_system.h"

#include <functional>

namespace signorini
{
/// What one Newton iteration did.
struct NewtonReport
{
  unsigned int iteration = 0;
  double residual = 0.;    ///< largest of the bodies' relative residual forces
  double step_length = 0.; ///< share of the Newton step taken; 0 before the first
  unsigned int linear_iterations = 0;
};

/// Finds equilibria: minima of the energy of all force terms under given supports, by Newton's method with
/// the exact tangent and a line search on the energy. With friction, which has none and whose tangent is not
/// symmetric, states in which all forces cancel; the caller accepts its slips (FrictionForce::commit()).
///
/// A body that its supports leave free to move is held by contact. Where it is not (yet) touching, the
/// tangent is singular; the tangent alone, not the forces, then gets a diagonal term a millionth as stiff as
/// the body, which bends the way to the solution but not the solution.
template <int dim>
class QuasiStaticSolver
{
public:
  using Report = std::function<void(const NewtonReport &)>;

  /// The arguments must outlive this object. `map` is null in scenes without contact.
  QuasiStaticSolver(const Discretization<dim> &discretization, const SupportedDofs<dim> &supports,
                    const Scene<dim> &scene, const std::vector<bool> &is_body_held,
                    const SceneForces<dim> &forces, const SurfaceMap<dim> *map,
                    const QuasiStaticParameters &parameters, RunTime &run_time);

  /// Moves `state`, which must obey the supports at its own time, to the equilibrium at `time`; `report` is
  /// called after every iteration. Returns false, with `state` as it was, if Newton's method failed;
  /// `failure()` then says why, and `advice()` what to do.
  bool solve(double time, State &state, const Report &report);

  const std::string &failure() const { return complaint.what; }
  const std::string &advice() const { return complaint.next_step; }
  unsigned int n_iterations() const { return total_iterations; }

  /// 0, or, where points of integration and bodies followed each other around, by how much new points last
  /// disturbed an equilibrium, relative like the tolerance: an error of integration.
  double renewal_residual() const { return disturbance; }

  std::string linear_solver_name() const { return system.linear_solver_name(); }

  /// Forces that the supports exert at the last equilibrium, on supported entries only [N].
  const Vector &reactions() const { return balance.reactions(); }

  /// Brings forces and reactions to `state` (collective), as after a step that was given up.
  void take_stock(const State &state) { balance.compute(state); }

  /// What is remembered from one equilibrium to the next, for boost's archives.
  template <typename Archive>
  void serialize(Archive &archive, unsigned int /*version*/)
  {
    archive &balance;
  }

private:
  enum class Way
  {
    straight,
    by_soft_contact ///< where that helps, see approach()
  };
  void find_equilibrium(double time, Way way, State &state, const Report &report);
  /// Newton's method with the present points of integration, until every body's relative residual is within
  /// the tolerance. Returns whether it stopped falling before, at round-off. Throws NumericalError.
  bool find_minimum(double tolerance, State &state, NewtonReport &progress, const Report &report);
  /// One iteration of it, from the forces last judged. Throws NumericalError.
  void iterate(double residual_before, double tolerance, State &state, NewtonReport &progress);
  /// Brings a state that Newton's method cannot improve much in one iteration near the equilibrium, by
  /// contact that is soft first and ever stiffer; others stay as they are.
  void approach(State &state, NewtonReport &progress, const Report &report);
  /// The stages of approach(), up to the contact that is asked for. Throws NumericalError, also for bodies
  /// that lie too deep in each other on the way.
  void stiffen_contact(double penalty_factor, State &state, NewtonReport &progress, const Report &report);
  void set_penalty_factor(double penalty_factor) const;
  /// Lets the points of integration follow the bodies.
  void renew_terms(const State &state);
  /// Throws NumericalError with what is known of the body farthest from equilibrium.
  [[noreturn]] void give_up(const std::string &why, const std::string &advice) const;

  /// What holds bodies that nothing touches [N/m].
  Vector make_regularization() const;
  std::unique_ptr<LinearSolver> choose_linear_solver() const;

  /// How exactly to solve the linear system of an iteration, relative.
  double forcing(double residual, double residual_before, double tolerance) const;
  /// Newton's direction for the present forces. Returns the number of linear iterations. Throws
  /// NumericalError.
  unsigned int compute_increment(double residual, double linear_tolerance, Vector &increment);
  /// What the supports' increments alone bring. Throws NumericalError.
  void predict(Vector &increment);
  void move_supports(double time, State &state);
  double limit_of_step(const Vector &increment) const;
  double search_along(const Vector &increment, State &state);

  const Discretization<dim> *discretization;
  const SupportedDofs<dim> *supports;
  const Scene<dim> *scene;
  std::vector<bool> is_body_held;
  const SceneForces<dim> *forces;
  QuasiStaticParameters parameters;
  RunTime *run_time;

  ForceBalance<dim> balance;
  NewtonSystem<dim> system;
  ContactTangent tangent = ContactTangent::exact; ///< of the last iteration
  double longest_step = 0.;                       ///< no node moves farther in one iteration [m]; 0: no limit
  double disturbance = 0.;
  Complaint complaint{""};
  unsigned int total_iterations = 0;
  bool was_softened = false; ///< contact, in the present solve()
};
} // namespace signorini
