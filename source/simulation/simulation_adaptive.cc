// SPDX-License-Identifier: LGPL-2.1-or-later
// The loop of refinement within a load step.
#include "signorini/simulation/simulation.h"

#include "signorini/adaptivity/contact_marking.h"
#include "signorini/adaptivity/marking.h"
#include "signorini/adaptivity/remeshing.h"
#include "signorini/base/exceptions.h"

#include <fmt/core.h>

namespace signorini
{
template <int dim>
void Simulation<dim>::adapt_to_load()
{
  const AdaptivityParameters &adaptivity = *parameters.adaptivity;
  const ErrorEstimate &estimate = results.estimate;
  for (;; ++*refinement_cycle)
  {
    say_mesh(*refinement_cycle);
    const bool is_last =
        *refinement_cycle == adaptivity.max_cycles || results.n_dofs >= adaptivity.max_n_dofs;
    // What the penalty leaves does not show where to refine: it is corrected on meshes that may be the last.
    const auto is_within = [&](double squared)
    { return !estimate.is_any_contact_unseen && estimate.relative(squared) <= adaptivity.target_error; };
    if (correction && (is_last || is_within(estimate.discretization)))
    {
      check_adapted(correct_contact(state.time));
      accept_yielding();
      estimate_error();
    }
    const bool is_penalty_in_the_way =
        is_within(estimate.discretization) && estimate.contact > estimate.discretization;
    if (is_last || is_within(estimate.total()) || is_penalty_in_the_way ||
        (!estimate.is_any_contact_unseen && estimate.discretization == 0.))
    {
      if (adaptivity.target_error > 0. && !is_within(estimate.total()))
        warn(fmt::format(
            "at load {:.6g} refining ended with an estimated error of {:.2e}, above Adaptivity/Target "
            "error = {}: {}",
            state.time, estimate.relative(estimate.total()), adaptivity.target_error,
            is_penalty_in_the_way ? "most of it is the penalty's; set Penalty factor = auto or "
                                    "Contact/Correction"
                                  : "raise Maximum cycles or Maximum dofs"));
      refinement_cycle.reset();
      return;
    }
    save_when_due();
    check_interruption(
        [&]()
        {
          save();
          record_quasi_static();
          write_fields();
        });
    adapt_mesh();
    check_adapted(solve_load_step(state.time));
    estimate_error();
  }
}

template <int dim>
void Simulation<dim>::say_mesh(unsigned int cycle)
{
  const ErrorEstimate &estimate = results.estimate;
  progress.say(fmt::format("load {:.5g}  mesh {}: {} cells, {} dofs, estimated error {:.3e} discretization, "
                           "{:.3e} contact",
                           state.time, cycle, results.n_cells, results.n_dofs,
                           estimate.relative(estimate.discretization), estimate.relative(estimate.contact)));
}

template <int dim>
void Simulation<dim>::check_adapted(const std::optional<Complaint> &fault) const
{
  if (fault)
    throw NumericalError(
        Complaint(fmt::format("no equilibrium on the refined mesh at load parameter {:.6g}: {}", state.time,
                              fault->what))
            .at(fault->where)
            .expected(fault->allowed)
            .advise(fault->next_step + "; or lower Adaptivity/Maximum dofs"));
}

template <int dim>
void Simulation<dim>::adapt_mesh()
{
  const auto section = run_time.enter("refinement");
  auto slips = place_slips();
  const std::vector<Vector *> carried{&state.displacement, &step_start.state.displacement};
  const std::vector<PlacedSimplexMesh> new_meshes =
      discretization->tetrahedra
          ? make_adapted_meshes(results.estimate, *parameters.adaptivity, parameters.bodies, *discretization)
          : std::vector<PlacedSimplexMesh>();
  if (discretization->hexahedra)
  {
    mark_cells(results.estimate, *parameters.adaptivity, *discretization);
    if (surface_map)
      level_curved_contact(estimator->boundary_faces(), estimator->contact_pressures(),
                           results.penalty_factor, *surface_map, *discretization);
    discretization->adapt(carried, step_start.memory);
  }
  if (discretization->tetrahedra)
    discretization->replace_tetrahedra(new_meshes, carried);
  build_on_mesh();
  // New supported nodes have values between those of the old ones, not their own.
  for (State *at : {&state, &step_start.state})
  {
    supports->impose(at->time, at->displacement);
    discretization->distribute(at->displacement);
  }
  balance_work(carried, step_start.memory);
  // What yielded in this step yields again in its repetition. Going on from its end, the bodies would only
  // give way to the new mesh, and their stresses fall below those of yielding.
  forces.elasticity->update(step_start.state);
  forces.elasticity->remember(step_start.memory);
  results.energy.plastic_work = step_start.plastic_work;
  remember_slips(std::move(slips));
  make_quasi_static_solver();
  fields->set_mesh(*discretization, map_of_pressures());
  measure_bodies();
}

template <int dim>
void Simulation<dim>::begin_load_step()
{
  if (!parameters.adaptivity)
    return;
  forces.elasticity->update(state);
  step_start = {state, forces.elasticity->memory(), results.energy.plastic_work};
}

template <int dim>
void Simulation<dim>::balance_work(const std::vector<Vector *> &values, PointValues &memory)
{
  if (dealii::Utilities::MPI::n_mpi_processes(communicator) == 1)
    return;
  for (const auto &contact : forces.contacts)
    contact->renew(state);
  if (discretization->balance(find_cell_work(*discretization, estimator->boundary_faces(), forces), values,
                              memory))
    build_on_mesh();
}

template class Simulation<2>;
template class Simulation<3>;
} // namespace signorini
