// SPDX-License-Identifier: LGPL-2.1-or-later
// What a Simulation says of itself: its plan before the run, its results after.
#include "signorini/simulation/simulation.h"

#include "signorini/base/exceptions.h"
#include "signorini/mesh/find_pieces.h"
#include "signorini/output/collisions.h"
#include "signorini/output/exact_solution.h"
#include "signorini/output/summary.h"
#include "signorini/parameters/mesh_parameters.h"
#include "signorini/physics/mass.h"

#include <deal.II/base/numbers.h>
#include <deal.II/base/utilities.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace signorini
{
namespace
{
/// Empty if the mesh of the body is from no mesh file, or hangs together.
std::string describe_pieces(const BodyParameters &body)
{
  if (!body.mesh.mesh_of_file)
    return "";
  const std::vector<MeshPiece> pieces = find_pieces(*body.mesh.mesh_of_file);
  if (pieces.size() == 1)
    return "";
  return fmt::format("the mesh of body '{}' is in {} pieces that have no node in common, the largest of {} "
                     "cells, the smallest of {} near ({:.6g}) of the file: in a quasi-static run each needs "
                     "supports or contact of its own",
                     body.name, pieces.size(), pieces.front().n_cells, pieces.back().n_cells,
                     fmt::join(pieces.back().place, ", "));
}
} // namespace

template <int dim>
void Simulation<dim>::print_plan()
{
  progress.say(fmt::format("Bodies: {}, obstacles: {}, cells of degree {}: {}, dofs: {}, ranks: {}",
                           scene.n_bodies(), scene.obstacles.size(), parameters.degree, results.n_cells,
                           results.n_dofs, dealii::Utilities::MPI::n_mpi_processes(communicator)));
  progress.say(fmt::format("Built: {}", fmt::join(results.parts_built, ", ")));
  for (const LeftOutPart &part : results.parts_left_out)
    progress.say(fmt::format("Left out: {} ({})", part.name, part.reason));
  if (results.has_contact)
  {
    const double stiffness = measure_contact().max_stiffness;
    progress.say(fmt::format(
        "Contact: alpha = {}{}, {}, {} facets; the run stops at a penetration of {} h",
        results.penalty_factor, parameters.contact->penalty_factor ? "" : " to begin with",
        stiffness > 0. ? fmt::format("k_A = {:.4g} Pa/m at most", stiffness) : "no surfaces are near yet",
        surface_map->n_all_facets(), penetration_limit(0)));
  }
  if (const auto *quasi_static = std::get_if<QuasiStaticParameters>(&parameters.solver))
    progress.say(
        fmt::format("Quasi-static: {} load steps to {}", quasi_static->load_steps, quasi_static->end_time));
  else if (const auto *implicit = std::get_if<ImplicitParameters>(&parameters.solver))
  {
    const double n_steps = std::ceil(implicit->end_time / implicit->time_step);
    progress.say(fmt::format("Implicit: time step {:.4g} s, {:.0f} steps to {} s at least",
                             implicit->time_step, n_steps, implicit->end_time));
    warn_of_many_steps(n_steps, "lengthen Implicit/Time step");
  }
  else
  {
    const auto &explicit_parameters = std::get<ExplicitParameters>(parameters.solver);
    ExplicitSolver<dim> solver(*discretization, *supports, scene.materials, forces, explicit_parameters,
                               run_time);
    State trial = state;
    solver.start(trial);
    const double step = solver.stable_step();
    const double n_steps = std::ceil(explicit_parameters.end_time / step);
    progress.say(fmt::format(n_steps > 1e7 ? "Explicit: first time step {:.4g} s, about {:.1e} steps to {} s"
                                           : "Explicit: first time step {:.4g} s, about {:.0f} steps to {} s",
                             step, n_steps, explicit_parameters.end_time));
    warn_of_many_steps(n_steps, "shorten Explicit/End time, coarsen the smallest cells, or run Quasi-static");
  }
  plan_adaptivity();
  for (const BodyParameters &body : parameters.bodies)
    if (const std::string pieces = describe_pieces(body); !pieces.empty())
      warn(pieces);
  progress.say(fmt::format("Memory after set-up: {:.0f} MB on all ranks", memory_mb()));
}

template <int dim>
void Simulation<dim>::plan_adaptivity()
{
  if (!parameters.adaptivity)
    return;
  const AdaptivityParameters &adaptivity = *parameters.adaptivity;
  const auto *quasi_static = std::get_if<QuasiStaticParameters>(&parameters.solver);
  for (const BodyParameters &body : parameters.bodies)
    if (!is_adaptable(body.mesh, quasi_static == nullptr))
      progress.say(fmt::format("Adaptivity: the mesh of {} stays as it is: {}", body.name,
                               quasi_static == nullptr ? "tetrahedra in motion" : "its shape is not known"));
  if (quasi_static == nullptr)
  {
    progress.say(
        fmt::format("Adaptivity: every {} steps, up to {} levels beyond the file's mesh, each of which "
                    "halves the time step",
                    adaptivity.interval, adaptivity.max_levels));
    return;
  }
  progress.say(fmt::format("Adaptivity: up to {} refinements in each load step", adaptivity.max_cycles));
  if (quasi_static->load_steps > 1 && adaptivity.target_error == 0.)
    warn(fmt::format(
        "without Adaptivity/Target error each of the {} load steps refines {} times beyond the one "
        "before, up to {} dofs: set Target error, or lower Maximum cycles or Maximum dofs",
        quasi_static->load_steps, adaptivity.max_cycles, adaptivity.max_n_dofs));
}

template <int dim>
void Simulation<dim>::measure_bodies()
{
  nodal_volume = make_nodal_volume(*discretization);
  results.body_masses.clear();
  results.body_volumes.assign(scene.n_bodies(), 0.);
  for (const OwnedNode<dim> &node : discretization->owned_nodes)
    results.body_volumes[node.body] += nodal_volume.local_element(node.dofs[0]);
  dealii::Utilities::MPI::sum(results.body_volumes, communicator, results.body_volumes);
  for (unsigned int body = 0; body < scene.n_bodies(); ++body)
    results.body_masses.push_back(results.body_volumes[body] * scene.materials[body].density);
}

template <int dim>
void Simulation<dim>::gather_samples()
{
  std::vector<double> packed;
  for (const auto &term : forces.surface_contacts)
    for (const contact::ContactSample<dim> &sample : term->samples())
    {
      const Facet<dim> &facet = surface_map->surface().facets[sample.facet];
      packed.insert(packed.end(), {static_cast<double>(facet.body), facet.layer_thickness, sample.depth,
                                   sample.pressure, sample.area});
      packed.insert(packed.end(), sample.position.begin(), sample.position.end());
    }
  for (const std::vector<double> &of_rank : dealii::Utilities::MPI::all_gather(communicator, packed))
    for (auto value = of_rank.begin(); value != of_rank.end();)
    {
      results.sample_bodies.push_back(static_cast<unsigned int>(*value++));
      results.sample_thicknesses.push_back(*value++);
      contact::ContactSample<dim> sample;
      sample.depth = *value++;
      sample.pressure = *value++;
      sample.area = *value++;
      for (double &coordinate : sample.position)
        coordinate = *value++;
      results.samples.push_back(sample);
    }
}

template <int dim>
void Simulation<dim>::gather_nodal_pressures()
{
  double smallest = std::numeric_limits<double>::max(), largest = std::numeric_limits<double>::lowest();
  for (const auto &term : forces.surface_contacts)
  {
    for (const double pressure : term->projected_pressures())
      results.max_projected_pressure = std::max(results.max_projected_pressure, pressure);
    for (const std::optional<double> &pressure : term->nodal_pressures())
    {
      smallest = std::min(smallest, pressure.value_or(smallest));
      largest = std::max(largest, pressure.value_or(largest));
    }
  }
  results.max_projected_pressure = dealii::Utilities::MPI::max(results.max_projected_pressure, communicator);
  smallest = dealii::Utilities::MPI::min(smallest, communicator);
  largest = dealii::Utilities::MPI::max(largest, communicator);
  if (smallest <= largest)
    results.nodal_pressures = {smallest, largest};
}

template <int dim>
void Simulation<dim>::gather_extremes()
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Eigen::Matrix3d low = Eigen::Matrix3d::Constant(infinity), high = -low;
  for (const Eigen::Matrix3d &stress : forces.elasticity->stresses())
  {
    low = low.cwiseMin(stress);
    high = high.cwiseMax(stress);
  }
  MPI_Allreduce(low.data(), results.smallest_stress.data(), 9, MPI_DOUBLE, MPI_MIN, communicator);
  MPI_Allreduce(high.data(), results.largest_stress.data(), 9, MPI_DOUBLE, MPI_MAX, communicator);

  results.body_end_displacement.assign(scene.n_bodies(), {});
  for (const OwnedNode<dim> &node : discretization->owned_nodes)
    for (unsigned int d = 0; d < dim; ++d)
    {
      double &largest = results.body_end_displacement[node.body][d];
      largest = std::max(largest, std::abs(state.displacement.local_element(node.dofs[d])));
    }
  for (auto &largest : results.body_end_displacement)
    MPI_Allreduce(MPI_IN_PLACE, largest.data(), 3, MPI_DOUBLE, MPI_MAX, communicator);
  for (const auto &entry : supports->entries())
    results.largest_support_displacement =
        std::max(results.largest_support_displacement, std::abs(supports->value(entry, state.time)));

  Vector load_force = discretization->make_vector();
  for (const auto &load : forces.loads)
  {
    load->update(state);
    load->add_force(load_force);
  }
  results.total_load = sum_over_nodes(*discretization, state.displacement, load_force).vector;
}

