// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/friction/friction.h"

#include "signorini/contact/search/nearest_points.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <stdexcept>

namespace signorini::contact
{
template <int dim>
Friction<dim>::Friction(const ContactPotential<dim> &contact_potential, double friction_coefficient)
    : potential(contact_potential), coefficient(friction_coefficient)
{
  if (!(coefficient >= 0.))
    throw std::invalid_argument(
        fmt::format("The friction coefficient must not be negative, but is {}.", coefficient));
  if (potential.pair_list().settings().integration != Integration::face_quadrature)
    throw std::invalid_argument("Friction needs points that stay: face quadrature.");
}

template <int dim>
void Friction<dim>::evaluate(const std::vector<SpatialVector<dim>> &velocities)
{
  history.follow(potential.pair_list());
  if (old_positions.empty())
    begin();
  const auto let_go = [](const auto &pairs, auto &points)
  {
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      points[i].now = PointSlip<dim>();
      points[i].dissipated = .5 * pairs[i].stiffness * points[i].before.elastic.squaredNorm();
    }
  };
  let_go(potential.pair_list().body_pairs(), history.bodies);
  let_go(potential.pair_list().obstacle_pairs(), history.obstacles);
  potential.for_each_overlap_above(
      0., [&](const NearPair &near)
      { slip(near, potential.total_pressure(near, velocities), point_of(near, history)); });
}

template <int dim>
void Friction<dim>::begin()
{
  struct Group
  {
    Positions known, places;
    std::vector<const PointSlip<dim> *> slips; ///< one a known position
    std::vector<FrictionPoint<dim> *> points;  ///< one a place
  };
  std::map<typename PlacedSlip<dim>::Partners, Group> groups;
  for (const PlacedSlip<dim> &placed : remembered)
  {
    Group &group = groups[placed.partners];
    group.known.push_back(placed.position);
    group.slips.push_back(&placed.slip);
  }
  // Of two that are equally near round-off must not choose: looked for is from a little beside the point.
  SpatialVector<dim> beside;
  for (unsigned int d = 0; d < dim; ++d)
    beside[d] = 1e-6 * potential.pair_list().skin() * std::pow(.6, d);
  potential.for_each_overlap_above(0.,
                                   [&](const NearPair &near)
                                   {
                                     const auto group = groups.find(partners_of(near));
                                     if (group == groups.end())
                                       return;
                                     group->second.places.push_back(near.foot.position + beside);
                                     group->second.points.push_back(&point_of(near, history));
                                   });
  for (const auto &[partners, group] : groups)
  {
    const std::vector<unsigned int> nearest = find_nearest_points<dim>(group.known, group.places);
    for (std::size_t i = 0; i < nearest.size(); ++i)
      group.points[i]->before = *group.slips[nearest[i]];
  }
  remembered.clear();
  old_positions = potential.positions();
  old_shifts = potential.obstacle_places().shifts;
}

template <int dim>
std::vector<PlacedSlip<dim>> Friction<dim>::placed_slips() const
{
  std::vector<PlacedSlip<dim>> slips;
  potential.for_each_overlap_above(
      0.,
      [&](const NearPair &near) {
        slips.push_back({partners_of(near), near.foot.position, point_of(near, history).now});
      });
  return slips;
}

template <int dim>
auto Friction<dim>::find_target_motion(const NearPair &near) const -> TargetMotion
{
  TargetMotion motion;
  if (near.target == nullptr)
  {
    motion.shift = potential.obstacle_places().shifts[near.pair.target] - old_shifts[near.pair.target];
    return motion;
  }
  const LocalPoint<dim> &xi = near.foot.closest.xi;
  motion.turn = find_turn(FacetBasis<dim>(gather_nodes(*near.target, old_positions), xi),
                          FacetBasis<dim>(gather_nodes(*near.target, potential.positions()), xi));
  return motion;
}

