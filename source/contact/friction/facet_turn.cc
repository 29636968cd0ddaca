// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/friction/facet_turn.h"

#include <Eigen/LU>

namespace signorini::contact
{
namespace
{
/// The orthogonal factor of the polar decomposition (Newton's iteration for the matrix sign; N. J. Higham,
/// 1986). It converges for every tensor that is not singular, quadratically near a rotation.
template <int dim>
SpatialTensor<dim> find_rotation(SpatialTensor<dim> tensor)
{
  constexpr unsigned int max_n_iterations = 50;
  for (unsigned int i = 0; i < max_n_iterations; ++i)
  {
    const SpatialTensor<dim> mean = .5 * (tensor + tensor.inverse().transpose());
    const double change = (mean - tensor).norm();
    tensor = mean;
    if (change < 1e-9) // the next one is below round-off
      break;
  }
  return tensor;
}
} // namespace

template <int dim>
FacetBasis<dim>::FacetBasis(const FacetNodes<dim> &nodes, const LocalPoint<dim> &xi)
    : shape(evaluate_facet_shape(nodes, xi))
{
  const FacetFrame<dim> frame = evaluate_facet_frame(nodes, xi);
  tangent = frame.tangent;
  normal = frame.area_normal.normalized();
  Eigen::Matrix<double, dim - 1, dim - 1> metric;
  for (unsigned int i = 0; i < dim - 1; ++i)
    for (unsigned int j = 0; j < dim - 1; ++j)
      metric(i, j) = tangent[i].dot(tangent[j]);
  const Eigen::Matrix<double, dim - 1, dim - 1> inverse = metric.inverse();
  dual.fill(SpatialVector<dim>::Zero());
  for (unsigned int i = 0; i < dim - 1; ++i)
    for (unsigned int j = 0; j < dim - 1; ++j)
      dual[i] += inverse(i, j) * tangent[j];
}

template <int dim>
SpatialTensor<dim> find_turn(const FacetBasis<dim> &before, const FacetBasis<dim> &now)
{
  SpatialTensor<dim> gradient = now.normal * before.normal.transpose();
  for (unsigned int i = 0; i < dim - 1; ++i)
    gradient += now.tangent[i] * before.dual[i].transpose();
  return find_rotation<dim>(gradient);
}

template <int dim>
SpatialVector<dim> turn_to_plane(const SpatialVector<dim> &in_plane, const SpatialVector<dim> &from,
                                 const SpatialVector<dim> &to)
{
  constexpr double opposite = 1e-6;
  const double twice_squared_cosine_of_half = 1. + from.dot(to);
  if (twice_squared_cosine_of_half < opposite)
    return SpatialVector<dim>::Zero();
  return in_plane - to.dot(in_plane) / twice_squared_cosine_of_half * (from + to);
}

template <int dim>
SpatialVector<dim> couple_force(const FacetBasis<dim> &basis, unsigned int b,
                                const SpatialTensor<dim> &couple)
{
  SpatialVector<dim> arm = SpatialVector<dim>::Zero();
  for (unsigned int i = 0; i < dim - 1; ++i)
    arm += basis.shape.first[b][i] * basis.dual[i];
  const SpatialVector<dim> turned = .5 * couple * arm;
  return turned + basis.normal.dot(turned) * basis.normal;
}

template struct FacetBasis<2>;
template struct FacetBasis<3>;
template SpatialTensor<2> find_turn(const FacetBasis<2> &, const FacetBasis<2> &);
template SpatialTensor<3> find_turn(const FacetBasis<3> &, const FacetBasis<3> &);
template SpatialVector<2> turn_to_plane<2>(const SpatialVector<2> &, const SpatialVector<2> &,
                                           const SpatialVector<2> &);
template SpatialVector<3> turn_to_plane<3>(const SpatialVector<3> &, const SpatialVector<3> &,
                                           const SpatialVector<3> &);
template SpatialVector<2> couple_force(const FacetBasis<2> &, unsigned int, const SpatialTensor<2> &);
template SpatialVector<3> couple_force(const FacetBasis<3> &, unsigned int, const SpatialTensor<3> &);
} // namespace signorini::contact
