// SPDX-License-Identifier: LGPL-2.1-or-later
// The loop over explicit time steps.
#include "signorini/simulation/simulation.h"

#include "signorini/base/exceptions.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace signorini
{
template <int dim>
void Simulation<dim>::run_explicit(const ExplicitParameters &solver_parameters)
{
  const double end = solver_parameters.end_time;
  if (parameters.adaptivity)
    file_levels = std::make_unique<FileLevels<dim>>(parameters.bodies);
  if (!is_resumed)
  {
    make_explicit_solver();
    explicit_solver->start(state);
    begin_records(*explicit_solver, end);
  }
  while (state.time < end)
  {
    double time_step = next_time_step(end);
    if (is_adaptation_due(time_step))
    {
      adapt_in_explicit_run(time_step);
      time_step = next_time_step(end);
    }
    explicit_solver->step(time_step, state);
    if (end - state.time < 1e-9 * time_step)
      state.time = end;
    ++results.n_steps;
    const MeasuresOfTerms measures = measure_terms();
    record_contact(measures);
    if (const std::optional<Complaint> fault = find_deep_penetration(measures))
      throw NumericalError(*fault);
    record_when_due(*explicit_solver, time_step, end);
  }
}

template <int dim>
bool Simulation<dim>::has_implicit_contact() const
{
  const auto *run = std::get_if<ExplicitParameters>(&parameters.solver);
  return run && surface_map && run->contact_stepping == ExplicitParameters::ContactStepping::implicit_forces;
}

template <int dim>
double Simulation<dim>::next_time_step(double end) const
{
  const double remaining = end - state.time, stable = limit_time_step(explicit_solver->stable_step());
  if (!(state.time + stable > state.time))
    throw NumericalError(Complaint(fmt::format("the stable time step vanishes at t = {:.6g}", state.time))
                             .found(fmt::format("{} s", stable))
                             .advise("look at the last fields for a crushed cell; refine, or lower "
                                     "Contact/Penalty factor"));
  return remaining / std::max(1., std::ceil(remaining / stable - 1e-9));
}

template class Simulation<2>;
template class Simulation<3>;
} // namespace signorini
