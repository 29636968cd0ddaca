// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/adaptivity/cell_work.h"
#include "signorini/adaptivity/contact_correction.h"
#include "signorini/adaptivity/error_estimator.h"
#include "signorini/adaptivity/motion_marking.h"
#include "signorini/base/exceptions.h"
#include "signorini/base/heap.h"
#include "signorini/base/run_time.h"
#include "signorini/discretization/supports.h"
#include "signorini/discretization/surface_map.h"
#include "signorini/output/checkpoint.h"
#include "signorini/output/fields.h"
#include "signorini/output/results.h"
#include "signorini/output/statistics.h"
#include "signorini/parameters/parameter_text.h"
#include "signorini/simulation/progress.h"
#include "signorini/solvers/explicit_solver.h"
#include "signorini/solvers/implicit_solver.h"
#include "signorini/solvers/quasi_static_solver.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace signorini
{
/// Builds everything from the parameters and owns the loop. The only place that sees everything, and the only
/// one that asks what a scene has: what it has not is not built.
template <int dim>
class Simulation
{
public:
  /// `text`: where the parameters stand, for messages and reports; must outlive this object. Throws
  /// InputError for scenes that cannot be run.
  Simulation(const ParameterText &text, const Parameters &parameters, const MPI_Comm &communicator,
             bool is_quiet);

  /// What would be done, at what size and cost.
  void print_plan();

  /// Makes this the run that was stopped at the last good checkpoint of Output/Directory, where run() will go
  /// on. Throws InputError if the parameters are not those of that run, and FileError. Once only, before
  /// run().
  void resume();

  /// Runs, writing into Output/Directory. Throws NumericalError, also for a run that is interrupted, after
  /// the last good output is written, and FileError.
  void run();

private:
  /// All that stands on the present mesh.
  void build_on_mesh();
  void build_contact();
  /// Throws InputError for an obstacle that could pass between the points of a body's faces.
  void check_obstacle_sizes() const;
  void check_initial_overlap();
  void list_parts();

  void run_quasi_static();
  void begin_quasi_static_records();
  /// Throws NumericalError where the load step that failed cannot be halved.
  void halve_load_step(double time, double smallest_step, const Complaint &fault);
  void run_explicit(const ExplicitParameters &solver_parameters);
  void run_implicit(const ImplicitParameters &solver_parameters);
  void make_implicit_solver();
  /// Returns why the step failed or must be shorter, with the state as it was.
  std::optional<Complaint> make_implicit_step(double time_step, bool may_be_unsteady);
  /// Whether there is inertia.
  bool is_in_motion() const { return !std::holds_alternative<QuasiStaticParameters>(parameters.solver); }
  /// Finds the equilibrium and accepts what it slid and yielded on the way; returns why there is none, with
  /// the state as it was.
  std::optional<Complaint> solve_load_step(double time);
  /// Goes on by the present length of steps, no farther than the load step goes; where just its end has no
  /// equilibrium, past it, with a warning. Returns why there is none.
  std::optional<Complaint> step_towards(double end_of_load_step, double end_time);
  /// Lets points remember how they yielded up to the present equilibrium.
  void accept_yielding();
  /// The parts of solve_load_step(); they return why they failed.
  std::optional<Complaint> find_equilibrium(double time);
  std::optional<Complaint> correct_contact(double time);
  std::optional<Complaint> choose_penalty_factor(double time);
  void set_penalty_factor(double penalty_factor);
  /// The next of equal steps to the end, as few as are stable.
  double next_time_step(double end_time) const;
  /// Takes down the first row and fields of a run in motion.
  void begin_records(MotionSolver<dim> &solver, double end_time);
  /// Rows and fields are written by the first step that reaches their time: outputs do not shape the steps.
  void record_when_due(MotionSolver<dim> &solver, double time_step, double end_time);
  void record_motion(const MotionSolver<dim> &solver, double time_step, double end_time);
  /// How far the energy ledger may be open in a run in motion, and what closes it.
  struct LedgerLimit
  {
    double tolerance; ///< of the largest energy
    std::string advice;
  };
  LedgerLimit find_ledger_limit() const;
  /// Throws NumericalError for an energy that is no number, and for a ledger that does not close.
  void check_ledger() const;
  /// The first of `n` equal spans to the end time (of one, if none) whose end is later than `time`.
  static unsigned int next_output(double time, unsigned int n, double end_time);
  /// Whether the end of the span `next` of these has come; sets it to the one that is next.
  bool is_due(unsigned int &next, unsigned int n, double end_time) const;
  /// Writes or reads all that the rest of the run depends on. Throws FileError.
  template <typename Archive>
  void archive_run(Archive &archive);
  /// Writes a checkpoint where the file asks for them; the state must be the end of an accepted step.
  void save();
  void save_when_due();
  /// Makes the mesh of these cells and what stands on it, without a past. Throws FileError if it does not
  /// have as many of this rank's degrees of freedom as given.
  void build_as_saved(const std::vector<dealii::CellId::binary_type> &hexahedron_ids,
                      std::size_t n_owned_dofs);
  /// Throws FileError unless the nodes are where those of the checkpoint were (collective).
  void check_same_nodes(const Vector &saved) const;
  void make_explicit_solver();
  /// Whether the contact forces of every step are solved for.
  bool has_implicit_contact() const;
  /// Shares an adapted mesh out by the work of its cells, and builds what stands on it anew, where that pays.
  void balance_work(const std::vector<Vector *> &values, PointValues &memory);
  bool is_adaptation_due(double time_step) const;
  /// Flags cells for what is to come within `duration`; whether there are any.
  bool mark_in_motion(double duration, OtherCells others);
  /// Adapts the mesh in the middle of the run, `time_step` being the step that would be next.
  void adapt_in_explicit_run(double time_step);
  void record_quasi_static();
  /// Refines the mesh and finds the equilibrium anew until the estimated error or the cycles end it.
  void adapt_to_load();
  void say_mesh(unsigned int cycle);
  /// Throws NumericalError for a fault found on a refined mesh.
  void check_adapted(const std::optional<Complaint> &fault) const;
  void adapt_mesh();
  /// Keeps the present state as the one that the load step starts from; those of adapted meshes start there
  /// again.
  void begin_load_step();
  void make_quasi_static_solver();
  void say_equilibrium(double end_time);
  /// How far any node or obstacle may move in a step from the present state, both together [m].
  double largest_motion(double time_step) const;
  /// The part of a step in which points cannot jump over what they ought to touch. Throws NumericalError
  /// where hardly anything is left of it.
  double limit_time_step(double time_step) const;
  /// Of each term of contact.
  using MeasuresOfTerms = std::vector<contact::ContactMeasures<dim>>;
  /// The penetration of a term of contact that stops the run, over the size of an element.
  double penetration_limit(std::size_t term) const;
  /// Whether points are so deep that they could pass through. Warns once when the first are half as deep.
  std::optional<Complaint> find_deep_penetration(const MeasuresOfTerms &measures);
  /// At the last update of the terms (collective).
  MeasuresOfTerms measure_terms() const;
  /// Of all terms together (collective).
  contact::ContactMeasures<dim> measure_contact() const { return merge(measure_terms()); }
  static contact::ContactMeasures<dim> merge(const MeasuresOfTerms &measures);
  /// Takes a state that is part of the run into the results and their peaks.
  void record_contact(const MeasuresOfTerms &measures);
  /// The slips of all frictions as they were last accepted, for those on another mesh (collective).
  std::vector<std::vector<contact::PlacedSlip<dim>>> place_slips() const;
  void remember_slips(std::vector<std::vector<contact::PlacedSlip<dim>>> slips);
  void record_bodies(const contact::PairForces<dim> &pair_forces);
  void record_contact_forces(const contact::PairForces<dim> &pair_forces);
  void record_support_forces(const Vector &reactions);
  void record_state();
  void set_initial_motion();
  void check_start(const typename SupportedDofs<dim>::Entry &entry) const;
  void measure_bodies();
  void estimate_error();
  /// Once, where a corner lies too deep for what the contact feels of it (collective).
  void warn_of_unseen_contact();
  void write_fields();
  /// Of the surface that contact pressures are known on; null where there are none.
  const SurfaceMap<dim> *map_of_pressures() const;
  void append_contact(Statistics::Row &row) const;
  void append_resultants(Statistics::Row &row) const;
  void append_bodies(Statistics::Row &row) const;
  /// Once a signal has come: writes what is still to be written and throws NumericalError.
  void check_interruption(const std::function<void()> &write);
  void warn(const std::string &warning);
  /// Reports, and throws the failure, or what the comparison with the exact solution finds.
  void finish(std::optional<NumericalError> failure);
  void gather_results();
  /// What ranks hold and send (collective).
  void measure_distribution();
  /// Takes the run apart and notes by how much the heap shrinks with each part (collective). The last thing
  /// done before the report.
  void weigh_parts();
  void gather_samples();
  void gather_nodal_pressures();
  void gather_extremes();
  void print_results();
  /// The parts' run times and memory.
  void print_costs();
  void warn_of_many_steps(double n_steps, const std::string &advice);
  /// Of a body that has turned though its law is not made for that.
  void warn_of_turns();
  void warn_of_open_ledger();
  /// Where pressure stands on points that are fewer than those of a face.
  void warn_of_lone_points();
  /// Of the first in which two passed through each other.
  void warn_of_collisions();
  void print_collisions();
  /// The part of print_plan() on refinement.
  void plan_adaptivity();
  double memory_mb() const;

  /// What a load step starts from, on the present mesh.
  struct StepStart
  {
    State state;
    PointValues memory;
    double plastic_work = 0.; ///< since the start of the run [J; J/m in 2-D]
  };

  const std::size_t heap_before_set_up = heap_in_use(); ///< [bytes]
  Parameters parameters;
  const ParameterText *text;
  MPI_Comm communicator;
  Progress progress;
  RunTime run_time;

  Scene<dim> scene;
  std::unique_ptr<Discretization<dim>> discretization;
  std::unique_ptr<SupportedDofs<dim>> supports;
  std::unique_ptr<SurfaceMap<dim>> surface_map; ///< null without contact
  std::unique_ptr<VolumeMap<dim>> volume_map;   ///< null without the volume potential
  SceneForces<dim> forces;
  Vector nodal_volume; ///< set when the run begins
  State state;
  std::vector<bool> is_body_held;
  double largest_energy = 0.; ///< twice the largest elastic energy so far [J; J/m in 2-D]

  std::unique_ptr<ErrorEstimator<dim>> estimator;
  std::unique_ptr<ContactCorrection<dim>> correction;          ///< null unless the file asks for it
  std::unique_ptr<QuasiStaticSolver<dim>> quasi_static_solver; ///< quasi-static runs
  std::unique_ptr<ExplicitSolver<dim>> explicit_solver;        ///< explicit runs
  std::unique_ptr<ImplicitSolver<dim>> implicit_solver;        ///< implicit runs
  std::unique_ptr<FileLevels<dim>> file_levels;                ///< explicit runs with adaptivity
  unsigned int next_adaptation_step = 0;     ///< explicit runs: the mesh is adapted before this step,
  double next_adaptation_time = 0.;          ///< and before this time, to which contact has been foreseen [s]
  unsigned int next_row = 1, next_field = 1; ///< of those that 'Output' asks for
  std::optional<unsigned int> refinement_cycle; ///< of a load step that is being adapted to
  StepStart step_start;                         ///< quasi-static runs with adaptivity: of the last step
  double step_length = 0.;                      ///< quasi-static and implicit runs: that is tried next [s]
  double longest_step = 0.; ///< implicit runs: that has not opened the ledger too far yet [s]
  bool has_warned_of_depth = false, has_warned_of_unseen = false;
  double time_of_fields = 0.; ///< at which the last ones were written [s]
  std::unique_ptr<Fields<dim>> fields;
  std::unique_ptr<Statistics> statistics; ///< on rank 0
  Checkpoint checkpoint;
  bool is_resumed = false;
  std::uintmax_t statistics_size = 0; ///< of a run that is resumed: at its checkpoint, on rank 0 [bytes]
  double run_time_of_checkpoint = 0.; ///< of the last one [s]
  std::optional<double> time_of_checkpoint; ///< of the last one, none if there is none yet [s]
  Traffic traffic_of_setup;
  Results<dim> results;
};
} // namespace signorini
