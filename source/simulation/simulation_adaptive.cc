// SPDX-License-Identifier: LGPL-2.1-or-later
// The loop of refinement within a load step.
#include "signorini/simulation/simulation.h"

#include "signorini/adaptivity/contact_marking.h"
#include "signorini/adaptivity/marking.h"
#include "signorini/base/exceptions.h"

#include <fmt/core.h>

namespace signorini
{
template <int dim>
void Simulation<dim>::adapt_to_load()
{
  const AdaptivityParameters &adaptivity = *parameters.adaptivity;
  for (unsigned int cycle = 0;; ++cycle)
  {
    const ErrorEstimate &estimate = results.estimate;
    progress.say(
        fmt::format("load {:.5g}  mesh {}: {} cells, {} dofs, estimated error {:.3e} discretization, "
                    "{:.3e} contact",
                    state.time, cycle, results.n_cells, results.n_dofs,
                    estimate.relative(estimate.discretization), estimate.relative(estimate.contact)));
    if (cycle == adaptivity.max_cycles || results.n_dofs >= adaptivity.max_n_dofs ||
        (!estimate.is_any_contact_unseen &&
         (estimate.discretization == 0. || estimate.relative(estimate.total()) <= adaptivity.target_error)))
      return;
    adapt_mesh();
    if (const std::optional<Complaint> fault = solve_load_step(state.time))
      throw NumericalError(
          Complaint(fmt::format("no equilibrium on the refined mesh at load parameter {:.6g}: {}", state.time,
                                fault->what))
              .at(fault->where)
              .expected(fault->allowed)
              .advise(fault->next_step));
    estimate_error();
  }
}

template <int dim>
void Simulation<dim>::adapt_mesh()
{
  const auto section = run_time.enter("refinement");
  mark_cells(results.estimate, *parameters.adaptivity, *discretization);
  if (surface_map)
    level_curved_contact(estimator->boundary_faces(), estimator->contact_pressures(), *surface_map,
                         *discretization);
  discretization->adapt({&state.displacement});
  build_on_mesh();
  // New supported nodes have values between those of the old ones, not their own.
  supports->impose(state.time, state.displacement);
  discretization->distribute(state.displacement);
  make_quasi_static_solver();
  fields->set_mesh(*discretization, surface_map.get());
  measure_bodies();
}

template class Simulation<2>;
template class Simulation<3>;
} // namespace signorini
