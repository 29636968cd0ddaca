// SPDX-License-Identifier: LGPL-2.1-or-later
// What a ContactPotential tells of its points: measures, resultants, samples.
#include "signorini/contact/potential/contact_potential.h"

#include <algorithm>
#include <cmath>

namespace signorini::contact
{
namespace
{
/// Cosine from which on a facet counts as facing the other surface.
constexpr double facing = 0.1;
} // namespace

template <int dim>
ContactMeasures<dim> ContactPotential<dim>::begin_measures() const
{
  ContactMeasures<dim> measures;
  measures.resultants.assign(surface.n_bodies, SpatialVector<dim>::Zero());
  measures.n_pairs = static_cast<unsigned int>(pairs.body_pairs().size() + pairs.obstacle_pairs().size());
  measures.max_stiffness = pairs.largest_stiffness();
  return measures;
}

template <int dim>
ContactMeasures<dim> ContactPotential<dim>::measure() const
{
  if (measures_of_forces)
    return *measures_of_forces;
  ContactMeasures<dim> measures = begin_measures();
  for_each_overlap_above(0., [&](const NearPair &near) { add_to_measures(near, measures); });
  return measures;
}

template <int dim>
void ContactPotential<dim>::add_to_measures(const NearPair &near, ContactMeasures<dim> &measures) const
{
  const double depth = near.foot.depth;
  ++measures.n_active;
  measures.area += near.pair.area;
  measures.max_penetration = std::max(measures.max_penetration, depth);
  measures.max_pressure = std::max(measures.max_pressure, near.pressure());
  const double room =
      near.target == nullptr ? pairs.obstacles()[near.pair.target]->room() : near.target->room;
  const double thickness = std::min(near.contactor.layer_thickness, room);
  if (depth / thickness > measures.max_penetration_over_thickness)
  {
    measures.max_penetration_over_thickness = depth / thickness;
    measures.deepest_body = near.contactor.body;
    measures.deepest_thickness = near.contactor.layer_thickness;
    measures.deepest_position = near.foot.position;
  }

  const SpatialVector<dim> force = near.force();
  measures.resultants[near.contactor.body] += force;
  if (near.target != nullptr)
    measures.resultants[near.target->body] -= force;
}

template <int dim>
PairForces<dim> ContactPotential<dim>::pair_forces(const std::vector<SpatialVector<dim>> &velocities) const
{
  const bool is_damped = pairs.settings().damping_ratio && !velocities.empty();
  return sum_by_pair(
      [&](const NearPair &near)
      {
        const double pressure = is_damped ? total_pressure(near, velocities) : near.pressure();
        return SpatialVector<dim>(near.pair.area * pressure * near.foot.normal);
      });
}

template <int dim>
PairForces<dim>
ContactPotential<dim>::sum_by_pair(const std::function<SpatialVector<dim>(const NearPair &)> &force_of) const
{
  PairForces<dim> forces;
  const auto add = [](typename PairForces<dim>::Table &table, unsigned int one, unsigned int other,
                      const SpatialVector<dim> &force) {
    table.try_emplace({one, other}, SpatialVector<dim>::Zero()).first->second += force;
  };
  for_each_overlap_above(0.,
                         [&](const NearPair &near)
                         {
                           const SpatialVector<dim> force = force_of(near);
                           const unsigned int body = near.contactor.body, other = near.pair.target;
                           if (near.target == nullptr)
                             add(forces.obstacles, body, other, force);
                           else if (body == other)
                             return; // what a body does to itself cancels
                           else if (body < other)
                             add(forces.bodies, body, other, force);
                           else
                             add(forces.bodies, other, body, -force);
                         });
  return forces;
}

template <int dim>
ObstacleForces<dim>
ContactPotential<dim>::obstacle_forces(const std::vector<SpatialVector<dim>> &velocities) const
{
  const Positions zeros(pairs.obstacles().size(), SpatialVector<dim>::Zero());
  ObstacleForces<dim> forces{zeros, zeros};
  for_each_overlap_above(0.,
                         [&](const NearPair &near)
                         {
                           if (near.target != nullptr)
                             return;
                           forces.conservative[near.pair.target] += near.force();
                           if (pairs.settings().damping_ratio)
                             forces.damping[near.pair.target] +=
                                 near.pair.area * damping_pressure(near, depth_rate(near, velocities)) *
                                 near.foot.normal;
                         });
  return forces;
}

template <int dim>
std::vector<double> ContactPotential<dim>::facet_errors() const
{
  // A multiplier that is larger than the pressure is an error as well, so all points count.
  std::vector<double> errors(surface.facets.size(), 0.);
  if (!is_linear())
    find_feet(0.);
  const auto add = [&errors](const auto &list, const auto &feet)
  {
    for (std::size_t i = 0; i < feet.size(); ++i)
      errors[list[i].facet] +=
          list[i].area * list[i].stiffness * std::pow(std::max(feet[i].depth, -list[i].offset), 2);
  };
  add(pairs.body_pairs(), body_feet.all());
  add(pairs.obstacle_pairs(), obstacle_feet);
  return errors;
}

template <int dim>
std::vector<bool> ContactPotential<dim>::active_facets() const
{
  std::vector<bool> is_active(surface.facets.size(), false);
  for_each_overlap_above(0., [&](const NearPair &near) { is_active[near.pair.facet] = true; });
  return is_active;
}

template <int dim>
std::vector<ContactSample<dim>> ContactPotential<dim>::samples() const
{
  std::vector<ContactSample<dim>> all;
  for_each_overlap_above(
      -pairs.skin(),
      [&](const NearPair &near)
      {
        const FacetNodes<dim> contactor = gather_nodes(near.contactor, evaluated_positions);
        const auto frame = evaluate_facet_frame(contactor, near.pair.xi);
        if (frame.area_normal.dot(near.foot.normal) > -facing * frame.area_normal.norm())
          return;
        const double depth = near.foot.depth;
        all.push_back({near.pair.facet, near.pair.xi, near.foot.position, depth, near.pressure(),
                       near.pair.area, (near.target != nullptr ? 2. : 1.) * near.pair.area});
      });
  return all;
}

template class ContactPotential<2>;
template class ContactPotential<3>;
} // namespace signorini::contact
