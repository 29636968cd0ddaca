// SPDX-License-Identifier: LGPL-2.1-or-later
// The loop over load steps.
#include "signorini/simulation/simulation.h"

#include "signorini/base/exceptions.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace signorini
{
template <int dim>
void Simulation<dim>::run_quasi_static(const QuasiStaticParameters &solver_parameters)
{
  QuasiStaticSolver<dim> solver(*discretization, *supports, scene, is_body_held, forces, surface_map.get(),
                                solver_parameters, run_time);
  progress.say("Linear solver: " + solver.linear_solver_name());
  const double end = solver_parameters.end_time, largest_step = end / solver_parameters.load_steps;
  const double smallest_step = largest_step * std::pow(0.5, solver_parameters.max_bisections);
  double step = largest_step;
  write_fields();
  while (state.time < end * (1. - 1e-12))
  {
    const double time = end - state.time < step * (1. + 1e-9) ? end : state.time + step;
    const double share = state.time / end;
    const bool is_solved = solver.solve(
        time, state,
        [&](const NewtonReport &report)
        {
          progress.step(fmt::format("load {:.5g}  iteration {:2d}  residual {:.2e}  step {:.3g}  linear {}",
                                    time, report.iteration, report.residual, report.step_length,
                                    report.linear_iterations),
                        share);
        });
    results.n_iterations = solver.n_iterations();
    if (is_solved)
    {
      ++results.n_steps;
      if (solver.renewal_residual() > 0.)
        progress.say(fmt::format(
            "load {:.5g}: points of integration follow the bodies around, an error of {:.1e} of the "
            "forces",
            time, solver.renewal_residual()));
      record_quasi_static(end);
      step = std::min(largest_step, 2. * step);
      continue;
    }
    step *= 0.5;
    progress.say(fmt::format("load {:.5g}: {}; trying half the step", time, solver.failure()));
    if (step < smallest_step)
      throw NumericalError(Complaint(fmt::format("no equilibrium beyond load parameter {:.6g}: {}",
                                                 state.time, solver.failure()))
                               .advise("look at the last fields; use more load steps, or check that contact "
                                       "holds the bodies in every direction in which they are loaded"));
  }
}

template <int dim>
void Simulation<dim>::record_quasi_static(double end)
{
  const auto &contact = results.contact;
  update_contact_measures();
  check_penetration();
  Statistics::Row row{{"load parameter [s]", state.time},
                      {"elastic energy [J]", forces.elasticity->energy()}};
  double contact_energy = 0.;
  for (const auto &term : forces.contacts)
    contact_energy += term->energy();
  if (results.has_contact)
  {
    row.emplace_back("contact energy [J]", contact_energy);
    append_contact(row);
  }
  row.emplace_back("iterations [1]", results.n_iterations);
  if (statistics)
    statistics->write(row);
  if (results.has_contact && contact.n_active == 0)
    progress.say(fmt::format("load {:.5g}: nothing touches", state.time));
  else
    progress.step(fmt::format("load {:.5g}  equilibrium  pairs {}  penetration/h {:.2e}", state.time,
                              contact.n_active, contact.max_penetration_over_thickness),
                  state.time / end);
  write_fields();
}

template class Simulation<2>;
template class Simulation<3>;
} // namespace signorini
