// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/base/run_time.h"
#include "signorini/discretization/supports.h"
#include "signorini/solvers/linear_solver.h"
#include "signorini/solvers/scene_forces.h"

#include <optional>
#include <utility>

namespace signorini
{
/// The linear systems of Newton's method: the tangent of all terms and frictions and the constraints of
/// supports and hanging nodes that it is assembled under.
///
/// Tangents that no state changes (ForceTerm::has_constant_tangent()) are assembled once.
template <int dim>
class NewtonSystem
{
public:
  /// The arguments must outlive this object, `solver` is kept. `regularization`: what the diagonal of the
  /// tangent gets besides [N/m].
  NewtonSystem(const Discretization<dim> &discretization, const SupportedDofs<dim> &supports,
               const SceneForces<dim> &forces, const std::vector<std::shared_ptr<ForceTerm>> &terms,
               Vector regularization, std::unique_ptr<LinearSolver> solver, RunTime &run_time);

  /// Constrains increments to those of the supports between the two times. Returns whether any moves.
  bool constrain(double old_time, double time);

  /// Solves K Δu = `forces` [N] to a relative residual of `tolerance` at the state that the terms were last
  /// updated to (collective). Returns the number of linear iterations; nothing where the tangent was seen not
  /// to be positive definite, with `increment` undefined. Throws NumericalError.
  std::optional<unsigned int> solve(const Vector &forces, ContactTangent kind, double tolerance,
                                    Vector &increment);

  /// How often neighbours were searched: the terms are other functions of the positions after each.
  unsigned int n_searches() const;

  std::string linear_solver_name() const { return linear_solver->name(); }

private:
  /// Gives a system zeros for the couplings within cells and those of the terms.
  void prepare(const std::vector<std::shared_ptr<ForceTerm>> &coupling_terms, TangentSystem &system) const;
  void rebuild_matrix();
  void assemble_constant_part();
  void assemble(const Vector &forces, ContactTangent kind);
  std::vector<double> owned_diagonal() const; ///< of the matrix [N/m]
  /// Compares with the diagonal of the assembled matrix.
  void find_stiff_rows(const std::vector<double> &diagonal_without_contact);

  const Discretization<dim> *discretization;
  const SupportedDofs<dim> *supports;
  const SceneForces<dim> *scene_forces;
  const std::vector<std::shared_ptr<ForceTerm>> *terms;
  Vector regularization;
  std::unique_ptr<LinearSolver> linear_solver;
  RunTime *run_time;

  dealii::IndexSet relevant_dofs; ///< to this rank's cells, or to contact
  std::pair<double, double> times_of_constraints;
  bool do_supports_move = false;
  dealii::AffineConstraints<double> constraints;
  TangentSystem system;
  dealii::IndexSet stiff_rows; ///< of `system` that contact makes stiffer than the elements do
  TangentSystem constant_part; ///< its right hand side stays 0; empty until it is assembled
  unsigned int n_searches_of_matrix = static_cast<unsigned int>(-1);
};
} // namespace signorini