template <int dim>
void Simulation<dim>::warn(const std::string &warning)
{
  results.warnings.push_back(warning);
  progress.say("Warning: " + warning);
}

template <int dim>
void Simulation<dim>::warn_of_many_steps(double n_steps, const std::string &advice)
{
  if (n_steps > 1e7)
    warn(fmt::format("{:.1e} steps will hardly come to an end; {}", n_steps, advice));
}

template <int dim>
void Simulation<dim>::gather_results()
{
  results.memory_peak_mb = memory_mb();
  measure_distribution();
  gather_samples();
  gather_nodal_pressures();
  gather_extremes();
  if (parameters.exact_solution && !parameters.exact_solution->displacement.empty())
    results.displacement_error =
        measure_displacement_error(*discretization, scene.materials, state.displacement,
                                   parameters.exact_solution->displacement, state.time);
  constexpr double silent = 0.01;
  if (results.energy.max_adaptation > silent * results.energy.largest)
    warn(fmt::format("an adaptation of the mesh changed the energy by {:.2g} of its largest: lower "
                     "Adaptivity/Interval, so that refinement comes before contact",
                     results.energy.max_adaptation / results.energy.largest));
  if (results.has_ledger) // volumes turn round at small depths
    results.collisions = find_collisions(results.history, forces.volume_contacts.empty()
                                                              ? results.max_penetration_over_thickness
                                                              : std::numeric_limits<double>::infinity());
  warn_of_collisions();
  warn_of_turns();
  warn_of_lone_points();
  warn_of_open_ledger();
  constexpr double shallow = 0.1;
  if (results.max_penetration_over_thickness > shallow)
    warn(fmt::format("the largest penetration of the run, {:.3g} h, exceeds {} h: raise Contact/Penalty "
                     "factor or refine",
                     results.max_penetration_over_thickness, shallow));
}

