// SPDX-License-Identifier: LGPL-2.1-or-later
// What a Simulation takes down of a moment: forces by pair and support, motions by body, and their columns.
#include "signorini/parameters/contact_parameters.h"
#include "signorini/simulation/simulation.h"

#include <fmt/core.h>

#include <algorithm>
#include <limits>

namespace signorini
{
namespace
{
/// In scenes of more bodies none has columns or resultants of its own.
constexpr unsigned int max_n_bodies_by_name = 10;

constexpr const char *force_unit(int dim)
{
  return dim == 2 ? "N/m" : "N";
}

template <int dim>
void add_to(Triple &sum, const SpatialVector<dim> &vector, double factor)
{
  for (unsigned int d = 0; d < dim; ++d)
    sum[d] += factor * vector[d];
}

template <int dim>
Triple force_of_pair(const typename contact::PairForces<dim>::Table &table, unsigned int one,
                     unsigned int other)
{
  Triple force{};
  const auto found = table.find({one, other});
  if (found != table.end())
    add_to<dim>(force, found->second, 1.);
  return force;
}
} // namespace

template <int dim>
void Simulation<dim>::record_state()
{
  record_contact(measure_terms());
  contact::PairForces<dim> pair_forces;
  for (const auto &term : forces.contacts)
    pair_forces.add(term->pair_forces(state));
  for (const auto &friction : forces.frictions)
    pair_forces.add(friction->pair_forces());
  record_bodies(pair_forces);
  record_contact_forces(pair_forces);
}

template <int dim>
void Simulation<dim>::record_bodies(const contact::PairForces<dim> &pair_forces)
{
  std::vector<BodyRecord> records(scene.n_bodies());
  for (const auto &[pair, force] : pair_forces.bodies)
  {
    add_to<dim>(records[pair.first].contact_force, force, 1.);
    add_to<dim>(records[pair.second].contact_force, force, -1.);
  }
  for (const auto &[pair, force] : pair_forces.obstacles)
    add_to<dim>(records[pair.first].contact_force, force, 1.);

  const bool is_moving = state.velocity.size() > 0;
  std::vector<double> sums(3 * dim * scene.n_bodies(), 0.);
  std::vector<double> bounds(2 * dim * scene.n_bodies(), std::numeric_limits<double>::lowest()); // −low, high
  for (const OwnedNode<dim> &node : discretization->owned_nodes)
    for (unsigned int d = 0; d < dim; ++d)
    {
      double *sum = &sums[3 * (dim * node.body + d)];
      const double volume = nodal_volume.local_element(node.dofs[d]);
      const double x = node.position[d] + state.displacement.local_element(node.dofs[d]);
      double *bound = &bounds[2 * (dim * node.body + d)];
      bound[0] = std::max(bound[0], -x);
      bound[1] = std::max(bound[1], x);
      sum[0] += volume * node.position[d];
      sum[1] += volume * state.displacement.local_element(node.dofs[d]);
      sum[2] += is_moving ? volume * state.velocity.local_element(node.dofs[d]) : 0.;
    }
  dealii::Utilities::MPI::sum(sums, communicator, sums);
  dealii::Utilities::MPI::max(bounds, communicator, bounds);
  for (unsigned int body = 0; body < scene.n_bodies(); ++body)
    for (unsigned int d = 0; d < dim; ++d)
    {
      const double *sum = &sums[3 * (dim * body + d)], volume = results.body_volumes[body];
      records[body].displacement[d] = sum[1] / volume;
      records[body].velocity[d] = sum[2] / volume;
      records[body].position[d] = (sum[0] + sum[1]) / volume;
      records[body].half_widths[d] = 0.5 * (bounds[2 * (dim * body + d)] + bounds[2 * (dim * body + d) + 1]);
    }
  for (unsigned int i = 0; i < scene.obstacles.size(); ++i)
  {
    const ObstacleMotion<dim> &motion = scene.obstacle_motions[i];
    BodyRecord record;
    record.position = parameters.obstacles[i].point;
    add_to<dim>(record.displacement, motion.displacement(state.time), 1.);
    add_to<dim>(record.position, motion.displacement(state.time), 1.);
    add_to<dim>(record.velocity, motion.velocity(state.time), is_moving ? 1. : 0.);
    records.push_back(record);
  }
  results.history.push_back({state.time, records, results.energy.rubbed_off, {}});
  auto &touching = results.history.back().touching;
  for (const auto &[pair, force] : pair_forces.bodies)
    if (force != SpatialVector<dim>::Zero())
      touching.insert(pair);
  for (const auto &[pair, force] : pair_forces.obstacles)
    if (force != SpatialVector<dim>::Zero())
      touching.emplace(pair.first, scene.n_bodies() + pair.second);
}

template <int dim>
void Simulation<dim>::record_contact_forces(const contact::PairForces<dim> &pair_forces)
{
  results.resultants.clear();
  if (!parameters.contact)
    return;
  const bool is_by_body = scene.n_bodies() <= max_n_bodies_by_name;
  for (unsigned int one = 0; one < scene.n_bodies() && is_by_body; ++one)
    for (unsigned int other = one + 1; other < scene.n_bodies(); ++other)
      if (!is_pair_excluded(*parameters.contact, scene.body_names[one], scene.body_names[other]))
        results.resultants.push_back({scene.body_names[one], scene.body_names[other],
                                      force_of_pair<dim>(pair_forces.bodies, one, other)});
  for (unsigned int obstacle = 0; obstacle < scene.obstacles.size(); ++obstacle)
  {
    const std::string &name = scene.obstacles[obstacle]->name();
    ContactResultant on_all{"all bodies", name, {}};
    for (unsigned int body = 0; body < scene.n_bodies(); ++body)
    {
      const Triple force = force_of_pair<dim>(pair_forces.obstacles, body, obstacle);
      if (is_by_body && !is_pair_excluded(*parameters.contact, scene.body_names[body], name))
        results.resultants.push_back({scene.body_names[body], name, force});
      for (unsigned int d = 0; d < 3; ++d)
        on_all.force[d] += force[d];
    }
    if (!is_by_body)
      results.resultants.push_back(on_all);
  }
}

template <int dim>
void Simulation<dim>::record_support_forces(const Vector &reactions)
{
  std::vector<double> sums(scene.supports.size(), 0.);
  for (const auto &entry : supports->entries())
    if (discretization->owned_dofs.is_element(entry.dof))
      sums[entry.support] += reactions(entry.dof);
  dealii::Utilities::MPI::sum(sums, communicator, sums);
  results.support_forces.clear();
  for (unsigned int i = 0; i < sums.size(); ++i)
  {
    const Support<dim> &support = scene.supports[i];
    results.support_forces.push_back(
        {scene.body_names[support.body], support.boundary, support.component, sums[i]});
  }
}

template <int dim>
void Simulation<dim>::append_contact(Statistics::Row &row) const
{
  const auto &contact = results.contact;
  row.emplace_back(dim == 2 ? "contact area [m]" : "contact area [m2]", contact.area);
  row.emplace_back("max penetration [m]", contact.max_penetration);
  row.emplace_back("max penetration over h [1]", contact.max_penetration_over_thickness);
  row.emplace_back("max pressure [Pa]", contact.max_pressure);
  row.emplace_back("points in contact [1]", contact.n_active);
}

template <int dim>
void Simulation<dim>::append_resultants(Statistics::Row &row) const
{
  for (const ContactResultant &resultant : results.resultants)
    for (unsigned int d = 0; d < dim; ++d)
      row.emplace_back(fmt::format("contact force {} on {} from {} [{}]", "xyz"[d], resultant.on,
                                   resultant.from, force_unit(dim)),
                       resultant.force[d]);
  for (const SupportForce &support : results.support_forces)
    row.emplace_back(fmt::format("support force {} on {} at {} [{}]", "xyz"[support.component], support.body,
                                 support.boundary, force_unit(dim)),
                     support.force);
}

template <int dim>
void Simulation<dim>::append_bodies(Statistics::Row &row) const
{
  const std::vector<BodyRecord> &bodies = results.history.back().bodies; // and the obstacles after them
  for (unsigned int i = 0; i < scene.obstacles.size(); ++i)
    for (unsigned int d = 0; d < dim && !scene.obstacle_motions[i].is_fixed(); ++d)
      row.emplace_back(fmt::format("displacement {} of {} [m]", "xyz"[d], scene.obstacles[i]->name()),
                       bodies[scene.n_bodies() + i].displacement[d]);
  if (scene.n_bodies() > max_n_bodies_by_name)
    return;
  for (unsigned int body = 0; body < scene.n_bodies(); ++body)
    for (unsigned int d = 0; d < dim; ++d)
      row.emplace_back(fmt::format("mean displacement {} of {} [m]", "xyz"[d], scene.body_names[body]),
                       bodies[body].displacement[d]);
  for (unsigned int body = 0; body < scene.n_bodies() && state.velocity.size() > 0; ++body)
    for (unsigned int d = 0; d < dim; ++d)
      row.emplace_back(fmt::format("mean velocity {} of {} [m/s]", "xyz"[d], scene.body_names[body]),
                       bodies[body].velocity[d]);
}

template class Simulation<2>;
template class Simulation<3>;
} // namespace signorini
