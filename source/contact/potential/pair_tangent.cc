// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/potential/pair_tangent.h"

#include "signorini/contact/potential/foot_slide.h"

#include <algorithm>
#include <cmath>

namespace signorini::contact
{
namespace
{
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
    foot.depth = 1e-7 * overlap;
  const double ratio = pair.offset != 0. ? overlap / foot.depth : 1.;

  const FootSlide<dim> slide = find_foot_slide(foot, stencil, target);
  const SpatialTensor<dim> along_normal = foot.normal * foot.normal.transpose();
  set_product_block<dim>(stencil, ratio * SpatialTensor<dim>::Identity() + (1. - ratio) * along_normal,
                         block);
  block.noalias() += ratio * slide.coupling * slide.by_nodes;
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

template <int dim>
void merge_nodes(std::vector<unsigned int> &nodes, Eigen::MatrixXd &block)
{
  for (std::size_t b = nodes.size(); b-- > 1;)
  {
    const auto a = std::find(nodes.begin(), nodes.begin() + b, nodes[b]) - nodes.begin();
    if (static_cast<std::size_t>(a) == b)
      continue;
    const auto last = static_cast<Eigen::Index>(nodes.size()) - 1, double_node = static_cast<Eigen::Index>(b);
    block.template middleRows<dim>(dim * a) += block.template middleRows<dim>(dim * double_node);
    block.template middleCols<dim>(dim * a) += block.template middleCols<dim>(dim * double_node);
    block.template middleRows<dim>(dim * double_node) = block.template middleRows<dim>(dim * last).eval();
    block.template middleCols<dim>(dim * double_node) = block.template middleCols<dim>(dim * last).eval();
    block.conservativeResize(dim * last, dim * last);
    nodes[b] = nodes.back();
    nodes.pop_back();
  }
}

template void compute_body_tangent(const ContactPair<2> &, const PairFoot<2> &, const PairStencil<2> &,
                                   const FacetNodes<2> &, Eigen::MatrixXd &);
template void compute_body_tangent(const ContactPair<3> &, const PairFoot<3> &, const PairStencil<3> &,
                                   const FacetNodes<3> &, Eigen::MatrixXd &);
template void compute_obstacle_tangent(const ContactPair<2> &, const PairFoot<2> &, const PairStencil<2> &,
                                       const SpatialTensor<2> &, Eigen::MatrixXd &);
template void compute_obstacle_tangent(const ContactPair<3> &, const PairFoot<3> &, const PairStencil<3> &,
                                       const SpatialTensor<3> &, Eigen::MatrixXd &);
template void merge_nodes<2>(std::vector<unsigned int> &, Eigen::MatrixXd &);
template void merge_nodes<3>(std::vector<unsigned int> &, Eigen::MatrixXd &);
} // namespace signorini::contact
