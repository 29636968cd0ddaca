// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/base/run_time.h"
#include "signorini/discretization/supports.h"
#include "signorini/discretization/surface_map.h"
#include "signorini/solvers/linear_solver.h"
#include "signorini/solvers/scene_forces.h"

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
/// the exact tangent and a line search on the energy.
///
/// A body that its supports leave free to move is held by contact. Where it is not (yet) touching, the
/// tangent is singular; the tangent alone, not the forces, then gets a diagonal term a millionth as stiff as
/// the body, which bends the way to the solution but not the solution.
template <int dim>
class QuasiStaticSolver
{
public:
  /// The arguments must outlive this object. `map` is null in scenes without contact.
  QuasiStaticSolver(const Discretization<dim> &discretization, const SupportedDofs<dim> &supports,
                    const std::vector<MaterialParameters> &materials, const std::vector<bool> &is_body_held,
                    SceneForces<dim> &forces, const SurfaceMap<dim> *map,
                    const QuasiStaticParameters &parameters, RunTime &run_time);

  /// Moves `state`, which must obey the supports at its own time, to the equilibrium at `time`; `report` is
  /// called after every iteration. Returns false, with `state` as it was, if Newton's method failed;
  /// `failure()` then says why.
  bool solve(double time, State &state, const std::function<void(const NewtonReport &)> &report);

  const std::string &failure() const { return reason; }
  unsigned int n_iterations() const { return total_iterations; }
  /// What the points of integration made at the last equilibrium leave of it, relative like the tolerance:
  /// above that where they keep disturbing it, an error of integration.
  double renewal_residual() const { return residual_after_renewal; }

  std::string linear_solver_name() const { return linear_solver->name(); }

  /// Forces that the supports exert at the last equilibrium, on supported entries only [N].
  const Vector &reactions() const { return support_forces; }

private:
  bool iterate(double time, State &state, const std::function<void(const NewtonReport &)> &report);
  void compute_residual(const State &state);
  std::vector<double> body_norms(const Vector &values) const;
  void judge_bodies(const State &state);
  double relative_residual(const State &state);
  bool is_within(double tolerance, bool has_stagnated) const;
  double total_energy() const;
  enum class DrivenBy
  {
    supports, ///< their increments alone
    residual
  };

  /// Returns whether any support moves between the two times.
  bool make_constraints(double old_time, double time);
  void rebuild_matrix();
  void assemble(DrivenBy cause);
  unsigned int compute_increment(DrivenBy cause, Vector &increment);
  void move_supports(double time, State &state);
  /// Within the tolerance; or, where the residual stopped falling, within what round-off lets it be evaluated
  /// to.
  bool has_converged(const State &state, double error, double error_before);
  double limit_of_step(const Vector &increment) const;
  double search_along(const Vector &increment, State &state);
  unsigned int n_searches() const;

  const Discretization<dim> *discretization;
  const SupportedDofs<dim> *supports;
  const std::vector<MaterialParameters> *materials;
  SceneForces<dim> *forces;
  const SurfaceMap<dim> *map;
  QuasiStaticParameters parameters;
  RunTime *run_time;
  std::vector<std::shared_ptr<ForceTerm>> terms;
  std::unique_ptr<LinearSolver> linear_solver;

  Vector residual, support_forces, regularization;
  std::vector<double> scales;                               ///< of every body's forces [N]
  std::vector<double> relative_residuals, round_off_shares; ///< of every body at the last judgement
  double residual_after_renewal = 0.;
  unsigned int n_renewal_rounds = 0;
  dealii::AffineConstraints<double> constraints;
  TangentSystem system;
  unsigned int n_searches_of_matrix = static_cast<unsigned int>(-1);
  double longest_step = 0.; ///< no node moves farther in one iteration [m]; 0: no limit
  std::string reason;
  unsigned int total_iterations = 0;
};
} // namespace signorini
