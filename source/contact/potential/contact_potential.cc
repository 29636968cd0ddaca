// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/potential/contact_potential.h"

#include "signorini/contact/potential/pair_tangent.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace signorini::contact
{
namespace
{
/// Share of the skin up to which a gap counts as closed in the tangent.
constexpr double verge = 1e-8;

/// Cosine from which on a facet counts as facing the other surface.
constexpr double facing = 0.1;
} // namespace

template <int dim>
ContactPotential<dim>::ContactPotential(const ContactSurface<dim> &contact_surface, Obstacles obstacles,
                                        PotentialSettings settings)
    : surface(contact_surface), pairs(contact_surface, std::move(obstacles), std::move(settings))
{
}

template <int dim>
double ContactPotential<dim>::update(const Positions &positions)
{
  if (has_pairs && !is_stale(positions) && pairs.settings().integration == Integration::face_quadrature)
    return 0.;

  double old_energy = 0.;
  if (has_pairs)
  {
    evaluate(positions);
    old_energy = energy();
  }
  pairs.renew(positions);
  is_evaluated = false;
  evaluate(positions);
  return std::exchange(has_pairs, true) ? energy() - old_energy : 0.;
}

template <int dim>
bool ContactPotential<dim>::is_stale(const Positions &positions) const
{
  return pairs.is_stale(positions);
}

template <int dim>
void ContactPotential<dim>::evaluate(const Positions &positions)
{
  // A renewal has to look at the same positions before and after: do not do the work again for its caller.
  if (is_evaluated && positions == evaluated_positions)
    return;
  evaluated_positions = positions;
  evaluate_body_pairs();
  evaluate_obstacle_pairs();
  is_evaluated = true;
}

template <int dim>
void ContactPotential<dim>::evaluate_body_pairs()
{
  const auto &body_pairs = pairs.body_pairs();
  body_feet.resize(body_pairs.size());
  if (body_pairs.empty())
    return;
  const double motion = pairs.bound_motion(evaluated_positions);
  for (std::size_t i = 0; i < body_pairs.size(); ++i)
    body_feet[i] = evaluate_body_pair(body_pairs[i], motion);
}

template <int dim>
PairFoot<dim> ContactPotential<dim>::evaluate_body_pair(const ContactPair<dim> &pair, double motion) const
{
  PairFoot<dim> result;
  result.position = interpolate(surface.facets[pair.facet], pair.shape, evaluated_positions);
  // A foot cannot have gone farther away than the nodes have moved; knowing that rules out most candidates.
  const double cutoff = std::min(pairs.reach(pair.facet),
                                 (1. + 1e-6) * (pair.distance_when_made + motion) + 1e-9 * pairs.skin());
  const SurfaceFoot<dim> foot = pairs.find_body_foot(pair, evaluated_positions, result.position, cutoff);
  result.depth = foot.depth;
  if (result.depth <= -pairs.skin())
    return result;

  const Facet<dim> &target = surface.facets[foot.facet];
  result.facet = foot.facet;
  result.closest = foot.closest;
  result.gap = result.position - foot.closest.position;
  result.shape = evaluate_facet_shape<dim>(target.degree, foot.closest.xi).value;
  const bool is_inside_facet =
      std::all_of(foot.closest.free.begin(), foot.closest.free.end(), [](bool is_free) { return is_free; });
  if (!is_inside_facet && foot.closest.distance > 1e-9 * target.layer_thickness)
  {
    result.normal = result.gap / -foot.depth;
    return result;
  }
  // Inside a facet, or too close for the gap to have a direction, the facet's normal is the direction: it has
  // none of the round-off that the gap takes from coordinates many orders larger than itself.
  result.normal = evaluate_facet_frame(gather_nodes(target, evaluated_positions), foot.closest.xi)
                      .area_normal.normalized();
  result.depth = -result.gap.dot(result.normal);
  result.gap = -result.depth * result.normal;
  return result;
}

template <int dim>
void ContactPotential<dim>::evaluate_obstacle_pairs()
{
  const auto &obstacle_pairs = pairs.obstacle_pairs();
  obstacle_feet.resize(obstacle_pairs.size());
  obstacle_hessians.resize(obstacle_pairs.size());
  std::size_t first = 0;
  for (unsigned int o = 0; o < pairs.obstacles().size(); ++o)
  {
    obstacle_points.clear();
    for (std::size_t i = first; i < obstacle_pairs.size() && obstacle_pairs[i].target == o; ++i)
      obstacle_points.push_back(
          interpolate(surface.facets[obstacle_pairs[i].facet], obstacle_pairs[i].shape, evaluated_positions));
    pairs.obstacles()[o]->find_feet(obstacle_points, raw_obstacle_feet);
    for (std::size_t i = 0; i < obstacle_points.size(); ++i)
    {
      PairFoot<dim> &foot = obstacle_feet[first + i];
      foot.depth = raw_obstacle_feet[i].depth;
      foot.normal = raw_obstacle_feet[i].normal;
      foot.gap = -foot.depth * foot.normal;
      foot.position = obstacle_points[i];
      obstacle_hessians[first + i] = raw_obstacle_feet[i].depth_hessian;
    }
    first += obstacle_points.size();
  }
}

template <int dim>
typename ContactPotential<dim>::NearPair ContactPotential<dim>::make_near_pair(const ContactPair<dim> &pair,
                                                                               const PairFoot<dim> &foot,
                                                                               bool has_target_facet) const
{
  NearPair near{pair, foot, has_target_facet ? &surface.facets[foot.facet] : nullptr, {}};
  near.stencil.add(surface.facets[pair.facet], pair.shape, 1.);
  if (has_target_facet)
    near.stencil.add(*near.target, foot.shape, -1.);
  return near;
}

template <int dim>
template <typename Visit>
void ContactPotential<dim>::for_each_pair_deeper_than(double least_depth, const Visit &visit) const
{
  for (std::size_t i = 0; i < body_feet.size(); ++i)
    if (body_feet[i].depth > least_depth)
      visit(make_near_pair(pairs.body_pairs()[i], body_feet[i], true));
  for (std::size_t i = 0; i < obstacle_feet.size(); ++i)
    if (obstacle_feet[i].depth > least_depth)
      visit(make_near_pair(pairs.obstacle_pairs()[i], obstacle_feet[i], false));
}

template <int dim>
double ContactPotential<dim>::energy() const
{
  double sum = 0.;
  const auto add = [&sum](const auto &list, const auto &feet)
  {
    for (std::size_t i = 0; i < feet.size(); ++i)
      if (feet[i].is_active())
        sum += .5 * list[i].area * list[i].stiffness * feet[i].depth * feet[i].depth;
  };
  add(pairs.body_pairs(), body_feet);
  add(pairs.obstacle_pairs(), obstacle_feet);
  return sum;
}

template <int dim>
void ContactPotential<dim>::add_forces(std::vector<SpatialVector<dim>> &forces) const
{
  for_each_pair_deeper_than(0.,
                            [&forces](const NearPair &near)
                            {
                              const SpatialVector<dim> force =
                                  -near.pair.area * near.pair.stiffness * near.foot.gap;
                              for (unsigned int a = 0; a < near.stencil.n_nodes; ++a)
                                forces[near.stencil.node[a]] += near.stencil.weight[a] * force;
                            });
}

template <int dim>
double ContactPotential<dim>::depth_rate(const NearPair &near,
                                         const std::vector<SpatialVector<dim>> &velocities) const
{
  SpatialVector<dim> gap_rate = SpatialVector<dim>::Zero();
  for (unsigned int a = 0; a < near.stencil.n_nodes; ++a)
    gap_rate += near.stencil.weight[a] * velocities[near.stencil.node[a]];
  return -near.foot.normal.dot(gap_rate);
}

template <int dim>
double ContactPotential<dim>::damping_pressure(const NearPair &near, double rate) const
{
  // What is added to k_A d may take all of it away, but not more: surfaces do not stick.
  return std::max(near.pair.damping * rate, -near.pair.stiffness * near.foot.depth);
}

template <int dim>
double ContactPotential<dim>::add_damping_forces(const std::vector<SpatialVector<dim>> &velocities,
                                                 std::vector<SpatialVector<dim>> &forces) const
{
  double power = 0.;
  if (!pairs.settings().damping_ratio)
    return power;
  for_each_pair_deeper_than(0.,
                            [&](const NearPair &near)
                            {
                              const double rate = depth_rate(near, velocities);
                              const double pressure = damping_pressure(near, rate);
                              power += near.pair.area * pressure * rate;
                              const SpatialVector<dim> force = near.pair.area * pressure * near.foot.normal;
                              for (unsigned int a = 0; a < near.stencil.n_nodes; ++a)
                                forces[near.stencil.node[a]] += near.stencil.weight[a] * force;
                            });
  return power;
}

template <int dim>
void ContactPotential<dim>::for_each_tangent(
    const std::function<void(const std::vector<unsigned int> &nodes, const Eigen::MatrixXd &block)> &add)
    const
{
  std::vector<unsigned int> nodes;
  Eigen::MatrixXd block;
  for_each_pair_deeper_than(
      -verge * pairs.skin(),
      [&](const NearPair &near)
      {
        nodes.assign(near.stencil.node.begin(), near.stencil.node.begin() + near.stencil.n_nodes);
        if (near.target != nullptr)
          compute_body_tangent(near.pair, near.foot, near.stencil,
                               gather_nodes(*near.target, evaluated_positions), block);
        else
          compute_obstacle_tangent(near.pair, near.foot, near.stencil,
                                   obstacle_hessians[&near.foot - obstacle_feet.data()], block);
        add(nodes, block);
      });
}

template <int dim>
void ContactPotential<dim>::for_each_coupling(
    const std::function<void(const std::vector<unsigned int> &nodes)> &add) const
{
  const auto append_nodes = [this](unsigned int facet, std::vector<unsigned int> &nodes)
  {
    const Facet<dim> &owner = surface.facets[facet];
    nodes.insert(nodes.end(), owner.nodes.begin(), owner.nodes.begin() + owner.n_nodes());
  };
  std::vector<unsigned int> nodes;
  for (const FacetNeighbours &neighbours : pairs.neighbours())
  {
    nodes.clear();
    append_nodes(neighbours.facet, nodes);
    for (const unsigned int candidate : neighbours.candidates)
      append_nodes(candidate, nodes);
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    add(nodes);
  }
}

template <int dim>
void ContactPotential<dim>::add_row_sum_bounds(std::vector<double> &stiffness,
                                               std::vector<double> &damping) const
{
  for_each_pair_deeper_than(-pairs.skin(),
                            [&](const NearPair &near)
                            {
                              double sum = 0.;
                              for (unsigned int a = 0; a < near.stencil.n_nodes; ++a)
                                sum += std::abs(near.stencil.weight[a]);
                              for (unsigned int a = 0; a < near.stencil.n_nodes; ++a)
                              {
                                const double row_sum =
                                    near.pair.area * std::abs(near.stencil.weight[a]) * sum;
                                stiffness[near.stencil.node[a]] += near.pair.stiffness * row_sum;
                                damping[near.stencil.node[a]] += near.pair.damping * row_sum;
                              }
                            });
}

template <int dim>
ContactMeasures<dim> ContactPotential<dim>::measure() const
{
  ContactMeasures<dim> measures;
  measures.resultants.assign(surface.n_bodies, SpatialVector<dim>::Zero());
  for (const auto *list : {&pairs.body_pairs(), &pairs.obstacle_pairs()})
    for (const ContactPair<dim> &pair : *list)
    {
      ++measures.n_pairs;
      measures.max_stiffness = std::max(measures.max_stiffness, pair.stiffness);
    }
  for_each_pair_deeper_than(0., [&](const NearPair &near) { add_to_measures(near, measures); });
  return measures;
}

template <int dim>
void ContactPotential<dim>::add_to_measures(const NearPair &near, ContactMeasures<dim> &measures) const
{
  const Facet<dim> &contactor = surface.facets[near.pair.facet];
  const double depth = near.foot.depth;
  ++measures.n_active;
  measures.area += near.pair.area;
  measures.max_penetration = std::max(measures.max_penetration, depth);
  measures.max_pressure = std::max(measures.max_pressure, near.pair.stiffness * depth);
  const double thickness = near.target == nullptr ? contactor.layer_thickness
                                                  : std::min(contactor.layer_thickness, near.target->room);
  if (depth / thickness > measures.max_penetration_over_thickness)
  {
    measures.max_penetration_over_thickness = depth / thickness;
    measures.deepest_facet = near.pair.facet;
    measures.deepest_position = near.foot.position;
  }

  const SpatialVector<dim> force = -near.pair.area * near.pair.stiffness * near.foot.gap;
  measures.resultants[contactor.body] += force;
  if (near.target != nullptr)
    measures.resultants[near.target->body] -= force;
}

template <int dim>
PairForces<dim> ContactPotential<dim>::pair_forces(const std::vector<SpatialVector<dim>> &velocities) const
{
  PairForces<dim> forces;
  const bool is_damped = pairs.settings().damping_ratio && !velocities.empty();
  const auto add = [](typename PairForces<dim>::Table &table, unsigned int one, unsigned int other,
                      const SpatialVector<dim> &force) {
    table.try_emplace({one, other}, SpatialVector<dim>::Zero()).first->second += force;
  };
  for_each_pair_deeper_than(0.,
                            [&](const NearPair &near)
                            {
                              double pressure = near.pair.stiffness * near.foot.depth;
                              if (is_damped)
                                pressure += damping_pressure(near, depth_rate(near, velocities));
                              const SpatialVector<dim> force = near.pair.area * pressure * near.foot.normal;
                              const unsigned int body = surface.facets[near.pair.facet].body,
                                                 other = near.pair.target;
                              if (near.target == nullptr)
                                add(forces.obstacles, body, other, force);
                              else if (body < other)
                                add(forces.bodies, body, other, force);
                              else
                                add(forces.bodies, other, body, -force);
                            });
  return forces;
}

template <int dim>
std::vector<double> ContactPotential<dim>::facet_errors() const
{
  std::vector<double> errors(surface.facets.size(), 0.);
  for_each_pair_deeper_than(0.,
                            [&](const NearPair &near) {
                              errors[near.pair.facet] +=
                                  near.pair.area * near.pair.stiffness * near.foot.depth * near.foot.depth;
                            });
  return errors;
}

template <int dim>
std::vector<bool> ContactPotential<dim>::active_facets() const
{
  std::vector<bool> is_active(surface.facets.size(), false);
  for_each_pair_deeper_than(0., [&](const NearPair &near) { is_active[near.pair.facet] = true; });
  return is_active;
}

template <int dim>
std::vector<ContactSample<dim>> ContactPotential<dim>::samples() const
{
  std::vector<ContactSample<dim>> all;
  for_each_pair_deeper_than(
      -pairs.skin(),
      [&](const NearPair &near)
      {
        const FacetNodes<dim> contactor = gather_nodes(surface.facets[near.pair.facet], evaluated_positions);
        const auto frame = evaluate_facet_frame(contactor, near.pair.xi);
        if (frame.area_normal.dot(near.foot.normal) > -facing * frame.area_normal.norm())
          return;
        const double depth = near.foot.depth;
        all.push_back({near.pair.facet, near.pair.xi, near.foot.position, depth,
                       near.pair.stiffness * std::max(depth, 0.), near.pair.area,
                       (near.target != nullptr ? 2. : 1.) * near.pair.area});
      });
  return all;
}

template class ContactPotential<2>;
template class ContactPotential<3>;
} // namespace signorini::contact
