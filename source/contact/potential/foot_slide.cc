// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/potential/foot_slide.h"

#include "signorini/contact/geometry/local_domain.h"

#include <Eigen/LU>

#include <cmath>

namespace signorini::contact
{
namespace
{
/// A foot held on a side without being pushed there lies on a seam between facets in one plane, and slides on
/// as freely as one beside the seam does.
template <int dim>
bool is_pushed(const PairFoot<dim> &foot, const SpatialVector<dim> &tangent)
{
  return std::abs(foot.gap().dot(tangent)) > 1e-8 * foot.gap().norm() * tangent.norm();
}

template <int dim>
void compute_coupling(const PairFoot<dim> &foot, const PairStencil<dim> &stencil, const FacetJet<dim> &jet,
                      FootSlide<dim> &slide)
{
  slide.coupling.resize(dim * stencil.n_nodes, dim - 1);
  const unsigned int first_target_node = stencil.n_nodes - jet.shape.n_nodes;
  for (unsigned int i = 0; i < dim - 1; ++i)
    for (unsigned int a = 0; a < stencil.n_nodes; ++a)
    {
      SpatialVector<dim> entry = -stencil.weight[a] * jet.first[i];
      if (a >= first_target_node)
        entry -= jet.shape.first[a - first_target_node][i] * foot.gap();
      slide.coupling.template block<dim, 1>(dim * a, i) = entry;
    }
}

template <int dim>
LocalTensor<dim> compute_local_hessian(const PairFoot<dim> &foot, const FacetJet<dim> &jet)
{
  LocalTensor<dim> hessian;
  for (unsigned int i = 0; i < dim - 1; ++i)
    for (unsigned int j = 0; j < dim - 1; ++j)
      hessian(i, j) = jet.first[i].dot(jet.first[j]) - foot.gap().dot(jet.second[i + j]);
  return hessian;
}
} // namespace

template <int dim>
FacetJet<dim>::FacetJet(const FacetNodes<dim> &nodes, const LocalPoint<dim> &xi)
    : shape(evaluate_facet_shape(nodes, xi))
{
  first.fill(SpatialVector<dim>::Zero());
  second.fill(SpatialVector<dim>::Zero());
  for (unsigned int a = 0; a < shape.n_nodes; ++a)
  {
    position += shape.value[a] * nodes.position[a];
    for (unsigned int i = 0; i < dim - 1; ++i)
      first[i] += shape.first[a][i] * nodes.position[a];
    for (unsigned int i = 0; i < FacetShape<dim>::n_second; ++i)
      second[i] += shape.second[a][i] * nodes.position[a];
  }
}

template <int dim>
FootSlide<dim> find_foot_slide(const PairFoot<dim> &foot, const PairStencil<dim> &stencil,
                               const FacetNodes<dim> &target)
{
  const FacetJet<dim> jet(target, foot.xi);
  const LocalPlace<dim> place = find_local_place(target, foot.xi, 0.);
  FootSlide<dim> slide;
  compute_coupling(foot, stencil, jet, slide);
  LocalTensor<dim> directions = place.directions;
  LocalTensor<dim> hessian = directions.transpose() * compute_local_hessian(foot, jet) * directions;
  double size = 1.;
  for (unsigned int i = 0; i < dim - 1; ++i)
  {
    SpatialVector<dim> tangent = SpatialVector<dim>::Zero();
    for (unsigned int a = 0; a < dim - 1; ++a)
      tangent += place.directions(a, i) * jet.first[a];
    size *= tangent.squaredNorm();
    if (i >= place.n_free && is_pushed(foot, tangent))
    {
      directions.col(i).setZero();
      hessian.row(i).setZero();
      hessian.col(i).setZero();
      hessian(i, i) = tangent.squaredNorm();
    }
  }
  slide.by_nodes.setZero(dim - 1, dim * stencil.n_nodes);
  if (hessian.determinant() > 1e-12 * size)
    slide.by_nodes.noalias() -=
        (directions * hessian.inverse() * directions.transpose()) * slide.coupling.transpose();
  return slide;
}

template <int dim>
bool has_normal_of_facet(const Facet<dim> &target, const LocalPoint<dim> &xi, double distance)
{
  return find_local_place(target, xi, 0.).n_free == dim - 1 || !(distance > 1e-9 * target.layer_thickness);
}

template struct FacetJet<2>;
template struct FacetJet<3>;
template FootSlide<2> find_foot_slide(const PairFoot<2> &, const PairStencil<2> &, const FacetNodes<2> &);
template FootSlide<3> find_foot_slide(const PairFoot<3> &, const PairStencil<3> &, const FacetNodes<3> &);
template bool has_normal_of_facet(const Facet<2> &, const LocalPoint<2> &, double);
template bool has_normal_of_facet(const Facet<3> &, const LocalPoint<3> &, double);
} // namespace signorini::contact
