// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/potential/pair_tangent.h"

#include "signorini/contact/geometry/local_domain.h"

#include <Eigen/LU>

#include <cmath>

namespace signorini::contact
{
namespace
{
/// F_xξ, one column a local direction. Lives on the stack.
template <int dim>
using Coupling = Eigen::Matrix<double, Eigen::Dynamic, dim - 1, Eigen::ColMajor,
                               dim * PairStencil<dim>::max_n_nodes, dim - 1>;

/// Block (a, b) = weight_a weight_b `tensor`.
template <int dim>
void set_product_block(const PairStencil<dim> &stencil, const SpatialTensor<dim> &tensor,
                       Eigen::MatrixXd &block)
{
  block.resize(dim * stencil.n_nodes, dim * stencil.n_nodes);
  for (unsigned int a = 0; a < stencil.n_nodes; ++a)
    for (unsigned int b = 0; b < stencil.n_nodes; ++b)
      block.template block<dim, dim>(dim * a, dim * b) = (stencil.weight[a] * stencil.weight[b]) * tensor;
}

/// Tangents and second derivatives of the target facet at the foot.
template <int dim>
struct TargetJet
{
  FacetShape<dim> shape;
  std::array<SpatialVector<dim>, dim - 1> first;
  std::array<SpatialVector<dim>, FacetShape<dim>::n_second> second;
};

template <int dim>
TargetJet<dim> evaluate_jet(const FacetNodes<dim> &target, const LocalPoint<dim> &xi)
{
  TargetJet<dim> jet;
  jet.shape = evaluate_facet_shape(target, xi);
  jet.first.fill(SpatialVector<dim>::Zero());
  jet.second.fill(SpatialVector<dim>::Zero());
  for (unsigned int a = 0; a < jet.shape.n_nodes; ++a)
  {
    for (unsigned int i = 0; i < dim - 1; ++i)
      jet.first[i] += jet.shape.first[a][i] * target.position[a];
    for (unsigned int i = 0; i < FacetShape<dim>::n_second; ++i)
      jet.second[i] += jet.shape.second[a][i] * target.position[a];
  }
  return jet;
}

/// A foot held on a side without being pushed there lies on a seam between facets in one plane, and slides on
/// as freely as one beside the seam does.
template <int dim>
bool is_pushed(const PairFoot<dim> &foot, const SpatialVector<dim> &tangent)
{
  return std::abs(foot.gap.dot(tangent)) > 1e-8 * foot.gap.norm() * tangent.norm();
}

template <int dim>
Coupling<dim> compute_coupling(const PairFoot<dim> &foot, const PairStencil<dim> &stencil,
                               const TargetJet<dim> &jet)
{
  Coupling<dim> coupling(dim * stencil.n_nodes, dim - 1);
  const unsigned int first_target_node = stencil.n_nodes - jet.shape.n_nodes;
  for (unsigned int i = 0; i < dim - 1; ++i)
    for (unsigned int a = 0; a < stencil.n_nodes; ++a)
    {
      SpatialVector<dim> entry = -stencil.weight[a] * jet.first[i];
      if (a >= first_target_node)
        entry -= jet.shape.first[a - first_target_node][i] * foot.gap;
      coupling.template block<dim, 1>(dim * a, i) = entry;
    }
  return coupling;
}

template <int dim>
LocalTensor<dim> compute_local_hessian(const PairFoot<dim> &foot, const TargetJet<dim> &jet)
{
  LocalTensor<dim> hessian;
  for (unsigned int i = 0; i < dim - 1; ++i)
    for (unsigned int j = 0; j < dim - 1; ++j)
      hessian(i, j) = jet.first[i].dot(jet.first[j]) - foot.gap.dot(jet.second[i + j]);
  return hessian;
}
} // namespace

template <int dim>
void compute_body_tangent(const ContactPair<dim> &pair, const PairFoot<dim> &found_foot,
                          const PairStencil<dim> &stencil, const FacetNodes<dim> &target,
                          Eigen::MatrixXd &block)
{
  // At depth 0 the quotient (d + o)/d is taken along the normal beside it, where the curvature is the same.
  const double overlap = found_foot.depth + pair.offset;
  PairFoot<dim> foot = found_foot;
  if (pair.offset != 0. && std::abs(foot.depth) < 1e-7 * std::abs(overlap))
  {
    foot.depth = 1e-7 * overlap;
    foot.gap = -foot.depth * foot.normal;
  }
  const double ratio = pair.offset != 0. ? overlap / foot.depth : 1.;

  const TargetJet<dim> jet = evaluate_jet(target, foot.closest.xi);
  const LocalPlace<dim> place = find_local_place(target, foot.closest.xi, 0.);
  Coupling<dim> coupling = compute_coupling(foot, stencil, jet) * place.directions;
  LocalTensor<dim> hessian =
      place.directions.transpose() * compute_local_hessian(foot, jet) * place.directions;
  double size = 1.;
  for (unsigned int i = 0; i < dim - 1; ++i)
  {
    SpatialVector<dim> tangent = SpatialVector<dim>::Zero();
    for (unsigned int a = 0; a < dim - 1; ++a)
      tangent += place.directions(a, i) * jet.first[a];
    size *= tangent.squaredNorm();
    if (i >= place.n_free && is_pushed(foot, tangent))
    {
      coupling.col(i).setZero();
      hessian.row(i).setZero();
      hessian.col(i).setZero();
      hessian(i, i) = tangent.squaredNorm();
    }
  }

  const SpatialTensor<dim> along_normal = foot.normal * foot.normal.transpose();
  set_product_block<dim>(stencil, ratio * SpatialTensor<dim>::Identity() + (1. - ratio) * along_normal,
                         block);
  // At a centre of curvature the foot is not unique and the Hessian has no finite value: leave out its soft
  // part.
  if (hessian.determinant() > 1e-12 * size)
  {
    const LocalTensor<dim> inverse = hessian.inverse();
    block.noalias() -= ratio * coupling * (inverse * coupling.transpose());
  }
  block *= pair.area * pair.stiffness;
}

template <int dim>
void compute_obstacle_tangent(const ContactPair<dim> &pair, const PairFoot<dim> &foot,
                              const PairStencil<dim> &stencil, const SpatialTensor<dim> &depth_hessian,
                              Eigen::MatrixXd &block)
{
  const SpatialTensor<dim> hessian =
      foot.normal * foot.normal.transpose() + (foot.depth + pair.offset) * depth_hessian;
  set_product_block<dim>(stencil, pair.area * pair.stiffness * hessian, block);
}

template void compute_body_tangent(const ContactPair<2> &, const PairFoot<2> &, const PairStencil<2> &,
                                   const FacetNodes<2> &, Eigen::MatrixXd &);
template void compute_body_tangent(const ContactPair<3> &, const PairFoot<3> &, const PairStencil<3> &,
                                   const FacetNodes<3> &, Eigen::MatrixXd &);
template void compute_obstacle_tangent(const ContactPair<2> &, const PairFoot<2> &, const PairStencil<2> &,
                                       const SpatialTensor<2> &, Eigen::MatrixXd &);
template void compute_obstacle_tangent(const ContactPair<3> &, const PairFoot<3> &, const PairStencil<3> &,
                                       const SpatialTensor<3> &, Eigen::MatrixXd &);
} // namespace signorini::contact
