// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/simulation/simulation.h"

#include "signorini/base/exceptions.h"
#include "signorini/output/exact_solution.h"
#include "signorini/output/summary.h"
#include "signorini/physics/dead_load.h"
#include "signorini/physics/mass.h"
#include "signorini/simulation/held_bodies.h"

#include <deal.II/base/utilities.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace signorini
{
namespace
{
template <int dim>
contact::PotentialSettings make_settings(const Parameters &parameters)
{
  using Wanted = ContactParameters::Integration;
  const ContactParameters &contact = *parameters.contact;
  const bool is_explicit = std::holds_alternative<ExplicitParameters>(parameters.solver);
  contact::PotentialSettings settings;
  settings.penalty_factor = contact.penalty_factor;
  settings.n_quadrature_points = contact.quadrature_points;
  const bool is_by_faces = contact.integration == Wanted::automatic ? is_explicit
                                                                    : contact.integration == Wanted::face_quadrature;
  settings.integration = is_by_faces ? contact::Integration::face_quadrature : contact::Integration::face_segments;
  if (contact.damping)
    settings.damping_ratio = contact.damping->damping_ratio;

  const auto find = [](const auto &list, const std::string &name)
  {
    return static_cast<unsigned int>(
      std::find_if(list.begin(), list.end(), [&](const auto &entry) { return entry.name == name; }) - list.begin());
  };
  const unsigned int n_bodies = parameters.bodies.size();
  for (const auto &[one, other] : contact.excluded_pairs)
  {
    const unsigned int first = find(parameters.bodies, one), second = find(parameters.bodies, other);
    if (first < n_bodies && second < n_bodies)
      settings.excluded_body_pairs.emplace_back(first, second);
    else if (first < n_bodies)
      settings.excluded_obstacle_pairs.emplace_back(first, find(parameters.obstacles, other));
    else
      settings.excluded_obstacle_pairs.emplace_back(second, find(parameters.obstacles, one));
  }
  return settings;
}
} // namespace

template <int dim>
Simulation<dim>::Simulation(const Parameters &the_parameters, const std::string &input_name,
                            const MPI_Comm &mpi_communicator, bool is_quiet)
  : parameters(the_parameters)
  , input(input_name)
  , communicator(mpi_communicator)
  , progress(dealii::Utilities::MPI::this_mpi_process(mpi_communicator) == 0, is_quiet)
  , scene(make_scene<dim>(the_parameters))
{
  const auto section = run_time.enter("set-up");
  results.parameters = &parameters;
  discretization = std::make_unique<Discretization<dim>>(parameters, communicator);
  const double end_time = std::visit([](const auto &solver) { return solver.end_time; }, parameters.solver);
  supports = std::make_unique<SupportedDofs<dim>>(scene, *discretization, end_time);
  forces.elasticity = std::make_shared<InternalForce<dim>>(scene.materials, *discretization);
  if (!scene.loads.empty() || scene.gravity.norm() > 0.)
    forces.loads.push_back(std::make_shared<DeadLoad<dim>>(scene, *discretization));
  if (parameters.contact)
    build_contact();
  list_parts();

  state.displacement = discretization->make_vector();
  if (std::holds_alternative<ExplicitParameters>(parameters.solver))
    set_initial_motion();
  else
  {
    is_body_held = find_held_bodies(scene, *supports);
    check_held(parameters, scene, is_body_held);
  }
  results.n_dofs = discretization->n_dofs();
  results.n_cells = discretization->mesh->n_global_active_cells();
  check_initial_overlap();
}

template <int dim>
void Simulation<dim>::build_contact()
{
  const contact::PotentialSettings settings = make_settings<dim>(parameters);
  surface_map = std::make_unique<SurfaceMap<dim>>(scene, *discretization);
  if (scene.n_bodies() > 1)
    forces.contacts.push_back(
      std::make_shared<ContactForce<dim>>("contact of bodies", false, *surface_map,
                                          typename contact::ContactPotential<dim>::Obstacles(), settings, communicator));
  if (!scene.obstacles.empty())
  {
    contact::PotentialSettings obstacles_only = settings;
    for (unsigned int one = 0; one < scene.n_bodies(); ++one)
      for (unsigned int other = 0; other < one; ++other)
        obstacles_only.excluded_body_pairs.emplace_back(one, other);
    forces.contacts.push_back(std::make_shared<ContactForce<dim>>("contact with obstacles", true, *surface_map,
                                                                  scene.obstacles, obstacles_only, communicator));
  }
  if (settings.damping_ratio)
    forces.damped_contacts = forces.contacts;
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
  const bool is_explicit = std::holds_alternative<ExplicitParameters>(parameters.solver);
  note(true, "elasticity", "");
  note(!forces.loads.empty(), "loads", "no gravity and no subsection Load");
  note(!scene.supports.empty(), "supports", "no subsection Support");
  note(surface_map != nullptr, "contact surface", "no subsection Contact");
  note(scene.n_bodies() > 1 && surface_map, "contact of bodies",
       surface_map ? "one body only" : "no subsection Contact");
  note(!scene.obstacles.empty(), "contact with obstacles", "no obstacle");
  note(!forces.damped_contacts.empty(), "contact damping", "no subsection Contact/Damping");
  note(!is_explicit, "quasi-static solver", "the run is explicit");
  note(is_explicit, "explicit solver", "the run is quasi-static");
  note(is_explicit, "mass and ledgers of energy and momentum", "the run is quasi-static");
  note(parameters.exact_solution.has_value(), "exact solution", "no subsection Exact solution");
}

template <int dim>
void Simulation<dim>::set_initial_motion()
{
  state.velocity = discretization->make_vector();
  const Vector mass = make_lumped_mass(scene.materials, *discretization);
  std::vector<double> sums((dim + 1) * scene.n_bodies(), 0.);
  for (const OwnedNode<dim> &node : discretization->owned_nodes)
  {
    const double m = mass.local_element(node.dofs[0]);
    sums[(dim + 1) * node.body] += m;
    for (unsigned int d = 0; d < dim; ++d)
      sums[(dim + 1) * node.body + 1 + d] += m * node.position[d];
  }
  dealii::Utilities::MPI::sum(sums, communicator, sums);
  for (const OwnedNode<dim> &node : discretization->owned_nodes)
  {
    std::array<double, 3> arm{};
    const double *body_sums = &sums[(dim + 1) * node.body];
    for (unsigned int d = 0; d < dim; ++d)
      arm[d] = node.position[d] - body_sums[1 + d] / body_sums[0];
    const Triple &spin = scene.initial_spin[node.body];
    for (unsigned int d = 0; d < dim; ++d)
      state.velocity.local_element(node.dofs[d]) = scene.initial_velocity[node.body][d] +
                                                   spin[(d + 1) % 3] * arm[(d + 2) % 3] -
                                                   spin[(d + 2) % 3] * arm[(d + 1) % 3];
  }
}

template <int dim>
void Simulation<dim>::update_contact_measures()
{
  if (forces.contacts.empty())
    return;
  results.has_contact = true;
  contact::ContactMeasures<dim> total = forces.contacts.front()->measure();
  for (std::size_t i = 1; i < forces.contacts.size(); ++i)
  {
    const contact::ContactMeasures<dim> other = forces.contacts[i]->measure();
    if (other.max_penetration_over_thickness > total.max_penetration_over_thickness)
    {
      total.max_penetration_over_thickness = other.max_penetration_over_thickness;
      total.deepest_facet = other.deepest_facet;
      total.deepest_position = other.deepest_position;
    }
    total.max_penetration = std::max(total.max_penetration, other.max_penetration);
    total.max_pressure = std::max(total.max_pressure, other.max_pressure);
    total.max_stiffness = std::max(total.max_stiffness, other.max_stiffness);
    total.area += other.area;
    total.n_pairs += other.n_pairs;
    total.n_active += other.n_active;
    for (unsigned int body = 0; body < total.resultants.size(); ++body)
      total.resultants[body] += other.resultants[body];
  }
  results.contact = total;
  results.max_penetration_over_thickness =
    std::max(results.max_penetration_over_thickness, total.max_penetration_over_thickness);
  results.max_n_pairs = std::max(results.max_n_pairs, total.n_pairs);
}

template <int dim>
void Simulation<dim>::check_initial_overlap()
{
  constexpr double allowed = 0.1;
  supports->impose(0., state.displacement);
  discretization->distribute(state.displacement);
  forces.elasticity->update(state);
  double energy = 0.;
  for (const auto &contact : forces.contacts)
  {
    contact->renew(state);
    contact->update(state);
    energy += contact->energy();
  }
  update_contact_measures();
  if (!results.has_contact || results.max_penetration_over_thickness <= allowed)
    return;
  const auto &deepest = results.contact;
  const std::string where = fmt::format("({:.6g})", fmt::join(deepest.deepest_position.data(),
                                                              deepest.deepest_position.data() + dim, ", "));
  if (!parameters.contact->allow_initial_overlap)
    throw InputError(
      Complaint(fmt::format("body '{}' overlaps something by {:.3g} of its element size before the run begins",
                            scene.body_names[surface_map->surface().facets[deepest.deepest_facet].body],
                            deepest.max_penetration_over_thickness))
        .at(where)
        .expected(fmt::format("at most {} of an element", allowed))
        .advise("move the bodies apart, or set Contact/Allow initial overlap = true"));
  progress.say(fmt::format("Initial overlap: {:.3g} of an element at {}, storing {:.6g} J",
                           deepest.max_penetration_over_thickness, where, energy));
}

template <int dim>
void Simulation<dim>::check_penetration()
{
  constexpr double limit = 0.5;
  if (results.contact.max_penetration_over_thickness <= limit)
    return;
  const auto &deepest = results.contact;
  throw NumericalError(
    Complaint(fmt::format("body '{}' sinks into another by {:.3g} of its element size at t = {:.6g}",
                          scene.body_names[surface_map->surface().facets[deepest.deepest_facet].body],
                          deepest.max_penetration_over_thickness, state.time))
      .at(fmt::format("({:.6g})", fmt::join(deepest.deepest_position.data(), deepest.deepest_position.data() + dim, ", ")))
      .expected(fmt::format("at most {} of an element: deeper, it could pass through", limit))
      .advise("raise Contact/Penalty factor, refine, or load more slowly"));
}

template <int dim>
std::vector<BodyRecord> Simulation<dim>::record_bodies() const
{
  std::vector<BodyRecord> records(scene.n_bodies());
  for (unsigned int body = 0; body < scene.n_bodies() && results.has_contact; ++body)
    for (unsigned int d = 0; d < dim; ++d)
      records[body].contact_force[d] = results.contact.resultants[body][d];
  if (state.velocity.size() == 0)
    return records;
  const Vector mass = make_lumped_mass(scene.materials, *discretization);
  std::vector<double> momenta(dim * scene.n_bodies(), 0.);
  for (const OwnedNode<dim> &node : discretization->owned_nodes)
    for (unsigned int d = 0; d < dim; ++d)
      momenta[dim * node.body + d] += mass.local_element(node.dofs[d]) * state.velocity.local_element(node.dofs[d]);
  dealii::Utilities::MPI::sum(momenta, communicator, momenta);
  for (unsigned int body = 0; body < scene.n_bodies(); ++body)
    for (unsigned int d = 0; d < dim; ++d)
      records[body].velocity[d] = momenta[dim * body + d] / results.body_masses[body];
  return records;
}

template <int dim>
void Simulation<dim>::run()
{
  const std::string &directory = parameters.output.directory;
  fields = std::make_unique<Fields<dim>>(*discretization, surface_map.get(), directory);
  progress.open_log(directory);
  if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
    statistics = std::make_unique<Statistics>(directory + "/statistics.csv");
  print_plan();
  measure_bodies();
  try
  {
    if (const auto *quasi_static = std::get_if<QuasiStaticParameters>(&parameters.solver))
      run_quasi_static(*quasi_static);
    else
      run_explicit(std::get<ExplicitParameters>(parameters.solver));
  }
  catch (const NumericalError &)
  {
    finish("failed");
    throw;
  }
  finish("ok");
}

template <int dim>
void Simulation<dim>::write_fields()
{
  const auto section = run_time.enter("output");
  fields->write(state, forces);
}

template <int dim>
void Simulation<dim>::run_quasi_static(const QuasiStaticParameters &solver_parameters)
{
  QuasiStaticSolver<dim> solver(*discretization, *supports, scene.materials, is_body_held, forces, surface_map.get(),
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
        progress.step(fmt::format("load {:.5g}  iteration {:2d}  residual {:.2e}  step {:.3g}  linear {}", time,
                                  report.iteration, report.residual, report.step_length, report.linear_iterations),
                      share);
      });
    results.n_iterations = solver.n_iterations();
    if (is_solved)
    {
      ++results.n_steps;
      record_quasi_static(end);
      step = std::min(largest_step, 2. * step);
      continue;
    }
    step *= 0.5;
    progress.say(fmt::format("load {:.5g}: {}; trying half the step", time, solver.failure()));
    if (step < smallest_step)
      throw NumericalError(
        Complaint(fmt::format("no equilibrium beyond load parameter {:.6g}: {}", state.time, solver.failure()))
          .advise("look at the last fields; use more load steps, a lower Penalty factor, or check that contact "
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
    progress.step(fmt::format("load {:.5g}  equilibrium  pairs {}  penetration/h {:.2e}", state.time, contact.n_active,
                              contact.max_penetration_over_thickness),
                  state.time / end);
  write_fields();
}

template <int dim>
void Simulation<dim>::append_contact(Statistics::Row &row) const
{
  const auto &contact = results.contact;
  for (unsigned int d = 0; d < dim; ++d)
    row.emplace_back(fmt::format("contact force {} [N]", "xyz"[d]), contact.resultants.at(0)[d]);
  row.emplace_back("contact area [m2]", contact.area);
  row.emplace_back("max penetration [m]", contact.max_penetration);
  row.emplace_back("max penetration over h [1]", contact.max_penetration_over_thickness);
  row.emplace_back("max pressure [Pa]", contact.max_pressure);
  row.emplace_back("pairs [1]", contact.n_active);
}

template <int dim>
void Simulation<dim>::run_explicit(const ExplicitParameters &solver_parameters)
{
  ExplicitSolver<dim> solver(*discretization, *supports, scene.materials, forces, solver_parameters, run_time);
  solver.start(state);
  const double end = solver_parameters.end_time;
  const unsigned int n_rows = std::max(1u, parameters.output.n_statistics);
  const unsigned int n_fields = std::max(1u, parameters.output.n_fields);
  record_explicit(solver, 0., end);
  write_fields();
  // Rows and fields are written by the first step that reaches their time: outputs do not shape the steps.
  unsigned int row = 1, field = 1;
  while (state.time < end)
  {
    const double remaining = end - state.time, stable = solver.stable_step();
    const double time_step = remaining > 2. * stable ? stable : remaining / std::ceil(remaining / stable - 1e-9);
    solver.step(time_step, state);
    if (end - state.time < 1e-9 * time_step)
      state.time = end;
    ++results.n_steps;
    update_contact_measures();
    check_penetration();
    if (state.time >= end * row / n_rows)
    {
      solver.take_stock(state);
      record_explicit(solver, time_step, end);
      row = 1 + static_cast<unsigned int>(std::floor(state.time / end * n_rows));
    }
    if (state.time >= end * field / n_fields)
    {
      write_fields();
      solver.update_bulk_bound();
      field = 1 + static_cast<unsigned int>(std::floor(state.time / end * n_fields));
    }
  }
}

template <int dim>
void Simulation<dim>::record_explicit(const ExplicitSolver<dim> &solver, double time_step, double end)
{
  const EnergyLedger &energy = solver.energy();
  const MomentumLedger &momentum = solver.momentum();
  results.has_ledger = true;
  results.energy = energy;
  results.momentum = momentum;
  results.max_ledger_residual = std::max(results.max_ledger_residual, std::abs(energy.residual()));
  results.max_linear_drift = std::max(results.max_linear_drift, momentum.linear_drift());
  results.max_angular_drift = std::max(results.max_angular_drift, momentum.angular_drift());
  update_contact_measures();
  results.history.push_back({state.time, record_bodies()});

  Statistics::Row row{{"time [s]", state.time},
                      {"time step [s]", time_step},
                      {"kinetic energy [J]", energy.kinetic},
                      {"elastic energy [J]", energy.elastic},
                      {"contact energy [J]", energy.contact},
                      {"dissipated [J]", energy.dissipated},
                      {"work [J]", energy.work_of_loads + energy.work_of_supports},
                      {"contact renewals [J]", energy.contact_renewals},
                      {"ledger residual [1]", energy.residual()},
                      {"linear momentum drift [1]", momentum.linear_drift()},
                      {"angular momentum drift [1]", momentum.angular_drift()}};
  if (results.has_contact)
    append_contact(row);
  for (unsigned int body = 0; body < scene.n_bodies(); ++body)
    for (unsigned int d = 0; d < dim; ++d)
      row.emplace_back(fmt::format("velocity {} of {} [m/s]", "xyz"[d], scene.body_names[body]),
                       results.history.back().bodies[body].velocity[d]);
  if (statistics)
    statistics->write(row);
  progress.step(fmt::format("step {}  t {:.5g}  dt {:.3e}  pairs {}  penetration/h {:.2e}  ledger {:+.2e}",
                            results.n_steps, state.time, time_step, results.contact.n_active,
                            results.contact.max_penetration_over_thickness, energy.residual()),
                state.time / end);
  if (!std::isfinite(energy.kinetic + energy.elastic))
    throw NumericalError(
      Complaint(fmt::format("the motion is no longer a number at t = {:.6g}: an element was turned inside out",
                            state.time))
        .advise("look at the last fields; refine, or lower the step factors"));
  const double tolerance = std::get<ExplicitParameters>(parameters.solver).ledger_tolerance;
  if (std::abs(energy.residual()) > tolerance)
    throw NumericalError(Complaint(fmt::format("the energy ledger does not close at t = {:.6g}", state.time))
                           .found(fmt::format("{:+.3g} of the largest energy", energy.residual()))
                           .expected(fmt::format("at most {}", tolerance))
                           .advise("lower Explicit/Contact step factor or Contact/Penalty factor, or refine"));
}

template class Simulation<2>;
template class Simulation<3>;
} // namespace signorini
