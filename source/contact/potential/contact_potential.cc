// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/potential/contact_potential.h"

#include "signorini/contact/potential/foot_slide.h"
#include "signorini/contact/potential/pair_tangent.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace signorini::contact
{
namespace
{
/// Adds a force to the nodes of a facet.
template <int dim>
void spread(const SpatialVector<dim> &force, const Facet<dim> &facet,
            const std::array<double, Facet<dim>::max_n_nodes> &shape, std::vector<SpatialVector<dim>> &forces)
{
  const unsigned int n_nodes = facet.n_nodes();
  for (unsigned int a = 0; a < n_nodes; ++a)
    forces[facet.nodes[a]] += shape[a] * force;
}

/// Adds a force on the contactor, and what it is on the target, if that is a body.
template <typename NearPair, int dim>
void add_on_both(const NearPair &near, const SpatialVector<dim> &force,
                 std::vector<SpatialVector<dim>> &forces)
{
  spread<dim>(force, near.contactor, near.pair.shape, forces);
  if (near.target != nullptr)
    spread<dim>(-force, *near.target, near.foot.shape, forces);
}
} // namespace

template <int dim>
ContactPotential<dim>::ContactPotential(const ContactSurface<dim> &contact_surface, Obstacles obstacles,
                                        PotentialSettings settings)
    : surface(contact_surface), pairs(contact_surface, std::move(obstacles), std::move(settings))
{
  places.shifts.assign(pairs.obstacles().size(), SpatialVector<dim>::Zero());
  places.velocities = places.shifts;
  places_before = places;
}

template <int dim>
void ContactPotential<dim>::move_obstacles(const ObstaclePlaces<dim> &new_places)
{
  if (has_pairs && new_places.time == places.time)
    return;
  places_before = has_pairs ? places : new_places;
  places = new_places;
  pairs.move_obstacles(places.shifts);
  is_evaluated = false;
}

template <int dim>
double ContactPotential<dim>::update(const Positions &positions)
{
  if (is_stale(positions))
    return search(positions, [&positions]() { return positions; });
  if (pairs.settings().integration == Integration::face_quadrature)
    return 0.;
  evaluate(positions);
  return renew(positions, energy());
}

template <int dim>
double ContactPotential<dim>::search(const Positions &positions,
                                     const std::function<Positions()> &take_facets)
{
  if (has_pairs)
    evaluate(positions);
  const double old_energy = energy();
  const Positions at_nodes_held_now = take_facets();
  pairs.search(at_nodes_held_now);
  return renew(at_nodes_held_now, old_energy);
}

template <int dim>
double ContactPotential<dim>::renew(const Positions &positions, double old_energy)
{
  const typename PairList<dim>::Feet found = pairs.renew(positions);
  move_to(positions);
  body_feet.restart(pairs, found);
  find_all();
  return std::exchange(has_pairs, true) ? energy() - old_energy : 0.;
}

template <int dim>
void ContactPotential<dim>::set_penalty_factor(double penalty_factor)
{
  pairs.set_penalty_factor(penalty_factor);
  measures_of_forces.reset();
  body_feet.note_offsets();
}

template <int dim>
void ContactPotential<dim>::set_multipliers(NodalPressures<dim> multipliers)
{
  pairs.set_multipliers(std::move(multipliers));
  measures_of_forces.reset();
  body_feet.note_offsets();
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
  move_to(positions);
  find_all();
}

template <int dim>
void ContactPotential<dim>::find_all()
{
  find_feet(0.);
  evaluate_obstacle_pairs();
  is_evaluated = true;
}

template <int dim>
void ContactPotential<dim>::move_to(const Positions &positions)
{
  if (is_linear() || evaluated_positions.size() != positions.size())
    body_feet.forget(pairs);
  else
  {
    // What all nodes do in common brings none nearer to another: only how far they are from the middle of
    // their motions counts.
    double largest_square = 0.;
    SpatialVector<dim> low = SpatialVector<dim>::Constant(std::numeric_limits<double>::max()), high = -low;
    for (std::size_t node = 0; node < positions.size(); ++node)
    {
      const SpatialVector<dim> motion = positions[node] - evaluated_positions[node];
      low = low.cwiseMin(motion);
      high = high.cwiseMax(motion);
      if (const double square = motion.squaredNorm(); !(square <= largest_square))
        largest_square = square;
    }
    body_feet.note_motion(pairs.largest_motion_factor() *
                          std::min(std::sqrt(largest_square), .5 * (high - low).norm()));
  }
  evaluated_positions = positions;
  measures_of_forces.reset();
  start_depths.clear();
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
      foot.position = obstacle_points[i];
      obstacle_hessians[first + i] = raw_obstacle_feet[i].depth_hessian;
    }
    first += obstacle_points.size();
  }
}

template <int dim>
double ContactPotential<dim>::energy() const
{
  double sum = 0.;
  for_each_overlap_above(0., [&sum](const NearPair &near)
                         { sum += .5 * near.pair.area * near.pair.stiffness * std::pow(near.overlap(), 2); });
  return sum;
}

