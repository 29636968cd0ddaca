// SPDX-License-Identifier: LGPL-2.1-or-later
// The loop over implicit time steps.
#include "signorini/simulation/simulation.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace signorini
{
template <int dim>
std::optional<Complaint> Simulation<dim>::make_implicit_step(double time_step, bool may_be_unsteady)
{
  const auto &run = std::get<ImplicitParameters>(parameters.solver);
  const auto report = [&](const NewtonReport &newton)
  {
    progress.step(fmt::format("step {}  t {:.5g}  dt {:.3e}  iteration {:2d}  residual {:.2e}",
                              results.n_steps + 1, state.time, time_step, newton.iteration, newton.residual),
                  state.time / run.end_time);
  };
  const unsigned int n_before = implicit_solver->n_iterations();
  std::optional<Complaint> fault = implicit_solver->step(time_step, state, report);
  results.n_iterations += implicit_solver->n_iterations() - n_before;
  if (fault)
    return fault;
  fault = find_deep_penetration(measure_terms());
  if (!fault && !may_be_unsteady && run.step_tolerance > 0. &&
      implicit_solver->unsteadiness() > run.step_tolerance)
    fault = Complaint(fmt::format("velocities change otherwise than before by {:.2g} of the largest",
                                  implicit_solver->unsteadiness()));
  constexpr double share_of_a_step = 0.1;
  if (!fault && !may_be_unsteady && implicit_solver->opening() > share_of_a_step * run.ledger_tolerance)
  {
    // For good: where steps shorten and grow all the time, what each of them misses adds up.
    longest_step = 0.5 * time_step;
    fault = Complaint(fmt::format("the step opens the energy ledger by {:.2g} of the largest energy",
                                  implicit_solver->opening()));
  }
  if (fault)
    implicit_solver->reject(state);
  return fault;
}

template <int dim>
void Simulation<dim>::make_implicit_solver()
{
  implicit_solver =
      std::make_unique<ImplicitSolver<dim>>(*discretization, *supports, scene, forces, surface_map.get(),
                                            std::get<ImplicitParameters>(parameters.solver), run_time);
}

template <int dim>
void Simulation<dim>::run_implicit(const ImplicitParameters &run)
{
  if (!is_resumed)
  {
    make_implicit_solver();
    progress.say("Linear solver: " + implicit_solver->linear_solver_name());
    implicit_solver->start(state);
    begin_records(*implicit_solver, run.end_time);
    step_length = longest_step = run.time_step;
  }
  const double smallest_step = run.time_step * std::pow(0.5, run.max_bisections);
  while (state.time < run.end_time)
  {
    const double remaining = run.end_time - state.time;
    const double time_step = remaining / std::max(1., std::ceil(remaining / step_length - 1e-9));
    const bool is_smallest = 0.5 * time_step < smallest_step;
    if (const std::optional<Complaint> fault = make_implicit_step(time_step, is_smallest))
    {
      if (is_smallest)
      {
        Complaint end = *fault;
        end.what = fmt::format("no step of {:.3g} s and more leads beyond t = {:.6g}: {}", smallest_step,
                               state.time, fault->what);
        scene.blame_jump(state.time, state.time + time_step, end);
        throw NumericalError(end);
      }
      step_length = 0.5 * time_step;
      continue;
    }
    implicit_solver->accept(state);
    if (run.end_time - state.time < 1e-9 * time_step)
      state.time = run.end_time;
    ++results.n_steps;
    if (run.step_tolerance == 0. || implicit_solver->unsteadiness() <= 0.5 * run.step_tolerance)
      step_length = std::min(longest_step, 2. * step_length);
    record_contact(measure_terms());
    record_when_due(*implicit_solver, time_step, run.end_time);
  }
}

template class Simulation<2>;
template class Simulation<3>;
} // namespace signorini