template <int dim>
void Simulation<dim>::warn_of_turns()
{
  constexpr double small_angle = 0.05, small_drift = 0.01;
  std::vector<double> turns = forces.elasticity->turns_taken_for_strain();
  dealii::Utilities::MPI::max(turns, communicator, turns);
  const auto largest = std::max_element(turns.begin(), turns.end());
  if (*largest == 0. || (*largest <= small_angle && results.max_angular_drift <= small_drift))
    return;
  const std::string drift =
      results.has_ledger
          ? fmt::format(", and its moments do not balance (drift of the angular momentum {:.1e})",
                        results.max_angular_drift)
          : "";
  warn(fmt::format(
      "body '{}' is turned by up to {:.2g} degrees, which the linear elastic law takes for a strain "
      "of {:.1e}{}: set Model = neo-Hookean in its Material",
      scene.body_names[largest - turns.begin()], *largest * 180. / dealii::numbers::PI,
      1. - std::cos(*largest), drift));
}

template <int dim>
void Simulation<dim>::warn_of_collisions()
{
  for (const Collision &collision : results.collisions)
    if (collision.outcome == Collision::Outcome::passed_through)
    {
      warn(fmt::format("{} passed through {} ({:.6g} to {:.6g} s): lower Contact/Maximum penetration, which "
                       "stops the run before that, and raise Contact/Penalty factor or refine",
                       name_of_collider(parameters, collision.one),
                       name_of_collider(parameters, collision.other), collision.begin, collision.end));
      return;
    }
}

