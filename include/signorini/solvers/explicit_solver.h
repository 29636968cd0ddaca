// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/base/run_time.h"
#include "signorini/discretization/supports.h"
#include "signorini/physics/internal_force.h"
#include "signorini/physics/momentum.h"
#include "signorini/solvers/bulk_bound.h"
#include "signorini/solvers/critical_step.h"
#include "signorini/solvers/implicit_contact.h"
#include "signorini/solvers/motion_solver.h"
#include "signorini/solvers/scene_forces.h"

namespace signorini
{
/// Velocity Verlet with a lumped mass:
///
///   v_(n+1/2) = v_n + Δt/2 a_n,   u_(n+1) = u_n + Δt v_(n+1/2),   a_(n+1) = M⁻¹ f(u_(n+1), v_(n+1/2)),
///   v_(n+1) = v_(n+1/2) + Δt/2 a_(n+1).
///
/// Every force is booked: works and impulses by the trapezoidal rule, which is exact for momenta in this
/// scheme.
///
/// With implicit contact f is that of the bodies and loads alone, contact moves u_(n+1) and v_(n+1/2)
/// (ImplicitContact), and the kinetic energy is the one of the scheme, ½ v_n·M v_n − Δt²/8 f_n·M⁻¹ f_n.
/// Outside of step(), velocities contain half a step of the last contact forces, which stands for the half of
/// the next step that has begun: so a body at rest under a load has none.
template <int dim>
class ExplicitSolver : public MotionSolver<dim>
{
public:
  /// The arguments must outlive this object.
  ExplicitSolver(const Discretization<dim> &discretization, const SupportedDofs<dim> &supports,
                 const std::vector<MaterialParameters> &materials, SceneForces<dim> &forces,
                 const ExplicitParameters &parameters, RunTime &run_time);

  /// Computes the first forces and opens the ledgers.
  void start(State &state);

  /// The same in the middle of a run whose mesh has changed: carries on the ledgers of the solver on the old
  /// mesh, brought up to the present, and books by how much the energies jumped. `momentum_change`: by how
  /// much the change of the mesh took the momenta elsewhere than round-off would.
  void resume(const ExplicitSolver &before, const VectorAndMoment &momentum_change, State &state);

  /// Largest step that is stable from the present state on, with its factors [s].
  double stable_step() const;

  void step(double time_step, State &state);

  /// Takes the half step of contact forces out of the velocities again, before the mesh changes.
  void suspend(State &state);

  void take_stock(const State &state) override;

  /// What is remembered from step to step, for boost's archives.
  template <typename Archive>
  void serialize(Archive &archive, unsigned int version)
  {
    MotionSolver<dim>::serialize(archive, version);
    archive &force &load_force &damping_force &viscous_force &external &obstacle_forces;
    archive &half_step_of_contact &last_time_step &n_steps;
    archive &bulk_bound &contact_bound &n_searches_of_bound;
    if (implicit_contact)
      archive &*implicit_contact;
  }

private:
  using MotionSolver<dim>::energy_ledger;

  /// Velocities by half a step of accelerations by these forces.
  void kick(double time_step, const Vector &by, Vector &velocity) const;
  /// Computes the first forces and the energies and momenta with them.
  void begin(State &state);
  void compute_forces(const State &state, const Vector &velocity);
  void compute_contact_forces(const State &state, const Vector &velocity);
  void compute_viscous_forces(const State &state, const Vector &velocity);
  void compute_load_forces(const State &state);
  void book_step(const State &state, double time_step);
  void book_supports(const State &state, double time_step);
  /// Δt²/8 f·M⁻¹ f, by which the scheme's kinetic energy is less than that of v_n if the steps around t_n
  /// have this length [J] (collective).
  double compute_energy_between_steps(double time_step) const;
  void move_by_contact(double time_step, State &state);
  void add_half_step_of_contact(State &state);
  void book_obstacles();

  const Discretization<dim> *discretization;
  const SupportedDofs<dim> *supports;
  const std::vector<MaterialParameters> *materials;
  SceneForces<dim> *forces;
  ExplicitParameters parameters;
  RunTime *run_time;

  Vector mass, inverse_mass; ///< the latter is zero where there is none
  Vector force, load_force, damping_force, viscous_force, external_force;
  Vector old_force, old_load_force, old_damping_force, old_viscous_force;
  Vector old_displacement, old_velocity, increment;
  std::unique_ptr<ImplicitContact<dim>> implicit_contact; ///< null where contact is explicit or there is none
  Vector half_step_of_contact;                            ///< that is in the velocities [m/s]
  double last_time_step = 0.;                             ///< [s]
  std::vector<contact::ObstacleForces<dim>> obstacle_forces, old_obstacle_forces; ///< of the moving contacts
  std::vector<double> half_velocity_of_supports;
  std::vector<unsigned int> dofs_of_supported_nodes; ///< local indices, free components included
  VectorAndMoment external, old_external;
  bool has_external_forces = false, has_work = false; ///< forces that are booked over the step's increments
  BulkBound<dim> bulk_bound;
  unsigned int n_steps = 0;
  mutable ContactBound contact_bound;
  mutable unsigned int n_searches_of_bound = 0;
};
} // namespace signorini