template <int dim>
void ContactPotential<dim>::add_forces(std::vector<SpatialVector<dim>> &forces) const
{
  // A second pass over the points, to measure them, would cost as much again.
  ContactMeasures<dim> measures = begin_measures();
  for_each_overlap_above(0.,
                         [&](const NearPair &near)
                         {
                           add_on_both<NearPair, dim>(near, near.force(), forces);
                           add_to_measures(near, measures);
                         });
  measures_of_forces = std::move(measures);
}

template <int dim>
double ContactPotential<dim>::depth_rate(const NearPair &near,
                                         const std::vector<SpatialVector<dim>> &velocities) const
{
  // In an implicit step only the part of the way on which the point touches counts.
  if (is_linear())
    return (near.foot.depth - std::max(start_depths[near.index], 0.)) / linear_time_step;
  const SpatialVector<dim> of_target = near.target == nullptr
                                           ? places.velocities[near.pair.target]
                                           : interpolate(*near.target, near.foot.shape, velocities);
  return near.foot.normal.dot(of_target - interpolate(near.contactor, near.pair.shape, velocities));
}

template <int dim>
double ContactPotential<dim>::damping_pressure(const NearPair &near, double rate) const
{
  // What is added to k_A d may take all of it away, but not more: surfaces do not stick.
  return std::max(near.pair.damping * rate, -near.pressure());
}

template <int dim>
double ContactPotential<dim>::add_damping_forces(const std::vector<SpatialVector<dim>> &velocities,
                                                 std::vector<SpatialVector<dim>> &forces) const
{
  double power = 0.;
  if (!pairs.settings().damping_ratio)
    return power;
  for_each_overlap_above(0.,
                         [&](const NearPair &near)
                         {
                           const double rate = depth_rate(near, velocities);
                           const double pressure = damping_pressure(near, rate);
                           power += near.pair.area * pressure * rate;
                           add_on_both<NearPair, dim>(near, near.pair.area * pressure * near.foot.normal,
                                                      forces);
                         });
  return power;
}

template <int dim>
void ContactPotential<dim>::add_all_forces(const std::vector<SpatialVector<dim>> &velocities,
                                           std::vector<SpatialVector<dim>> &forces,
                                           std::vector<SpatialVector<dim>> &damping_forces) const
{
  ContactMeasures<dim> measures = begin_measures();
  for_each_overlap_above(0.,
                         [&](const NearPair &near)
                         {
                           const double damping = damping_pressure(near, depth_rate(near, velocities));
                           add_on_both<NearPair, dim>(near, near.force(), forces);
                           add_on_both<NearPair, dim>(near, near.pair.area * damping * near.foot.normal,
                                                      damping_forces);
                           add_to_measures(near, measures);
                         });
  measures_of_forces = std::move(measures);
}

template <int dim>
void ContactPotential<dim>::for_each_tangent(
    const std::function<void(const std::vector<unsigned int> &nodes, const Eigen::MatrixXd &block)> &add,
    bool is_convex) const
{
  // Points that follow each other mostly lie on the same two facets.
  std::vector<unsigned int> nodes, nodes_of_sum;
  Eigen::MatrixXd block, sum;
  for_each_overlap_above(
      -verge * pairs.skin(),
      [&](const NearPair &near)
      {
        nodes.assign(near.stencil.node.begin(), near.stencil.node.begin() + near.stencil.n_nodes);
        if (is_linear() || is_convex)
          compute_obstacle_tangent(near.pair, near.foot, near.stencil,
                                   SpatialTensor<dim>(SpatialTensor<dim>::Zero()), block);
        else if (near.target != nullptr)
          compute_body_tangent(near.pair, near.foot, near.stencil,
                               gather_nodes(*near.target, evaluated_positions), block);
        else
          compute_obstacle_tangent(near.pair, near.foot, near.stencil, obstacle_hessian(near), block);
        if (near.target != nullptr && near.target->body == near.contactor.body)
          merge_nodes<dim>(nodes, block);
        if (nodes == nodes_of_sum)
          sum += block;
        else
        {
          if (!nodes_of_sum.empty())
            add(nodes_of_sum, sum);
          nodes_of_sum = nodes;
          sum = block;
        }
      });
  if (!nodes_of_sum.empty())
    add(nodes_of_sum, sum);
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
  for_each_overlap_above(-pairs.skin(),
                         [&](const NearPair &near)
                         {
                           double sum = 0.;
                           for (unsigned int a = 0; a < near.stencil.n_nodes; ++a)
                             sum += std::abs(near.stencil.weight[a]);
                           for (unsigned int a = 0; a < near.stencil.n_nodes; ++a)
                           {
                             const double row_sum = near.pair.area * std::abs(near.stencil.weight[a]) * sum;
                             stiffness[near.stencil.node[a]] += near.pair.stiffness * row_sum;
                             damping[near.stencil.node[a]] += near.pair.damping * row_sum;
                           }
                         });
}

template class ContactPotential<2>;
template class ContactPotential<3>;
} // namespace signorini::contact
