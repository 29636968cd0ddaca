// SPDX-License-Identifier: LGPL-2.1-or-later
// The loop over load steps.
#include "signorini/simulation/simulation.h"

#include "signorini/base/exceptions.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace signorini
{
namespace
{
std::string describe_iteration(double time, const NewtonReport &report)
{
  // A residual of exactly 0 says that every body's is round-off; new points of contact may raise it again.
  const std::string residual =
      report.residual == 0. ? "residual round-off" : fmt::format("residual {:.2e}", report.residual);
  const std::string start = fmt::format("load {:.5g}  iteration {:2d}  {}", time, report.iteration, residual);
  return report.iteration == 0 ? start
                               : fmt::format("{}  step {:.3g}  linear iterations {}", start,
                                             report.step_length, report.linear_iterations);
}
} // namespace

template <int dim>
void Simulation<dim>::make_quasi_static_solver()
{
  quasi_static_solver = std::make_unique<QuasiStaticSolver<dim>>(
      *discretization, *supports, scene, is_body_held, forces, surface_map.get(),
      std::get<QuasiStaticParameters>(parameters.solver), run_time);
}

template <int dim>
std::optional<Complaint> Simulation<dim>::solve_load_step(double time)
{
  const State before = state;
  const double penalty_factor_before = results.penalty_factor;
  const std::optional<double> change_before = results.correction_change;
  const ErrorEstimate estimate_before = results.estimate;
  std::optional<Complaint> fault = find_equilibrium(time);
  if (!fault && surface_map && !parameters.contact->penalty_factor)
    fault = choose_penalty_factor(time);
  if (!fault && correction && !parameters.adaptivity)
    fault = correct_contact(time);
  if (!fault)
  {
    accept_yielding();
    for (const auto &friction : forces.frictions)
      results.energy.rubbed_off += friction->commit();
    return {};
  }
  state = before;
  results.correction_change = change_before;
  results.estimate = estimate_before;
  if (results.penalty_factor != penalty_factor_before)
    set_penalty_factor(penalty_factor_before);
  return fault;
}

template <int dim>
void Simulation<dim>::accept_yielding()
{
  forces.elasticity->update(state);
  results.energy.plastic_work += forces.elasticity->commit();
}

template <int dim>
std::optional<Complaint> Simulation<dim>::find_equilibrium(double time)
{
  constexpr double largest_disturbance = 0.1;
  const double share = state.time / std::get<QuasiStaticParameters>(parameters.solver).end_time;
  const unsigned int n_before = quasi_static_solver->n_iterations();
  const bool is_solved = quasi_static_solver->solve(
      time, state,
      [&](const NewtonReport &report) { progress.step(describe_iteration(time, report), share); });
  results.n_iterations += quasi_static_solver->n_iterations() - n_before;
  if (!is_solved)
    return Complaint(quasi_static_solver->failure()).advise(quasi_static_solver->advice());
  std::optional<Complaint> fault = find_deep_penetration(measure_terms());
  const double disturbance = quasi_static_solver->renewal_residual();
  if (!fault && disturbance > largest_disturbance)
    fault = Complaint(
                fmt::format("points of integration that follow the bodies around change the forces by {:.1g}",
                            disturbance))
                .advise("refine, or set Contact/Integration = face quadrature");
  if (!fault && disturbance > 0.)
    progress.say(fmt::format(
        "load {:.5g}: points of integration follow the bodies around, which leaves an error of {:.1e} of the "
        "forces",
        time, disturbance));
  return fault;
}

template <int dim>
void Simulation<dim>::begin_quasi_static_records()
{
  make_quasi_static_solver();
  progress.say("Linear solver: " + quasi_static_solver->linear_solver_name());
  for (const auto &friction : forces.frictions)
    friction->update(discretization->make_vector()); // nothing has moved yet
  estimate_error();
  record_quasi_static();
  write_fields();
  // Bodies that lie in each other at the start are not in equilibrium yet.
  results.max_penetration = results.max_penetration_over_thickness = 0.;
  results.max_pressure = results.max_area = 0.;
}

template <int dim>
void Simulation<dim>::halve_load_step(double time, double smallest_step, const Complaint &fault)
{
  step_length *= 0.5;
  progress.say(fmt::format("load {:.5g}: {}; trying half the step", time, fault.what));
  if (!(step_length < smallest_step))
    return;
  if (time_of_fields < state.time)
  {
    quasi_static_solver->take_stock(state);
    write_fields();
  }
  throw NumericalError(
      Complaint(fmt::format("no equilibrium beyond load parameter {:.6g}: {}", state.time, fault.what))
          .at(fault.where)
          .expected(fault.allowed)
          .advise(fault.next_step));
}

template <int dim>
std::optional<Complaint> Simulation<dim>::step_towards(double end_of_load_step, double end)
{
  constexpr double round_off = 1e-9;
  const double way = end_of_load_step - state.time;
  if (way > step_length * (1. + round_off))
    return solve_load_step(state.time + step_length);
  const std::optional<Complaint> fault = solve_load_step(end_of_load_step);
  const double beyond = std::min(end, state.time + step_length);
  if (!fault || beyond - state.time <= way * (1. + round_off) || solve_load_step(beyond))
    return fault;
  warn(fmt::format("no equilibrium was found at the end of the load step at {:.6g}, but at {:.6g}: {}",
                   end_of_load_step, beyond, fault->what));
  return {};
}

template <int dim>
void Simulation<dim>::run_quasi_static()
{
  const auto &solver_parameters = std::get<QuasiStaticParameters>(parameters.solver);
  const double end = solver_parameters.end_time, largest_step = end / solver_parameters.load_steps;
  const double smallest_step = largest_step * std::pow(0.5, solver_parameters.max_bisections);
  if (!is_resumed)
  {
    begin_quasi_static_records();
    step_length = largest_step;
  }
  else if (refinement_cycle)
    estimate_error();
  const auto n_load_steps_done = [&]() { return std::floor(state.time / largest_step + 1e-9); };
  while (refinement_cycle || state.time < end * (1. - 1e-12))
  {
    if (!refinement_cycle)
    {
      save_when_due();
      check_interruption(
          [this]()
          {
            save();
            if (time_of_fields < state.time)
              write_fields();
          });
      const double n_load_steps_before = n_load_steps_done();
      begin_load_step();
      // However short steps became on the way, the load steps of the file end where it says.
      const double end_of_load_step = std::min(end, (n_load_steps_before + 1.) * largest_step);
      if (const std::optional<Complaint> fault = step_towards(end_of_load_step, end))
      {
        step_length = std::min(step_length, end_of_load_step - state.time);
        halve_load_step(state.time + step_length, smallest_step, *fault);
        continue;
      }
      ++results.n_steps;
      // Halved steps make one load step of the file: so many cycles as it asks for, unless contact needs
      // them.
      estimate_error();
      if (parameters.adaptivity &&
          (n_load_steps_done() > n_load_steps_before || results.estimate.is_any_contact_unseen))
        refinement_cycle = 0;
    }
    if (refinement_cycle)
      adapt_to_load();
    record_quasi_static();
    say_equilibrium(end);
    if (is_due(next_field, parameters.output.n_fields, end))
      write_fields();
    step_length = std::min(largest_step, 2. * step_length);
  }
}

template <int dim>
void Simulation<dim>::say_equilibrium(double end)
{
  if (results.has_contact && results.contact.n_active == 0)
    progress.say(fmt::format("load {:.5g}: equilibrium, nothing touches", state.time));
  else
    progress.step(fmt::format("load {:.5g}  equilibrium  points in contact {}  penetration/h {:.2e}",
                              state.time, results.contact.n_active,
                              results.contact.max_penetration_over_thickness),
                  state.time / end);
}

template <int dim>
void Simulation<dim>::record_quasi_static()
{
  record_state();
  record_support_forces(quasi_static_solver->reactions());
  results.energy.elastic = forces.elasticity->energy();
  results.energy.contact = 0.;
  for (const auto &term : forces.contacts)
    results.energy.contact += term->energy();
  for (const auto &friction : forces.frictions)
    results.energy.contact += friction->energy();

  const std::string joules = dim == 2 ? " [J/m]" : " [J]";
  Statistics::Row row{{"load parameter [s]", state.time},
                      {"elastic energy" + joules, results.energy.elastic}};
  if (forces.elasticity->has_plasticity())
    row.emplace_back("plastic work since the start" + joules, results.energy.plastic_work);
  if (results.has_contact)
  {
    row.emplace_back("contact energy" + joules, results.energy.contact);
    if (!forces.frictions.empty())
      row.emplace_back("rubbed off since the start" + joules, results.energy.rubbed_off);
    append_contact(row);
  }
  append_resultants(row);
  append_bodies(row);
  const ErrorEstimate &estimate = results.estimate;
  row.emplace_back("estimated discretization error [1]", estimate.relative(estimate.discretization));
  row.emplace_back("estimated contact error [1]", estimate.relative(estimate.contact));
  row.emplace_back("Newton iterations since the start [1]", results.n_iterations);
  if (statistics)
    statistics->write(row);
}

template class Simulation<2>;
template class Simulation<3>;
} // namespace signorini
