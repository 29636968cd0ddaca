// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/simulation/simulation.h"

#include "signorini/base/exceptions.h"
#include "signorini/output/exact_solution.h"
#include "signorini/output/summary.h"
#include "signorini/physics/dead_load.h"
#include "signorini/physics/mass.h"
#include "signorini/simulation/held_bodies.h"
#include "signorini/simulation/interruption.h"

#include <deal.II/base/utilities.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace signorini
{
template <int dim>
Simulation<dim>::Simulation(const ParameterText &parameter_text, const Parameters &the_parameters,
                            const MPI_Comm &mpi_communicator, bool is_quiet)
    : parameters(the_parameters), text(&parameter_text), communicator(mpi_communicator),
      progress(dealii::Utilities::MPI::this_mpi_process(mpi_communicator) == 0, is_quiet),
      scene(make_scene<dim>(the_parameters)),
      fields(std::make_unique<Fields<dim>>(the_parameters.output.directory)),
      checkpoint(the_parameters.output.directory, mpi_communicator)
{
  const auto section = run_time.enter("set-up");
  results.parameters = &parameters;
  discretization = std::make_unique<Discretization<dim>>(parameters, communicator);
  build_on_mesh();
  list_parts();

  state.displacement = discretization->make_vector();
  if (is_in_motion())
    set_initial_motion();
  else
  {
    is_body_held = find_held_bodies(scene, *supports);
    check_held(*text, parameters, scene, *supports);
  }
  check_initial_overlap();
}

template <int dim>
void Simulation<dim>::build_on_mesh()
{
  const double end_time = std::visit([](const auto &solver) { return solver.end_time; }, parameters.solver);
  supports = std::make_unique<SupportedDofs<dim>>(scene, *discretization, end_time);
  forces = SceneForces<dim>();
  forces.elasticity = std::make_shared<InternalForce<dim>>(scene.materials, *discretization);
  if (std::any_of(scene.materials.begin(), scene.materials.end(),
                  [](const MaterialParameters &material) { return material.viscosity > 0.; }))
    forces.viscosities.push_back(std::make_shared<ViscousForce<dim>>(scene.materials, *discretization));
  if (!scene.loads.empty() || scene.gravity.norm() > 0.)
    forces.loads.push_back(std::make_shared<DeadLoad<dim>>(
        scene, *discretization, is_in_motion() ? WeightShares::lumped_mass : WeightShares::shape_integrals));
  if (parameters.contact)
    build_contact();
  estimator = std::make_unique<ErrorEstimator<dim>>(*discretization, scene, forces, surface_map.get());
  if (parameters.contact && parameters.contact->correction)
    correction = std::make_unique<ContactCorrection<dim>>(*discretization, scene, forces, *surface_map,
                                                          estimator->boundary_faces());
  results.n_dofs = discretization->n_dofs();
  results.n_cells = discretization->n_cells();
}

template <int dim>
void Simulation<dim>::list_parts()
{
  const auto note = [&](bool is_built, const std::string &name, const std::string &reason)
  {
    if (is_built)
      results.parts_built.push_back(name);
    else
      results.parts_left_out.push_back({name, reason});
  };
  const bool is_explicit = std::holds_alternative<ExplicitParameters>(parameters.solver),
             is_implicit = std::holds_alternative<ImplicitParameters>(parameters.solver);
  const std::string kind = "the run is " + std::string(is_explicit   ? "explicit"
                                                       : is_implicit ? "implicit"
                                                                     : "quasi-static");
  note(true, "elasticity", "");
  note(forces.elasticity->has_plasticity(), "plasticity", "no Material has Model = J2 plastic");
  note(!forces.viscosities.empty(), "viscosity", "no Material has a Viscosity");
  note(!forces.loads.empty(), "loads", "no gravity and no subsection Load");
  note(!scene.supports.empty(), "supports", "no subsection Support");
  note(surface_map != nullptr, "contact surface", "no subsection Contact");
  note(scene.n_bodies() > 1 && surface_map, "contact of bodies",
       surface_map ? "one body only" : "no subsection Contact");
  note(parameters.contact && !parameters.contact->self_contact.empty(), "self-contact",
       surface_map ? "Contact/Self-contact names no body" : "no subsection Contact");
  note(volume_map != nullptr, "volume potential",
       scene.n_bodies() > 1 ? "Contact/Potential is not volume" : "one body only");
  note(!scene.obstacles.empty(), "contact with obstacles", "no obstacle");
  note(!forces.moving_contacts.empty(), "motion of obstacles",
       scene.obstacles.empty() ? "no obstacle" : "no obstacle has a Displacement");
  note(correction != nullptr, "contact correction", "no subsection Contact/Correction");
  note(!forces.damped_contacts.empty(), "contact damping", "no subsection Contact/Damping");
  note(!forces.frictions.empty(), "friction", "no subsection Contact/Friction");
  note(!is_in_motion(), "quasi-static solver", kind);
  note(is_explicit, "explicit solver", kind);
  note(is_implicit, "implicit solver", kind);
  note(has_implicit_contact(), "implicit contact stepping",
       !is_explicit  ? kind
       : surface_map ? "Explicit/Contact stepping is explicit"
                     : "no subsection Contact");
  note(is_in_motion(), "mass and ledgers of energy and momentum", kind);
  note(true, "error estimate", "");
  note(parameters.adaptivity.has_value(), "adaptive refinement", "no subsection Adaptivity");
  note(parameters.exact_solution.has_value(), "exact solution", "no subsection Exact solution");
}

template <int dim>
void Simulation<dim>::run()
{
  const std::string &directory = parameters.output.directory;
  fields->set_mesh(*discretization, map_of_pressures());
  if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
    statistics = is_resumed ? std::make_unique<Statistics>(directory + "/statistics.csv", statistics_size)
                            : std::make_unique<Statistics>(directory + "/statistics.csv");
  if (!is_resumed)
  {
    progress.open_log(directory, Progress::EarlierLog::replaced);
    print_plan();
  }
  measure_bodies();
  watch_for_interruption();
  traffic_of_setup = count_traffic();
  std::optional<NumericalError> failure;
  try
  {
    if (std::holds_alternative<QuasiStaticParameters>(parameters.solver))
      run_quasi_static();
    else if (const auto *implicit = std::get_if<ImplicitParameters>(&parameters.solver))
      run_implicit(*implicit);
    else
      run_explicit(std::get<ExplicitParameters>(parameters.solver));
    results.status = "ok";
  }
  catch (const NumericalError &error)
  {
    failure = error;
  }
  gather_results();
  finish(failure);
}

template <int dim>
void Simulation<dim>::check_interruption(const std::function<void()> &write)
{
  const std::string signal = interruption(communicator);
  if (signal.empty())
    return;
  write();
  results.status = "interrupted";
  throw NumericalError(
      Complaint(fmt::format("the run was interrupted by {} at t = {:.6g}", signal, state.time))
          .advise(
              time_of_checkpoint
                  ? fmt::format("what was written up to there is whole; 'signorini --resume {}' goes on from "
                                "t = {:.6g}",
                                display_name(text->file), *time_of_checkpoint)
                  : "what was written up to there is whole; run again for the rest"));
}

template <int dim>
void Simulation<dim>::estimate_error()
{
  const auto section = run_time.enter("error estimate");
  results.estimate = estimator->estimate(state);
  // Beside the largest energy of the run, or the square of strains of 1e-10, an error is round-off.
  double stiffness = 0.;
  for (unsigned int body = 0; body < results.body_volumes.size(); ++body)
    stiffness += scene.materials[body].youngs_modulus * results.body_volumes[body];
  ErrorEstimate &estimate = results.estimate;
  largest_energy = std::max(largest_energy, estimate.energy);
  if (estimate.energy + estimate.discretization <= std::max(1e-8 * largest_energy, 1e-20 * stiffness))
    estimate.forget_errors();
  if (estimate.is_any_contact_unseen && !parameters.adaptivity)
    warn_of_unseen_contact();
}

template <int dim>
void Simulation<dim>::warn_of_unseen_contact()
{
  constexpr double unheeded_depth = .02; // over the skin: a hundredth of the thinnest layer
  std::size_t n_unseen = 0;
  for (const auto &contact : forces.surface_contacts)
    n_unseen += contact->unseen_contact(state, unheeded_depth * contact->skin()).size();
  if (dealii::Utilities::MPI::sum(n_unseen, communicator) > 0 && !std::exchange(has_warned_of_unseen, true))
    warn(fmt::format(
        "at t = {:.6g} a corner or an edge lies in what it touches, by more than a hundredth of an "
        "element, where no quadrature point feels it: raise Contact/Quadrature points, or refine "
        "there",
        state.time));
}

template <int dim>
const SurfaceMap<dim> *Simulation<dim>::map_of_pressures() const
{
  return forces.surface_contacts.empty() ? nullptr : surface_map.get();
}

template <int dim>
unsigned int Simulation<dim>::next_output(double time, unsigned int n, double end)
{
  constexpr double round_off = 1e-9; // steps add up to the time
  return static_cast<unsigned int>(std::floor(time / end * std::max(1u, n) * (1. + round_off))) + 1;
}

template <int dim>
bool Simulation<dim>::is_due(unsigned int &next, unsigned int n, double end) const
{
  const unsigned int now = next_output(state.time, n, end);
  const bool has_come = now > next || state.time >= end;
  next = now;
  return has_come;
}

template <int dim>
void Simulation<dim>::write_fields()
{
  const auto section = run_time.enter("output");
  fields->write(state, forces, results.estimate);
  time_of_fields = state.time;
}

template class Simulation<2>;
template class Simulation<3>;
} // namespace signorini
