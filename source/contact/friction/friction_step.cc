// SPDX-License-Identifier: LGPL-2.1-or-later
// What Friction does in an implicit step, where slips are linear in the positions.
#include "signorini/contact/friction/friction.h"

namespace signorini::contact
{
template <int dim>
auto Friction<dim>::find_levers(const NearPair &near, const Positions &acting) ->
    typename LinearSlip<dim>::Levers
{
  typename LinearSlip<dim>::Levers levers = LinearSlip<dim>().levers;
  if (near.target == nullptr)
    return levers;
  const LocalPoint<dim> &xi = near.foot.xi;
  const FacetNodes<dim> nodes = gather_nodes(*near.target, acting);
  const auto dual = find_oblique_dual(evaluate_facet_frame(nodes, xi), near.foot.normal);
  if (!dual)
    return levers;
  double arm = 0.; // from the place of the target that takes the force to the contactor's point
  for (unsigned int a = 0; a < near.stencil.n_nodes; ++a)
    arm += near.stencil.weight[a] * near.foot.normal.dot(acting[near.stencil.node[a]]);
  const FacetShape<dim> shape = evaluate_facet_shape(nodes, xi);
  for (unsigned int b = 0; b < shape.n_nodes; ++b)
    for (unsigned int i = 0; i < dim - 1; ++i)
      levers[near.contactor.n_nodes() + b] += arm * shape.first[b][i] * (*dual)[i];
  return levers;
}

template <int dim>
void Friction<dim>::linearize(double least, const Positions &acting)
{
  history.follow(potential.pair_list());
  linear_positions = potential.positions();
  linear_slips.assign(history.bodies.size() + history.obstacles.size(), LinearSlip<dim>());
  potential.for_each_overlap_above(least,
                                   [&](const NearPair &near)
                                   {
                                     const SlipMotion<dim> motion = find_motion(near);
                                     LinearSlip<dim> &slip = linear_slips[near.index];
                                     slip.coefficient = coefficient;
                                     slip.trial = motion.carry(point_of(near, history).before) +
                                                  motion.find_increment();
                                     slip.levers = find_levers(near, acting);
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
                                     point.slip = linear_slips[near.index];
                                     visit(point);
                                   });
}

template <int dim>
void Friction<dim>::follow()
{
  for (auto *const points : {&history.bodies, &history.obstacles})
    for (FrictionPoint<dim> &point : *points)
    {
      point.now = PointSlip<dim>();
      point.slid = point.traction = SpatialVector<dim>::Zero();
    }
  potential.for_each_overlap_above(
      0.,
      [&](const NearPair &near)
      {
        const SpatialVector<dim> &normal = near.foot.normal;
        const LinearSlip<dim> &slip = linear_slips[near.index];
        SpatialVector<dim> moved = SpatialVector<dim>::Zero();
        for (unsigned int a = 0; a < near.stencil.n_nodes; ++a)
        {
          const unsigned int node = near.stencil.node[a];
          const SpatialVector<dim> increment = potential.positions()[node] - linear_positions[node];
          moved += near.stencil.weight[a] * increment + normal.dot(increment) * slip.levers[a];
        }
        const CoulombLaw law{coefficient, near.pair.stiffness};
        const SpatialVector<dim> trial = slip.trial + moved - normal.dot(moved) * normal;
        FrictionPoint<dim> &point = point_of(near, history);
        // Velocities do not matter: the damping is that of the step.
        const double pressure = potential.total_pressure(near, linear_positions);
        point.now = {point.is_held ? trial : law.find_elastic_slip(trial, pressure), normal};
        point.slid = trial - point.now.elastic;
        point.traction = law.stiffness * point.now.elastic;
      });
}

template <int dim>
void Friction<dim>::compute_linear_tangent(const NearPair &near, Eigen::MatrixXd &block) const
{
  const FrictionPoint<dim> &point = point_of(near, history);
  const CoulombLaw law{coefficient, near.pair.stiffness};
  const SpatialVector<dim> &normal = near.foot.normal;
  SlipDerivatives<dim> slopes{SpatialTensor<dim>::Identity(), SpatialVector<dim>::Zero()};
  if (!point.is_held)
    slopes = law.differentiate<dim>(point.now.elastic + point.slid, near.pressure());
  const PairStencil<dim> &stencil = near.stencil;
  block.resize(dim * stencil.n_nodes, dim * stencil.n_nodes);
  const auto slip_by_node = [&](unsigned int a) -> SpatialTensor<dim>
  {
    return stencil.weight[a] * (SpatialTensor<dim>::Identity() - normal * normal.transpose()) +
           linear_slips[near.index].levers[a] * normal.transpose();
  };
  for (unsigned int b = 0; b < stencil.n_nodes; ++b)
  {
    const SpatialVector<dim> pressure_by_node = -law.stiffness * stencil.weight[b] * normal;
    const SpatialTensor<dim> elastic_by_node =
        slopes.by_trial * slip_by_node(b) + slopes.by_pressure * pressure_by_node.transpose();
    for (unsigned int a = 0; a < stencil.n_nodes; ++a)
      block.template block<dim, dim>(dim * a, dim * b) =
          near.pair.area * law.stiffness * slip_by_node(a).transpose() * elastic_by_node;
  }
}

template class Friction<2>;
template class Friction<3>;
} // namespace signorini::contact
