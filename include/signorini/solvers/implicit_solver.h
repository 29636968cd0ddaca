// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/physics/momentum.h"
#include "signorini/physics/step_inertia.h"
#include "signorini/solvers/motion_solver.h"
#include "signorini/solvers/quasi_static_solver.h"

namespace signorini
{
/// Implicit steps: the midpoint rule for bodies and loads, contact by its forces at the end of the step,
///
///   M (v_(n+1) − v_n)/Δt = f((u_n + u_(n+1))/2) + f_c(u_(n+1)),   (u_(n+1) − u_n)/Δt = (v_n + v_(n+1))/2,
///
/// (C. Kane, E. A. Repetto, M. Ortiz, J. E. Marsden, 1999, for contact). The end of a step is the minimum of
/// an energy with inertia, found as equilibria are. For linear bodies energy never grows at any Δt: contact
/// at fixed normals only takes (doc/theory.md). Forces of contact act where the points are in the middle of
/// the step, so that they leave the angular momentum alone.
template <int dim>
class ImplicitSolver : public MotionSolver<dim>
{
public:
  using Report = typename QuasiStaticSolver<dim>::Report;

  /// The arguments must outlive this object. `map` is null in scenes without contact.
  ImplicitSolver(const Discretization<dim> &discretization, const SupportedDofs<dim> &supports,
                 const Scene<dim> &scene, const SceneForces<dim> &forces, const SurfaceMap<dim> *map,
                 const ImplicitParameters &parameters, RunTime &run_time);

  /// Opens the ledgers.
  void start(State &state);

  /// Moves `state` by a step. Returns why that failed, with `state` as it was.
  std::optional<Complaint> step(double time_step, State &state, const Report &report);

  /// Books the last step, or puts `state` back to where it began.
  void accept(const State &state);
  void reject(State &state);

  /// By how much the velocities changed otherwise in the last step than in the accepted one before it, over
  /// the largest velocity so far (root mean squares by mass): the part of the motion that the step is too
  /// long for.
  double unsteadiness() const { return change_of_rate; }

  /// By how much the last step opens the energy ledger, whatever the sign, over the largest energy so far:
  /// what the forces of its middle missed of the change of the elastic energy. 0 where bodies yield.
  double opening() const { return energy_opening; }

  void take_stock(const State &state) override;

  unsigned int n_iterations() const { return newton.n_iterations(); }
  std::string linear_solver_name() const { return newton.linear_solver_name(); }

  /// What is remembered from step to step, for boost's archives.
  template <typename Archive>
  void serialize(Archive &archive, unsigned int version)
  {
    MotionSolver<dim>::serialize(archive, version);
    archive &newton &accepted_change &accepted_time_step;
    archive &change_of_rate &largest_speed &contact_energy &elastic_energy_before;
  }

private:
  static SceneForces<dim> replace_loads(SceneForces<dim> forces,
                                        std::vector<std::shared_ptr<ForceTerm>> loads);
  static QuasiStaticParameters make_newton_parameters(const ImplicitParameters &parameters);
  Vector compute_loads(const State &state) const;
  /// Lets contact act where its points are in the middle of the step, until that changes nothing more.
  bool settle_contact(State &state, const Report &report);
  void compute_forces(const State &state);
  void compute_velocities(State &state);
  void measure_opening(const State &state);
  double norm_by_mass(const Vector &velocity) const;
  /// Lets the bodies remember how the step made them yield; returns the plastic work [J; J/m in 2-D].
  double commit_yielding(const State &state);
  void book_obstacles(const State &state);
  void book_supports(const State &state);

  const Discretization<dim> *discretization;
  const SupportedDofs<dim> *supports;
  const SceneForces<dim> *forces;
  Vector mass;
  std::shared_ptr<StepInertia<dim>> inertia;
  std::shared_ptr<ConstantForce<dim>> impulse; ///< of loads and of the velocity at the start
  SceneForces<dim> step_forces;                ///< with these two for loads
  QuasiStaticSolver<dim> newton;

  State before;
  double time_step = 0., accepted_time_step = 0.; ///< [s]
  Vector load_force, inner_force, contact_force, outer_contact_force;
  Vector change, accepted_change; ///< of the velocities in a step [m/s]
  double change_of_rate = 0., largest_speed = 0.;
  double contact_energy = 0., contact_energy_before = 0.;
  double elastic_energy = 0., elastic_energy_before = 0.; ///< of bodies of which none yields [J]
  double energy_opening = 0.;
};
} // namespace signorini
