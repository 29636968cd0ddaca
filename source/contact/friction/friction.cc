// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/friction/friction.h"

#include "signorini/contact/friction/friction_tangent.h"
#include "signorini/contact/potential/pair_tangent.h"
#include "signorini/contact/search/nearest_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

namespace signorini::contact
{
template <int dim>
Friction<dim>::Friction(const ContactPotential<dim> &contact_potential, double friction_coefficient,
                        SlidUnder traction_to_slide_under)
    : potential(contact_potential), coefficient(friction_coefficient), slid_under(traction_to_slide_under)
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
  if (!std::exchange(has_begun, true))
    begin();
  const auto let_go = [](const auto &pairs, auto &points)
  {
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      points[i].now = PointSlip<dim>();
      points[i].slid = points[i].before.elastic;
      points[i].traction = .5 * pairs[i].stiffness * points[i].before.elastic;
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
  // Both sides of a body that touches itself have the same partners: along their normals they lie apart.
  const double lift = potential.pair_list().skin();
  for (const PlacedSlip<dim> &placed : remembered)
  {
    Group &group = groups[placed.partners];
    group.known.push_back(placed.position + lift * placed.slip.normal);
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
                                     group->second.places.push_back(near.foot.position +
                                                                    lift * near.foot.normal + beside);
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
SpatialVector<dim> Friction<dim>::find_shift(unsigned int obstacle) const
{
  return potential.obstacle_places().shifts[obstacle] - old_shifts[obstacle];
}

template <int dim>
SlipMotion<dim> Friction<dim>::find_motion(const NearPair &near) const
{
  SlipMotion<dim> motion;
  motion.normal = near.foot.normal;
  motion.now = motion.before = SpatialVector<dim>::Zero();
  for (unsigned int a = 0; a < near.stencil.n_nodes; ++a)
  {
    motion.before += near.stencil.weight[a] * old_positions[near.stencil.node[a]];
    motion.now += near.stencil.weight[a] * potential.positions()[near.stencil.node[a]];
  }
  if (near.target == nullptr)
  {
    motion.shift = find_shift(near.pair.target);
    return motion;
  }
  const LocalPoint<dim> &xi = near.foot.xi;
  motion.turn = find_turn(FacetBasis<dim>(gather_nodes(*near.target, old_positions), xi),
                          FacetBasis<dim>(gather_nodes(*near.target, potential.positions()), xi));
  return motion;
}

template <int dim>
void Friction<dim>::slip(const NearPair &near, double pressure, FrictionPoint<dim> &point) const
{
  const CoulombLaw law{coefficient, near.pair.stiffness};
  const SlipMotion<dim> motion = find_motion(near);
  const bool slips_all_the_way = slid_under == SlidUnder::mean_traction || point.before.is_touching();
  point.share = slips_all_the_way ? 1. : motion.find_share(near.overlap());
  const SpatialVector<dim> kept = motion.carry(point.before),
                           trial = kept + point.share * motion.find_increment();
  point.now.elastic = point.is_held ? trial : law.find_elastic_slip(trial, pressure);
  point.now.normal = near.foot.normal;
  point.slid = trial - point.now.elastic;
  point.traction = law.stiffness * (slid_under == SlidUnder::last_traction
                                        ? point.now.elastic
                                        : SpatialVector<dim>(.5 * (kept + point.now.elastic)));
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
          const auto &levers = linear_slips[near.index].levers;
          for (unsigned int a = 0; a < near.stencil.n_nodes; ++a)
            forces[near.stencil.node[a]] += levers[a].dot(force) * near.foot.normal;
          return;
        }
        if (near.target == nullptr)
          return;
        // The target gets its force at the foot, a depth away from the point: the couple makes up for that.
        const SpatialVector<dim> arm = -near.foot.gap();
        const SpatialTensor<dim> couple = force * arm.transpose() - arm * force.transpose();
        const FacetBasis<dim> basis(gather_nodes(*near.target, potential.positions()), near.foot.xi);
        for (unsigned int b = 0; b < near.target->n_nodes(); ++b)
          forces[near.target->nodes[b]] += couple_force(basis, b, couple);
      });
}

template <int dim>
void Friction<dim>::for_each_tangent(const std::function<void(const std::vector<unsigned int> &nodes,
                                                              const Eigen::MatrixXd &block)> &add) const
{
  std::vector<unsigned int> nodes;
  Eigen::MatrixXd block;
  potential.for_each_overlap_above(
      -ContactPotential<dim>::verge * potential.pair_list().skin(),
      [&](const NearPair &near)
      {
        const SpatialVector<dim> old_position = interpolate(near.contactor, near.pair.shape, old_positions);
        const FrictionPoint<dim> &friction = point_of(near, history);
        const RubbingPoint<dim> point{near.pair,       near.foot,        near.stencil, near.target,
                                      friction.before, friction.is_held, old_position, coefficient};
        nodes.assign(near.stencil.node.begin(), near.stencil.node.begin() + near.stencil.n_nodes);
        if (potential.is_linear())
          compute_linear_tangent(near, block);
        else if (near.target != nullptr)
          compute_body_friction_tangent(point, gather_nodes(*near.target, potential.positions()),
                                        gather_nodes(*near.target, old_positions), block);
        else
          compute_obstacle_friction_tangent(point, find_shift(near.pair.target),
                                            potential.obstacle_hessian(near), block);
        if (near.target != nullptr && near.target->body == near.contactor.body)
          merge_nodes<dim>(nodes, block);
        add(nodes, block);
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
void Friction<dim>::hold()
{
  for (auto *const points : {&history.bodies, &history.obstacles})
    for (FrictionPoint<dim> &point : *points)
    {
      point.held_limit = 0.;
      point.is_held = point.slid.dot(point.direction) < 0.;
      point.direction = SpatialVector<dim>::Zero();
      if (!point.is_held && point.now.is_touching() && point.slid != point.direction)
        point.direction = point.slid.normalized();
    }
  potential.for_each_overlap_above(0.,
                                   [&](const NearPair &near)
                                   {
                                     const CoulombLaw law{coefficient, near.pair.stiffness};
                                     point_of(near, history).held_limit = law.limit(near.pressure());
                                   });
}

template <int dim>
void Friction<dim>::release()
{
  for (auto *const points : {&history.bodies, &history.obstacles})
    for (FrictionPoint<dim> &point : *points)
      point.is_held = false;
}

template <int dim>
double Friction<dim>::held_energy() const
{
  double sum = 0.;
  potential.for_each_overlap_above(
      0.,
      [&](const NearPair &near)
      {
        const FrictionPoint<dim> &point = point_of(near, history);
        const double trial = (point.now.elastic + point.slid).norm(),
                     elastic = point.is_held ? trial : std::min(trial, point.held_limit);
        sum += near.pair.area * near.pair.stiffness * elastic * (trial - .5 * elastic) / point.share;
      });
  return sum;
}

template <int dim>
double Friction<dim>::commit()
{
  old_positions = potential.positions();
  old_shifts = potential.obstacle_places().shifts;
  history.forget_parted();
  double dissipated = 0.;
  const auto accept = [&dissipated](const auto &pairs, auto &points)
  {
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      dissipated += pairs[i].area * points[i].traction.dot(points[i].slid);
      points[i].before = points[i].now;
      points[i].slid = points[i].traction = SpatialVector<dim>::Zero();
    }
  };
  accept(potential.pair_list().body_pairs(), history.bodies);
  accept(potential.pair_list().obstacle_pairs(), history.obstacles);
  return dissipated;
}

template class Friction<2>;
template class Friction<3>;
} // namespace signorini::contact
