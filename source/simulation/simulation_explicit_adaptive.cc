// SPDX-License-Identifier: LGPL-2.1-or-later
// Refinement and coarsening in the course of an explicit run.
#include "signorini/adaptivity/motion_transfer.h"
#include "signorini/simulation/simulation.h"

#include <fmt/core.h>

namespace signorini
{
template <int dim>
void Simulation<dim>::make_explicit_solver()
{
  explicit_solver =
      std::make_unique<ExplicitSolver<dim>>(*discretization, *supports, scene.materials, forces,
                                            std::get<ExplicitParameters>(parameters.solver), run_time);
}

template <int dim>
bool Simulation<dim>::is_adaptation_due(double time_step) const
{
  return parameters.adaptivity &&
         (results.n_steps >= next_adaptation_step || state.time + time_step > next_adaptation_time);
}

template <int dim>
bool Simulation<dim>::mark_in_motion(double duration, OtherCells others)
{
  std::vector<bool> is_near_contact(discretization->cells.n_cells, false);
  if (surface_map)
    is_near_contact = find_cells_near_contact(scene, *parameters.contact, *discretization, *surface_map,
                                              estimator->boundary_faces(), *file_levels, state, duration);
  return mark_cells_in_motion(is_near_contact, others, forces.elasticity->plastic_strains(), results.estimate,
                              *parameters.adaptivity, *file_levels, *discretization);
}

template <int dim>
void Simulation<dim>::adapt_in_explicit_run(double time_step)
{
  constexpr double foresight = 1.5;
  const AdaptivityParameters &adaptivity = *parameters.adaptivity;
  const double duration = foresight * adaptivity.interval * time_step;
  next_adaptation_step = results.n_steps + adaptivity.interval;
  next_adaptation_time = state.time + duration;
  const auto section = run_time.enter("refinement");
  estimate_error();
  // An error of the stress is one beside the energy that moves and strains the bodies: a body that flies
  // freely has none, however its round-off is spread.
  const bool is_any_error = results.estimate.discretization > 1e-6 * explicit_solver->energy().largest;
  if (!mark_in_motion(duration, is_any_error ? OtherCells::by_error : OtherCells::coarser))
    return;
  explicit_solver->take_stock(state);
  explicit_solver->suspend(state);
  auto slips = place_slips();
  PointValues memory = forces.elasticity->memory();
  VectorAndMoment momentum_change;
  // Cells that contact is about to reach take all their levels at once.
  unsigned int n_rounds = 0;
  do
  {
    const VectorAndMoment change = adapt_in_motion(scene, *discretization, state, memory);
    for (unsigned int d = 0; d < 3; ++d)
    {
      momentum_change.vector[d] += change.vector[d];
      momentum_change.moment[d] += change.moment[d];
    }
    build_on_mesh();
  } while (++n_rounds < adaptivity.max_levels && mark_in_motion(duration, OtherCells::as_they_are));
  balance_work({&state.displacement, &state.velocity}, memory);
  forces.elasticity->update(state);
  forces.elasticity->remember(memory);
  remember_slips(std::move(slips));

  const std::unique_ptr<ExplicitSolver<dim>> before = std::move(explicit_solver);
  make_explicit_solver();
  explicit_solver->resume(*before, momentum_change, state);
  fields->set_mesh(*discretization, map_of_pressures());
  measure_bodies();
  const EnergyLedger &energy = explicit_solver->energy();
  progress.say(
      fmt::format("t {:.5g}  mesh adapted: {} cells, {} dofs, energy {:+.1e} of the largest", state.time,
                  results.n_cells, results.n_dofs,
                  energy.largest > 0. ? (energy.stored() - before->energy().stored()) / energy.largest : 0.));
}

template class Simulation<2>;
template class Simulation<3>;
} // namespace signorini
