// SPDX-License-Identifier: LGPL-2.1-or-later
// A ContactPotential whose depths are linear functions of the nodes' positions, for an implicit step.
#include "signorini/contact/potential/contact_potential.h"

#include <algorithm>
#include <cmath>

namespace signorini::contact
{
namespace
{
template <int dim>
SpatialVector<dim> weigh(const PairStencil<dim> &stencil, const std::vector<SpatialVector<dim>> &nodal)
{
  SpatialVector<dim> sum = SpatialVector<dim>::Zero();
  for (unsigned int a = 0; a < stencil.n_nodes; ++a)
    sum += stencil.weight[a] * nodal[stencil.node[a]];
  return sum;
}
} // namespace

template <int dim>
void ContactPotential<dim>::shift_action(const ContactPair<dim> &pair, const Positions &start,
                                         PairFoot<dim> &foot) const
{
  // N_b + N_b,α Δξ_α with the Δξ that takes the foot at `start` to the line along the normal through the
  // contactor's point there.
  const Facet<dim> &target = surface.facets[foot.facet];
  const FacetShape<dim> shape = evaluate_facet_shape(target, foot.xi);
  const FacetFrame<dim> frame = evaluate_facet_frame(gather_nodes(target, start), foot.xi);
  const auto dual = find_oblique_dual(frame, foot.normal);
  if (!dual)
    return; // beside the facet: no line along the normal meets its plane
  const SpatialVector<dim> offset =
      interpolate(surface.facets[pair.facet], pair.shape, start) - frame.position;
  for (unsigned int b = 0; b < shape.n_nodes; ++b)
    for (unsigned int i = 0; i < dim - 1; ++i)
      foot.shape[b] += shape.first[b][i] * (*dual)[i].dot(offset);
}

template <int dim>
void ContactPotential<dim>::find_entries(const Positions &start)
{
  // Turns and bends of the target within a step account for less.
  constexpr double share_of_thickness = 0.01;
  find_feet(std::numeric_limits<double>::max()); // so that linearize() finds none anew
  measures_of_forces.reset();
  Positions motion = evaluated_positions;
  for (std::size_t node = 0; node < motion.size(); ++node)
    motion[node] -= start[node];
  for_each_overlap_above(
      0.,
      [&](const NearPair &near)
      {
        if (near.target == nullptr)
          return;
        const double slack = share_of_thickness * near.contactor.layer_thickness,
                     start_depth = near.foot.depth + near.foot.normal.dot(weigh(near.stencil, motion));
        if (start_depth <= slack)
          return;
        const double cutoff = pairs.reach(near.pair.facet) + 2. * pairs.skin();
        PairFoot<dim> entry = find_pair_foot(surface, pairs.neighbours()[near.pair.neighbours].candidates,
                                             near.pair, start, cutoff);
        if (entry.depth >= start_depth - slack)
          return;
        if (!std::isfinite(entry.depth))
        {
          body_feet.all()[near.index] = entry;
          return;
        }
        PairStencil<dim> stencil;
        stencil.add(near.contactor, near.pair.shape, 1.);
        stencil.add(surface.facets[entry.facet], entry.shape, -1.);
        entry.depth -= entry.normal.dot(weigh(stencil, motion));
        entry.position = near.foot.position;
        body_feet.all()[near.index] = entry;
      });
}

template <int dim>
void ContactPotential<dim>::linearize(const Positions &start)
{
  find_feet(std::numeric_limits<double>::max());
  measures_of_forces.reset();
  start_depths.assign(body_feet.all().size() + obstacle_feet.size(), 0.);
  is_evaluated = false;
  for (std::size_t i = 0; i < body_feet.all().size(); ++i)
    if (PairFoot<dim> &foot = body_feet.all()[i]; std::isfinite(foot.depth))
      shift_action(pairs.body_pairs()[i], start, foot);
  Positions motion = evaluated_positions;
  for (std::size_t node = 0; node < motion.size(); ++node)
    motion[node] -= start[node];
  for_each_overlap_above(std::numeric_limits<double>::lowest(),
                         [&](const NearPair &near)
                         {
                           SpatialVector<dim> moved = weigh(near.stencil, motion);
                           if (near.target == nullptr)
                             moved -=
                                 places.shifts[near.pair.target] - places_before.shifts[near.pair.target];
                           start_depths[near.index] = near.foot.depth + near.foot.normal.dot(moved);
                         });
}

template <int dim>
void ContactPotential<dim>::for_each_linear_point(
    double least, const std::function<void(const LinearPoint<dim> &)> &visit) const
{
  for_each_overlap_above(least, [&](const NearPair &near) { visit(make_linear_point(near)); });
}

template <int dim>
LinearPoint<dim> ContactPotential<dim>::make_linear_point(const NearPair &near) const
{
  return {near.stencil,        near.foot.normal,  near.foot.depth,          near.pair.area,
          near.pair.stiffness, near.pair.damping, start_depths[near.index], {}};
}

template <int dim>
void ContactPotential<dim>::follow(const Positions &increments, double time_step)
{
  linear_time_step = time_step;
  measures_of_forces.reset();
  for (std::size_t node = 0; node < evaluated_positions.size(); ++node)
    evaluated_positions[node] += increments[node];
  for_each_overlap_above(
      std::numeric_limits<double>::lowest(),
      [&](const NearPair &near)
      {
        const auto i = static_cast<std::size_t>(near.index);
        const std::size_t n_body_feet = body_feet.all().size();
        PairFoot<dim> &foot = i < n_body_feet ? body_feet.all()[i] : obstacle_feet[i - n_body_feet];
        foot.depth -= foot.normal.dot(weigh(near.stencil, increments));
        foot.position = interpolate(surface.facets[near.pair.facet], near.pair.shape, evaluated_positions);
      });
}

template class ContactPotential<2>;
template class ContactPotential<3>;
} // namespace signorini::contact