template <int dim>
void Simulation<dim>::finish(std::optional<NumericalError> failure)
{
  try
  {
    if (!failure)
      results.errors = compute_errors(results);
  }
  catch (const NumericalError &error)
  {
    failure = error;
  }
  if (failure && results.status != "interrupted")
    results.status = "failed";
  if (failure)
    results.reason = failure->complaint().text();
  results.run_time = run_time.sections();
  results.total_run_time = run_time.total();
  print_results();
  weigh_parts();
  if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
  {
    const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(communicator);
    write_summary(results, text->file, n_ranks, parameters.output.directory);
    if (!failure)
      write_profile(results, parameters.output.directory);
  }
  print_costs();
  if (failure)
    throw NumericalError(*failure);
}

template <int dim>
void Simulation<dim>::print_collisions()
{
  constexpr std::size_t most = 20;
  const std::vector<Collision> &collisions = results.collisions;
  for (std::size_t i = 0; i < std::min(most, collisions.size()); ++i)
    progress.say(fmt::format("Collision of {} and {} from {:.6g} to {:.6g} s: {}",
                             name_of_collider(parameters, collisions[i].one),
                             name_of_collider(parameters, collisions[i].other), collisions[i].begin,
                             collisions[i].end, name_of(collisions[i].outcome)));
  if (collisions.size() > most)
    progress.say(fmt::format("and {} further collisions", collisions.size() - most));
}

template <int dim>
void Simulation<dim>::print_results()
{
  if (results.has_contact)
  {
    const std::string form = "Contact {}: largest pressure {:.6g} Pa, penetration/h {:.3g}, area {:.6g}";
    progress.say(results.contact.n_active > 0
                     ? fmt::format(form, "at the end", results.contact.max_pressure,
                                   results.contact.max_penetration_over_thickness, results.contact.area)
                     : "Contact at the end: nothing touches");
    progress.say(fmt::format(form, "in the whole run", results.max_pressure,
                             results.max_penetration_over_thickness, results.max_area) +
                 fmt::format(" ({:.2g} % of the penetration that stops a run)",
                             100. * results.max_penetration_over_thickness / penetration_limit(0)));
  }
  for (const ContactResultant &resultant : results.resultants)
    if (resultant.force != std::array<double, 3>{})
      progress.say(fmt::format("Contact force on {} from {} at the end: ({:.6g})", resultant.on,
                               resultant.from,
                               fmt::join(resultant.force.begin(), resultant.force.begin() + dim, ", ")));
  print_collisions();
  if (results.has_ledger)
    progress.say(
        fmt::format("Energy ledger open by {:.2e} at most; momentum drift {:.2e} linear, {:.2e} angular",
                    results.max_ledger_residual, results.max_linear_drift, results.max_angular_drift));
  const ErrorEstimate &estimate = results.estimate;
  progress.say(fmt::format("Estimated error in the energy norm: {:.2e} discretization, {:.2e} contact",
                           estimate.relative(estimate.discretization), estimate.relative(estimate.contact)));
  for (const ErrorRow &row : results.errors)
    progress.say(fmt::format("{:<52} {:>14.7g}  exact {:>14.7g}  error {:+.3e}", row.quantity, row.computed,
                             row.exact, row.relative_error));
}

template <int dim>
void Simulation<dim>::print_costs()
{
  double named = 0.;
  for (const auto &[name, seconds] : results.run_time)
  {
    progress.say(
        fmt::format("{:<26} {:9.2f} s  {:5.1f} %", name, seconds, 100. * seconds / results.total_run_time));
    named += seconds;
  }
  progress.say(fmt::format("{:<26} {:9.2f} s  {:5.1f} %", "everything else", results.total_run_time - named,
                           100. * (1. - named / results.total_run_time)));
  progress.say(fmt::format("{:<26} {:9.2f} s", "total", results.total_run_time));
  if (const auto &memory = results.memory)
    progress.say(fmt::format(
        "Memory at the end: {:.0f} bytes a cell, {:.0f} of the solver a degree of freedom{}",
        memory->mesh / results.n_cells, memory->solver / results.n_dofs,
        results.n_facets > 0 ? fmt::format(", {:.0f} a contact face", memory->contact / results.n_facets)
                             : ""));
  progress.say("Output: " + parameters.output.directory);
}

template class Simulation<2>;
template class Simulation<3>;
} // namespace signorini
