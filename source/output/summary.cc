// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/output/summary.h"

#include "signorini/base/exceptions.h"
#include "signorini/base/version.h"
#include "signorini/output/collisions.h"
#include "signorini/output/exact_solution.h"
#include "signorini/output/statistics.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>

namespace signorini
{
namespace
{
using Json = nlohmann::ordered_json;

template <int dim>
Json describe_parts(const Results<dim> &results)
{
  Json left_out = Json::array();
  for (const LeftOutPart &part : results.parts_left_out)
    left_out.push_back({{"name", part.name}, {"reason", part.reason}});
  return {{"built", results.parts_built}, {"left_out", left_out}};
}

template <int dim>
Json describe_resultants(const Results<dim> &results)
{
  Json resultants = Json::array();
  for (const ContactResultant &resultant : results.resultants)
    resultants.push_back(
        {{"name", resultant.on + " from " + resultant.from},
         {"on", resultant.on},
         {"from", resultant.from},
         {"force", std::vector<double>(resultant.force.begin(), resultant.force.begin() + dim)}});
  return resultants;
}

template <int dim>
Json describe_supports(const Results<dim> &results)
{
  Json supports = Json::array();
  for (const SupportForce &support : results.support_forces)
  {
    const std::string component(1, "xyz"[support.component]);
    supports.push_back({{"name", component + " on " + support.body + " at " + support.boundary},
                        {"body", support.body},
                        {"boundary", support.boundary},
                        {"component", component},
                        {"force", support.force}});
  }
  return supports;
}

template <int dim>
Json describe_moving_obstacles(const Results<dim> &results)
{
  Json moving = Json::array();
  const Parameters &parameters = *results.parameters;
  for (std::size_t i = 0; i < parameters.obstacles.size() && !results.history.empty(); ++i)
    if (!parameters.obstacles[i].displacement.empty())
    {
      const Triple &shift = results.history.back().bodies[parameters.bodies.size() + i].displacement;
      moving.push_back({{"name", parameters.obstacles[i].name},
                        {"displacement", std::vector<double>(shift.begin(), shift.begin() + dim)}});
    }
  return moving;
}

template <int dim>
Json describe_collisions(const Results<dim> &results)
{
  Json collisions = Json::array();
  for (const Collision &collision : results.collisions)
    collisions.push_back({{"one", name_of_collider(*results.parameters, collision.one)},
                          {"other", name_of_collider(*results.parameters, collision.other)},
                          {"begin", collision.begin},
                          {"end", collision.end},
                          {"outcome", name_of(collision.outcome)}});
  return collisions;
}

template <int dim>
Json describe_contact(const Results<dim> &results)
{
  const contact::ContactMeasures<dim> &contact = results.contact;
  Json description{{"alpha", results.penalty_factor},
                   {"effective_stiffness", results.max_stiffness},
                   {"max_penetration", contact.max_penetration},
                   {"max_penetration_over_h", contact.max_penetration_over_thickness},
                   {"max_pressure", contact.max_pressure},
                   {"area", contact.area},
                   {"resultant", describe_resultants(results)},
                   {"n_pairs_max", results.max_n_pairs},
                   {"facets", results.n_facets},
                   {"facets_held", results.n_facets_held},
                   {"touching", contact.n_active > 0},
                   {"peak",
                    {{"max_penetration", results.max_penetration},
                     {"max_penetration_over_h", results.max_penetration_over_thickness},
                     {"max_pressure", results.max_pressure},
                     {"area", results.max_area}}}};
  if (results.has_ledger)
    description["collisions"] = describe_collisions(results);
  if (results.correction_change)
    description["correction_change"] = *results.correction_change;
  return description;
}

template <int dim>
Json describe_energy(const Results<dim> &results)
{
  const EnergyLedger &energy = results.energy;
  if (!results.has_ledger)
    return {{"elastic", energy.elastic},
            {"contact", energy.contact},
            {"plastic_work", energy.plastic_work},
            {"rubbed_off", energy.rubbed_off}};
  return {{"kinetic", energy.kinetic},
          {"elastic", energy.elastic},
          {"contact", energy.contact},
          {"dissipated", energy.dissipated},
          {"rubbed_off", energy.rubbed_off},
          {"dissipated_by_viscosity", energy.dissipated_by_viscosity},
          {"plastic_work", energy.plastic_work},
          {"work", energy.work_of_loads + energy.work_of_supports},
          {"work_of_obstacles", energy.work_of_obstacles},
          {"contact_renewals", energy.contact_renewals},
          {"contact_loss", energy.contact_loss},
          {"adaptation", energy.adaptation},
          {"max_adaptation", energy.max_adaptation},
          {"initial", energy.initial},
          {"ledger_residual", energy.residual()},
          {"max_ledger_residual", results.max_ledger_residual}};
}

template <int dim>
Json describe_traffic(const Results<dim> &results)
{
  const auto per_step = [n_steps = std::max(1u, results.n_steps)](std::uint64_t number)
  { return static_cast<double>(number) / n_steps; };
  const Traffic &traffic = results.traffic;
  return {{"messages_per_step", per_step(traffic.n_messages)},
          {"bytes_per_step", per_step(traffic.n_bytes)},
          {"collectives_per_step", per_step(traffic.n_collectives)},
          {"collective_bytes_per_step", per_step(traffic.n_collective_bytes)}};
}

Json describe_estimate(const ErrorEstimate &estimate)
{
  return {{"discretization", estimate.relative(estimate.discretization)},
          {"contact", estimate.relative(estimate.contact)},
          {"total", estimate.relative(estimate.total())},
          {"energy_norm", std::sqrt(estimate.energy)}};
}

template <int dim>
Json describe_errors(const Results<dim> &results)
{
  Json errors = Json::array();
  for (const ErrorRow &row : results.errors)
    errors.push_back({{"quantity", row.quantity},
                      {"computed", row.computed},
                      {"exact", row.exact},
                      {"relative_error", row.relative_error}});
  return errors;
}
} // namespace

template <int dim>
void write_summary(const Results<dim> &results, const std::string &input, unsigned int n_ranks,
                   const std::string &directory)
{
  Json summary{{"program", "signorini"},     {"version", program_version()},
               {"status", results.status},   {"input", input},
               {"n_ranks", n_ranks},         {"parts", describe_parts(results)},
               {"n_dofs", results.n_dofs},   {"n_cells", results.n_cells},
               {"n_steps", results.n_steps}, {"n_iterations", results.n_iterations}};
  if (!results.reason.empty())
    summary["reason"] = results.reason;
  summary["warnings"] = results.warnings;
  summary["run_time"] = {{"total", results.total_run_time}, {"sections", results.run_time}};
  summary["memory_peak_mb"] = results.memory_peak_mb;
  if (results.memory)
  {
    summary["memory"] = {{"bytes_per_cell", std::round(results.memory->mesh / results.n_cells)},
                         {"bytes_of_solver_per_dof", std::round(results.memory->solver / results.n_dofs)}};
    if (results.n_facets > 0)
      summary["memory"]["bytes_per_contact_face"] = std::round(results.memory->contact / results.n_facets);
  }
  if (n_ranks > 1)
    summary["traffic"] = describe_traffic(results);
  if (results.has_contact)
    summary["contact"] = describe_contact(results);
  if (const Json moving = describe_moving_obstacles(results); !moving.empty())
    summary["obstacles"] = moving;
  if (!results.support_forces.empty())
    summary["supports"] = describe_supports(results);
  summary["energy"] = describe_energy(results);
  summary["estimate"] = describe_estimate(results.estimate);
  if (results.has_ledger)
    summary["momentum"] = {{"linear_drift", results.max_linear_drift},
                           {"angular_drift", results.max_angular_drift}};
  summary["errors"] = describe_errors(results);

  const std::string name = directory + "/summary.json";
  std::ofstream file(name);
  file << summary.dump(2) << '\n';
  if (!file.flush())
    throw FileError("cannot write '" + name + "': is the disk full?");
}

template <int dim>
void write_profile(const Results<dim> &results, const std::string &directory)
{
  if (!has_exact_profile(*results.parameters))
    return;
  Statistics profile(directory + "/profile.csv");
  for (const auto &sample : results.samples)
  {
    const double radius = sample.position.template head<dim - 1>().norm();
    profile.write({{"radius [m]", radius},
                   {"pressure [Pa]", sample.pressure},
                   {"exact pressure [Pa]", exact_pressure(results, radius)}});
  }
}

template void write_summary<2>(const Results<2> &, const std::string &, unsigned int, const std::string &);
template void write_summary<3>(const Results<3> &, const std::string &, unsigned int, const std::string &);
template void write_profile<2>(const Results<2> &, const std::string &);
template void write_profile<3>(const Results<3> &, const std::string &);
} // namespace signorini