template <int dim>
SpatialVector<dim> Friction<dim>::find_slip_increment(const NearPair &near, const TargetMotion &motion) const
{
  // From the target's material point at the foot (of an obstacle: from the origin) to the contactor's point.
  SpatialVector<dim> before = SpatialVector<dim>::Zero(), now = before;
  for (unsigned int a = 0; a < near.stencil.n_nodes; ++a)
  {
    before += near.stencil.weight[a] * old_positions[near.stencil.node[a]];
    now += near.stencil.weight[a] * potential.positions()[near.stencil.node[a]];
  }
  const SpatialVector<dim> moved = now - motion.turn * before - motion.shift;
  return moved - near.foot.normal.dot(moved) * near.foot.normal;
}

template <int dim>
SpatialVector<dim> Friction<dim>::carry_over(const PointSlip<dim> &before, const TargetMotion &motion,
                                             const SpatialVector<dim> &normal)
{
  if (!before.is_touching())
    return SpatialVector<dim>::Zero();
  return turn_to_plane<dim>(motion.turn * before.elastic, motion.turn * before.normal, normal);
}

template <int dim>
void Friction<dim>::slip(const NearPair &near, double pressure, FrictionPoint<dim> &point) const
{
  const CoulombLaw law{coefficient, near.pair.stiffness};
  const TargetMotion motion = find_target_motion(near);
  const SpatialVector<dim> kept = carry_over(point.before, motion, near.foot.normal);
  const SpatialVector<dim> trial = kept + find_slip_increment(near, motion);
  point.now.elastic = law.find_elastic_slip(trial, pressure);
  point.now.normal = near.foot.normal;
  point.dissipated = .5 * law.stiffness * (kept + point.now.elastic).dot(trial - point.now.elastic);
}

template <int dim>
auto Friction<dim>::find_levers(const NearPair &near) const -> typename LinearSlip<dim>::Levers
{
  typename LinearSlip<dim>::Levers levers = LinearSlip<dim>().levers;
  if (near.target == nullptr)
    return levers;
  const LocalPoint<dim> &xi = near.foot.closest.xi;
  const FacetNodes<dim> nodes = gather_nodes(*near.target, old_positions);
  const auto dual = find_oblique_dual(evaluate_facet_frame(nodes, xi), near.foot.normal);
  if (!dual)
    return levers;
  double arm = 0.; // from the place of the target that takes the force to the contactor's point
  for (unsigned int a = 0; a < near.stencil.n_nodes; ++a)
    arm += near.stencil.weight[a] * near.foot.normal.dot(old_positions[near.stencil.node[a]]);
  const FacetShape<dim> shape = evaluate_facet_shape(nodes, xi);
  for (unsigned int b = 0; b < shape.n_nodes; ++b)
    for (unsigned int i = 0; i < dim - 1; ++i)
      levers[near.contactor.n_nodes() + b] += arm * shape.first[b][i] * (*dual)[i];
  return levers;
}

template <int dim>
void Friction<dim>::linearize(double least)
{
  history.follow(potential.pair_list());
  linear_slips.assign(history.bodies.size() + history.obstacles.size(), SpatialVector<dim>::Zero());
  potential.for_each_overlap_above(least,
                                   [&](const NearPair &near)
                                   {
                                     const TargetMotion motion = find_target_motion(near);
                                     linear_slips[near.index] = carry_over(point_of(near, history).before,
                                                                           motion, near.foot.normal) +
                                                                find_slip_increment(near, motion);
                                   });
}

template <int dim>
void Friction<dim>::for_each_linear_point(double least,
                                          const std::function<void(const LinearPoint<dim> &)> &visit) const
{
  potential.for_each_overlap_above(least,
                                   [&](const NearPair &near)
                                   {
                                     LinearPoint<dim> point = potential.make_linear_point(near);
                                     point.slip.coefficient = coefficient;
                                     point.slip.trial = linear_slips[near.index];
                                     point.slip.levers = find_levers(near);
                                     visit(point);
                                   });
}

