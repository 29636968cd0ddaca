// SPDX-License-Identifier: LGPL-2.1-or-later
// What all runs in motion share: how they start and what they write on the way.
#include "signorini/simulation/simulation.h"

#include "signorini/base/exceptions.h"
#include "signorini/physics/mass.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace signorini
{
template <int dim>
void Simulation<dim>::check_start(const typename SupportedDofs<dim>::Entry &entry) const
{
  constexpr double round_off = 1e-12;
  const double end_time = std::visit([](const auto &run) { return run.end_time; }, parameters.solver);
  const double start = supports->value(entry, 0.);
  if (std::abs(start) <= round_off * std::abs(supports->value(entry, end_time)))
    return;
  const Support<dim> &support = scene.supports[entry.support];
  throw InputError(Complaint(fmt::format("the displacement of a support starts at {:.6g} m, not 0: the run "
                                         "would begin with a shock",
                                         start))
                       .at(support.description)
                       .found(support.displacement.formula())
                       .expected("0 at t = 0")
                       .advise("let it grow with t, or move the body by Placement/Shift"));
}

template <int dim>
void Simulation<dim>::set_initial_motion()
{
  for (const auto &entry : supports->entries())
    check_start(entry);
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
void Simulation<dim>::begin_records(MotionSolver<dim> &solver, double end)
{
  record_motion(solver, 0., end);
  estimate_error();
  write_fields();
}

template <int dim>
void Simulation<dim>::record_when_due(MotionSolver<dim> &solver, double time_step, double end)
{
  if (is_due(next_row, parameters.output.n_statistics, end))
  {
    solver.take_stock(state);
    record_motion(solver, time_step, end);
  }
  if (is_due(next_field, parameters.output.n_fields, end))
  {
    estimate_error();
    write_fields();
  }
  if (!(state.time < end))
    return;
  save_when_due();
  check_interruption(
      [&]()
      {
        save();
        solver.take_stock(state);
        if (results.history.back().time < state.time)
          record_motion(solver, time_step, end);
        estimate_error();
        if (time_of_fields < state.time)
          write_fields();
      });
}

template <int dim>
void Simulation<dim>::record_motion(const MotionSolver<dim> &solver, double time_step, double end)
{
  const auto joules = [](const std::string &name) { return name + (dim == 2 ? " [J/m]" : " [J]"); };
  const EnergyLedger &energy = solver.energy();
  const MomentumLedger &momentum = solver.momentum();
  results.has_ledger = true;
  results.energy = energy;
  results.momentum = momentum;
  results.max_ledger_residual = std::max(results.max_ledger_residual, std::abs(energy.residual()));
  results.max_linear_drift = std::max(results.max_linear_drift, momentum.linear_drift());
  results.max_angular_drift = std::max(results.max_angular_drift, momentum.angular_drift());
  record_state();

  Statistics::Row row{{"time [s]", state.time},
                      {"time step [s]", time_step},
                      {joules("kinetic energy"), energy.kinetic},
                      {joules("elastic energy"), energy.elastic},
                      {joules("contact energy"), energy.contact},
                      {joules("dissipated since the start"), energy.dissipated},
                      {joules("work since the start"), energy.work_of_loads + energy.work_of_supports},
                      {joules("renewed contact energy since the start"), energy.contact_renewals},
                      {"ledger residual [1]", energy.residual()},
                      {"linear momentum drift [1]", momentum.linear_drift()},
                      {"angular momentum drift [1]", momentum.angular_drift()}};
  if (!forces.frictions.empty())
    row.emplace_back(joules("rubbed off since the start"), energy.rubbed_off);
  if (has_implicit_contact() || implicit_solver)
    row.emplace_back(joules("energy lost by implicit contact since the start"), energy.contact_loss);
  if (!forces.viscosities.empty())
    row.emplace_back(joules("dissipated by viscosity since the start"), energy.dissipated_by_viscosity);
  if (forces.elasticity->has_plasticity())
    row.emplace_back(joules("plastic work since the start"), energy.plastic_work);
  if (!forces.moving_contacts.empty())
    row.emplace_back(joules("work of obstacles since the start"), energy.work_of_obstacles);
  if (parameters.adaptivity)
  {
    row.emplace_back(joules("energy of adaptation since the start"), energy.adaptation);
    row.emplace_back("cells [1]", results.n_cells);
  }
  if (results.has_contact)
    append_contact(row);
  append_resultants(row);
  append_bodies(row);
  if (statistics)
    statistics->write(row);
  progress.step(fmt::format("step {}  t {:.5g}  dt {:.3e}  pairs {}  penetration/h {:.2e}  ledger {:+.2e}",
                            results.n_steps, state.time, time_step, results.contact.n_active,
                            results.contact.max_penetration_over_thickness, energy.residual()),
                state.time / end);
  check_ledger();
}

template <int dim>
typename Simulation<dim>::LedgerLimit Simulation<dim>::find_ledger_limit() const
{
  if (const auto *implicit = std::get_if<ImplicitParameters>(&parameters.solver))
    return {implicit->ledger_tolerance, "lower Implicit/Time step"};
  return {std::get<ExplicitParameters>(parameters.solver).ledger_tolerance,
          "lower the step factors of 'Explicit' or Contact/Penalty factor"};
}

template <int dim>
void Simulation<dim>::warn_of_open_ledger()
{
  constexpr double silent = 0.2, much = 0.01;
  if (!results.has_ledger ||
      results.max_ledger_residual <= std::min(much, silent * find_ledger_limit().tolerance))
    return;
  warn(fmt::format(
      "the energy ledger is open by up to {:.2g} of the largest energy: so much of it was gained or lost "
      "unseen; {}, or refine, if that counts",
      results.max_ledger_residual, find_ledger_limit().advice));
}

template <int dim>
void Simulation<dim>::check_ledger() const
{
  const EnergyLedger &energy = results.energy;
  if (!std::isfinite(energy.kinetic + energy.elastic + energy.contact))
    throw NumericalError(
        Complaint(
            fmt::format("the motion is no longer a number at t = {:.6g}: an element was turned inside out",
                        state.time))
            .advise("look at the last fields; refine, or shorten the steps"));
  const LedgerLimit limit = find_ledger_limit();
  if (std::abs(energy.residual()) <= limit.tolerance)
    return;
  Complaint fault = Complaint(fmt::format("the energy ledger does not close at t = {:.6g}", state.time))
                        .found(fmt::format("{:+.3g} of the largest energy", energy.residual()))
                        .expected(fmt::format("at most {}", limit.tolerance))
                        .advise(limit.advice + ", or refine");
  for (std::size_t row = results.history.size() - 1; row > 0; --row)
    if (scene.blame_jump(results.history[row - 1].time, results.history[row].time, fault))
      break;
  throw NumericalError(fault);
}

template class Simulation<2>;
template class Simulation<3>;
} // namespace signorini
