// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/friction/friction_tangent.h"

#include "signorini/contact/friction/facet_turn.h"
#include "signorini/contact/friction/slip_motion.h"
#include "signorini/contact/potential/coulomb_law.h"
#include "signorini/contact/potential/foot_slide.h"

namespace signorini::contact
{
namespace
{
// Where the variables of Differentiable stand: the gap (of an obstacle: the point), tangent by tangent, the
// foot's coordinates.
template <int dim>
constexpr int tangent_index(int i)
{
  return dim + dim * i;
}
template <int dim>
constexpr int xi_index = dim *dim;

template <int dim>
using Number = Differentiable<dim>;
template <int dim>
using Vector = VectorOf<dim, Differentiable<dim>>;

/// A vector whose components are the variables from `first` on.
template <int dim>
Vector<dim> make_variables(const SpatialVector<dim> &value, int first)
{
  Vector<dim> variables = value.template cast<Number<dim>>();
  for (int d = 0; d < dim; ++d)
    variables[d].derivatives()[first + d] = 1.;
  return variables;
}

/// A vector that depends on the foot's coordinates, with the columns of `slopes` for its derivatives.
template <int dim>
Vector<dim> make_function_of_foot(const SpatialVector<dim> &value,
                                  const std::array<SpatialVector<dim>, dim - 1> &slopes)
{
  Vector<dim> function = value.template cast<Number<dim>>();
  for (int d = 0; d < dim; ++d)
    for (int i = 0; i < dim - 1; ++i)
      function[d].derivatives()[xi_index<dim> + i] = slopes[i][d];
  return function;
}

template <int dim>
typename FacetBasis<dim, Number<dim>>::Slopes make_slopes(const FacetShape<dim> &shape)
{
  typename FacetBasis<dim, Number<dim>>::Slopes slopes;
  for (unsigned int b = 0; b < shape.n_nodes; ++b)
    for (int i = 0; i < dim - 1; ++i)
    {
      slopes[b][i] = shape.first[b][i];
      for (int j = 0; j < dim - 1; ++j)
        slopes[b][i].derivatives()[xi_index<dim> + j] = shape.second[b][i + j];
    }
  return slopes;
}

/// The target as it is now: its tangents are variables.
template <int dim>
FacetBasis<dim, Number<dim>> make_present_basis(const FacetJet<dim> &jet)
{
  typename FacetBasis<dim, Number<dim>>::Tangents tangents;
  for (int i = 0; i < dim - 1; ++i)
    tangents[i] = make_variables<dim>(jet.first[i], tangent_index<dim>(i));
  return {tangents, make_slopes(jet.shape)};
}

/// The target as it was where the foot is now.
template <int dim>
FacetBasis<dim, Number<dim>> make_old_basis(const FacetJet<dim> &jet)
{
  typename FacetBasis<dim, Number<dim>>::Tangents tangents;
  for (int i = 0; i < dim - 1; ++i)
  {
    std::array<SpatialVector<dim>, dim - 1> slopes;
    for (int j = 0; j < dim - 1; ++j)
      slopes[j] = jet.second[i + j];
    tangents[i] = make_function_of_foot<dim>(jet.first[i], slopes);
  }
  return {tangents, make_slopes(jet.shape)};
}

template <int dim>
Vector<dim> find_force(const RubbingPoint<dim> &point, const SlipMotion<dim, Number<dim>> &motion,
                       const Number<dim> &overlap)
{
  const CoulombLaw law{point.coefficient, point.pair.stiffness};
  const Number<dim> share = point.before.is_touching() ? Number<dim>(1.) : motion.find_share(overlap);
  const Vector<dim> trial = motion.carry(point.before) + share * motion.find_increment();
  const Number<dim> pressure = overlap > 0. ? Number<dim>(point.pair.stiffness * overlap) : Number<dim>(0.);
  const Number<dim> factor(-point.pair.area * point.pair.stiffness);
  if (point.is_held)
    return factor * trial;
  return factor * law.find_elastic_slip(trial, pressure);
}

/// Derivatives of the variables by the positions of the nodes.
template <int dim>
auto differentiate_variables(const PairStencil<dim> &stencil, const FacetJet<dim> &jet,
                             const FootSlide<dim> &slide)
{
  constexpr int n_variables = Number<dim>::DerType::RowsAtCompileTime;
  Eigen::Matrix<double, n_variables, Eigen::Dynamic> by_nodes =
      Eigen::Matrix<double, n_variables, Eigen::Dynamic>::Zero(n_variables, dim * stencil.n_nodes);
  const unsigned int first_target_node = stencil.n_nodes - jet.shape.n_nodes;
  for (unsigned int a = 0; a < stencil.n_nodes; ++a)
  {
    by_nodes.template block<dim, dim>(0, dim * a).diagonal().setConstant(stencil.weight[a]);
    for (int i = 0; i < dim - 1 && a >= first_target_node; ++i)
      by_nodes.template block<dim, dim>(tangent_index<dim>(i), dim * a)
          .diagonal()
          .setConstant(jet.shape.first[a - first_target_node][i]);
  }
  for (int i = 0; i < dim - 1; ++i)
  {
    by_nodes.template topRows<dim>().noalias() -= jet.first[i] * slide.by_nodes.row(i);
    for (int j = 0; j < dim - 1; ++j)
      by_nodes.template middleRows<dim>(tangent_index<dim>(i)).noalias() +=
          jet.second[i + j] * slide.by_nodes.row(j);
  }
  by_nodes.template bottomRows<dim - 1>() = slide.by_nodes;
  return by_nodes;
}

/// Sets the rows of node `a` to minus the derivatives of its force.
template <int dim, typename Derivatives>
void set_rows(unsigned int a, const Vector<dim> &force, const Derivatives &by_nodes, Eigen::MatrixXd &block)
{
  for (int d = 0; d < dim; ++d)
    block.row(dim * a + d).noalias() = -force[d].derivatives().transpose() * by_nodes;
}
} // namespace

template <int dim>
void compute_body_friction_tangent(const RubbingPoint<dim> &point, const FacetNodes<dim> &target,
                                   const FacetNodes<dim> &old_target, Eigen::MatrixXd &block)
{
  const PairFoot<dim> &foot = point.foot;
  const LocalPoint<dim> &xi = foot.xi;
  const FacetJet<dim> jet(target, xi), old_jet(old_target, xi);
  const FacetBasis<dim, Number<dim>> basis = make_present_basis(jet), old_basis = make_old_basis(old_jet);

  SlipMotion<dim, Number<dim>> motion;
  motion.now = make_variables<dim>(foot.gap(), 0);
  std::array<SpatialVector<dim>, dim - 1> slopes;
  for (int i = 0; i < dim - 1; ++i)
    slopes[i] = -old_jet.first[i];
  motion.before = make_function_of_foot<dim>(point.old_position - old_jet.position, slopes);
  motion.turn = find_turn(old_basis, basis);
  if (has_normal_of_facet(*point.target, foot.xi, std::abs(foot.depth)))
    motion.normal = basis.normal;
  else
  {
    const Number<dim> outward_length = (foot.depth > 0. ? -1. : 1.) * sqrt(motion.now.squaredNorm());
    for (int d = 0; d < dim; ++d)
      motion.normal[d] = motion.now[d] / outward_length;
  }
  const Number<dim> overlap = point.pair.offset - motion.normal.dot(motion.now);
  const Vector<dim> force = find_force(point, motion, overlap);
  const Vector<dim> arm = -motion.now;
  const TensorOf<dim, Number<dim>> couple = force * arm.transpose() - arm * force.transpose();

  const auto by_nodes =
      differentiate_variables(point.stencil, jet, find_foot_slide(foot, point.stencil, target));
  const unsigned int first_target_node = point.stencil.n_nodes - jet.shape.n_nodes;
  block.resize(dim * point.stencil.n_nodes, dim * point.stencil.n_nodes);
  for (unsigned int a = 0; a < first_target_node; ++a)
    set_rows<dim>(a, Number<dim>(point.stencil.weight[a]) * force, by_nodes, block);
  for (unsigned int b = 0; b < jet.shape.n_nodes; ++b)
  {
    Number<dim> weight(-jet.shape.value[b]);
    for (int i = 0; i < dim - 1; ++i)
      weight.derivatives()[xi_index<dim> + i] = -jet.shape.first[b][i];
    set_rows<dim>(first_target_node + b, weight * force + couple_force(basis, b, couple), by_nodes, block);
  }
}

template <int dim>
void compute_obstacle_friction_tangent(const RubbingPoint<dim> &point, const SpatialVector<dim> &shift,
                                       const SpatialTensor<dim> &depth_hessian, Eigen::MatrixXd &block)
{
  SlipMotion<dim, Number<dim>> motion;
  motion.now = make_variables<dim>(point.foot.position, 0);
  motion.before = point.old_position.template cast<Number<dim>>();
  motion.shift = shift.template cast<Number<dim>>();
  motion.normal = point.foot.normal.template cast<Number<dim>>();
  Number<dim> overlap(point.foot.depth + point.pair.offset);
  overlap.derivatives().template head<dim>() = -point.foot.normal;
  for (int d = 0; d < dim; ++d)
    motion.normal[d].derivatives().template head<dim>() = -depth_hessian.row(d).transpose();
  const Vector<dim> force = find_force(point, motion, overlap);

  const unsigned int n_nodes = point.stencil.n_nodes;
  block.resize(dim * n_nodes, dim * n_nodes);
  for (unsigned int a = 0; a < n_nodes; ++a)
    for (unsigned int b = 0; b < n_nodes; ++b)
      for (int d = 0; d < dim; ++d)
        block.template block<1, dim>(dim * a + d, dim * b) =
            -point.stencil.weight[a] * point.stencil.weight[b] *
            force[d].derivatives().template head<dim>().transpose();
}

template void compute_body_friction_tangent(const RubbingPoint<2> &, const FacetNodes<2> &,
                                            const FacetNodes<2> &, Eigen::MatrixXd &);
template void compute_body_friction_tangent(const RubbingPoint<3> &, const FacetNodes<3> &,
                                            const FacetNodes<3> &, Eigen::MatrixXd &);
template void compute_obstacle_friction_tangent(const RubbingPoint<2> &, const SpatialVector<2> &,
                                                const SpatialTensor<2> &, Eigen::MatrixXd &);
template void compute_obstacle_friction_tangent(const RubbingPoint<3> &, const SpatialVector<3> &,
                                                const SpatialTensor<3> &, Eigen::MatrixXd &);
} // namespace signorini::contact