template <int dim>
void Friction<dim>::follow(const Positions &increments)
{
  for (auto *const points : {&history.bodies, &history.obstacles})
    for (FrictionPoint<dim> &point : *points)
    {
      point.now = PointSlip<dim>();
      point.dissipated = 0.;
    }
  potential.for_each_overlap_above(
      0.,
      [&](const NearPair &near)
      {
        const SpatialVector<dim> &normal = near.foot.normal;
        const auto levers = find_levers(near);
        SpatialVector<dim> moved = SpatialVector<dim>::Zero();
        for (unsigned int a = 0; a < near.stencil.n_nodes; ++a)
        {
          const SpatialVector<dim> &increment = increments[near.stencil.node[a]];
          moved += near.stencil.weight[a] * increment + normal.dot(increment) * levers[a];
        }
        const CoulombLaw law{coefficient, near.pair.stiffness};
        const SpatialVector<dim> trial = linear_slips[near.index] + moved - normal.dot(moved) * normal;
        FrictionPoint<dim> &point = point_of(near, history);
        // The velocities do not matter: the damping is that of the step.
        point.now = {law.find_elastic_slip(trial, potential.total_pressure(near, increments)), normal};
        point.dissipated = law.stiffness * point.now.elastic.dot(trial - point.now.elastic);
      });
}

template <int dim>
SpatialVector<dim> Friction<dim>::force_of(const NearPair &near) const
{
  return -near.pair.area * near.pair.stiffness * point_of(near, history).now.elastic;
}

template <int dim>
void Friction<dim>::add_forces(std::vector<SpatialVector<dim>> &forces) const
{
  potential.for_each_overlap_above(
      0.,
      [&](const NearPair &near)
      {
        const SpatialVector<dim> force = force_of(near);
        for (unsigned int a = 0; a < near.stencil.n_nodes; ++a)
          forces[near.stencil.node[a]] += near.stencil.weight[a] * force;
        if (potential.is_linear())
        {
          const auto levers = find_levers(near);
          for (unsigned int a = 0; a < near.stencil.n_nodes; ++a)
            forces[near.stencil.node[a]] += levers[a].dot(force) * near.foot.normal;
          return;
        }
        if (near.target == nullptr)
          return;
        // The target gets its force at the foot, a depth away from the point: the couple makes up for that.
        const SpatialVector<dim> arm = -near.foot.gap;
        const SpatialTensor<dim> couple = force * arm.transpose() - arm * force.transpose();
        const FacetBasis<dim> basis(gather_nodes(*near.target, potential.positions()), near.foot.closest.xi);
        for (unsigned int b = 0; b < basis.shape.n_nodes; ++b)
          forces[near.target->nodes[b]] += couple_force(basis, b, couple);
      });
}

template <int dim>
double Friction<dim>::energy() const
{
  double sum = 0.;
  const auto add = [&sum](const auto &pairs, const auto &points)
  {
    for (std::size_t i = 0; i < points.size(); ++i)
      sum += .5 * pairs[i].area * pairs[i].stiffness * points[i].now.elastic.squaredNorm();
  };
  add(potential.pair_list().body_pairs(), history.bodies);
  add(potential.pair_list().obstacle_pairs(), history.obstacles);
  return sum;
}

template <int dim>
double Friction<dim>::commit()
{
  old_positions = potential.positions();
  old_shifts = potential.obstacle_places().shifts;
  double dissipated = 0.;
  const auto accept = [&dissipated](const auto &pairs, auto &points)
  {
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      dissipated += pairs[i].area * points[i].dissipated;
      points[i].before = points[i].now;
      points[i].dissipated = 0.;
    }
  };
  accept(potential.pair_list().body_pairs(), history.bodies);
  accept(potential.pair_list().obstacle_pairs(), history.obstacles);
  return dissipated;
}

template class Friction<2>;
template class Friction<3>;
} // namespace signorini::contact
