// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/friction/facet_turn.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>

namespace signorini::contact
{
namespace
{
/// The orthogonal factor of the polar decomposition (Newton's iteration for the matrix sign; N. J. Higham,
/// 1986). It converges for every tensor that is not singular, quadratically near a rotation, and its
/// derivatives with it.
template <int dim, typename Number>
TensorOf<dim, Number> find_rotation(TensorOf<dim, Number> tensor)
{
  constexpr unsigned int max_n_iterations = 50;
  for (unsigned int i = 0; i < max_n_iterations; ++i)
  {
    const TensorOf<dim, Number> inverse = tensor.inverse();
    const TensorOf<dim, Number> mean = Number(.5) * (tensor + inverse.transpose());
    const Number squared_change = (mean - tensor).squaredNorm();
    tensor = mean;
    if (squared_change < Number(1e-18)) // the next one is below round-off
      break;
  }
  return tensor;
}

template <typename Number>
VectorOf<2, Number> find_area_normal(const std::array<VectorOf<2, Number>, 1> &tangent)
{
  return {tangent[0].y(), -tangent[0].x()};
}

template <typename Number>
VectorOf<3, Number> find_area_normal(const std::array<VectorOf<3, Number>, 2> &tangent)
{
  return tangent[0].cross(tangent[1]);
}

template <int dim, typename Number>
typename FacetBasis<dim, Number>::Tangents find_tangents(const FacetNodes<dim> &nodes,
                                                         const LocalPoint<dim> &xi)
{
  const FacetFrame<dim> frame = evaluate_facet_frame(nodes, xi);
  typename FacetBasis<dim, Number>::Tangents tangents;
  for (unsigned int i = 0; i < dim - 1; ++i)
    tangents[i] = frame.tangent[i].template cast<Number>();
  return tangents;
}

template <int dim, typename Number>
typename FacetBasis<dim, Number>::Slopes find_slopes(const FacetNodes<dim> &nodes, const LocalPoint<dim> &xi)
{
  const FacetShape<dim> shape = evaluate_facet_shape(nodes, xi);
  typename FacetBasis<dim, Number>::Slopes slopes;
  for (unsigned int b = 0; b < shape.n_nodes; ++b)
    for (unsigned int i = 0; i < dim - 1; ++i)
      slopes[b][i] = shape.first[b][i];
  return slopes;
}
} // namespace

template <int dim, typename Number>
FacetBasis<dim, Number>::FacetBasis(const FacetNodes<dim> &nodes, const LocalPoint<dim> &xi)
    : FacetBasis(find_tangents<dim, Number>(nodes, xi), find_slopes<dim, Number>(nodes, xi))
{
}

template <int dim, typename Number>
FacetBasis<dim, Number>::FacetBasis(const Tangents &tangents, const Slopes &slopes)
    : tangent(tangents), slope(slopes)
{
  normal = find_area_normal<Number>(tangent);
  const Number size = sqrt(normal.squaredNorm());
  for (unsigned int d = 0; d < dim; ++d)
    normal[d] /= size;
  Eigen::Matrix<Number, dim - 1, dim - 1> metric;
  for (unsigned int i = 0; i < dim - 1; ++i)
    for (unsigned int j = 0; j < dim - 1; ++j)
      metric(i, j) = tangent[i].dot(tangent[j]);
  const Eigen::Matrix<Number, dim - 1, dim - 1> inverse = metric.inverse();
  for (unsigned int i = 0; i < dim - 1; ++i)
  {
    dual[i] = inverse(i, 0) * tangent[0];
    for (unsigned int j = 1; j < dim - 1; ++j)
      dual[i] += inverse(i, j) * tangent[j];
  }
}

template <int dim, typename Number>
TensorOf<dim, Number> find_turn(const FacetBasis<dim, Number> &before, const FacetBasis<dim, Number> &now)
{
  TensorOf<dim, Number> gradient = now.normal * before.normal.transpose();
  for (unsigned int i = 0; i < dim - 1; ++i)
    gradient += now.tangent[i] * before.dual[i].transpose();
  return find_rotation<dim, Number>(gradient);
}

template <int dim, typename Number>
VectorOf<dim, Number> turn_to_plane(const VectorOf<dim, Number> &in_plane, const VectorOf<dim, Number> &from,
                                    const VectorOf<dim, Number> &to)
{
  constexpr double opposite = 1e-6;
  const Number twice_squared_cosine_of_half = Number(1.) + from.dot(to);
  if (twice_squared_cosine_of_half < Number(opposite))
    return VectorOf<dim, Number>::Zero();
  const Number share = to.dot(in_plane) / twice_squared_cosine_of_half;
  return in_plane - share * (from + to);
}

template <int dim, typename Number>
VectorOf<dim, Number> couple_force(const FacetBasis<dim, Number> &basis, unsigned int b,
                                   const TensorOf<dim, Number> &couple)
{
  VectorOf<dim, Number> arm = basis.slope[b][0] * basis.dual[0];
  for (unsigned int i = 1; i < dim - 1; ++i)
    arm += basis.slope[b][i] * basis.dual[i];
  const VectorOf<dim, Number> turned = Number(.5) * (couple * arm);
  const Number along_normal = basis.normal.dot(turned);
  return turned + along_normal * basis.normal;
}

template struct FacetBasis<2>;
template struct FacetBasis<3>;
template struct FacetBasis<2, Differentiable<2>>;
template struct FacetBasis<3, Differentiable<3>>;
template SpatialTensor<2> find_turn(const FacetBasis<2> &, const FacetBasis<2> &);
template SpatialTensor<3> find_turn(const FacetBasis<3> &, const FacetBasis<3> &);
template TensorOf<2, Differentiable<2>> find_turn(const FacetBasis<2, Differentiable<2>> &,
                                                  const FacetBasis<2, Differentiable<2>> &);
template TensorOf<3, Differentiable<3>> find_turn(const FacetBasis<3, Differentiable<3>> &,
                                                  const FacetBasis<3, Differentiable<3>> &);
template SpatialVector<2> turn_to_plane<2>(const SpatialVector<2> &, const SpatialVector<2> &,
                                           const SpatialVector<2> &);
template SpatialVector<3> turn_to_plane<3>(const SpatialVector<3> &, const SpatialVector<3> &,
                                           const SpatialVector<3> &);
template VectorOf<2, Differentiable<2>> turn_to_plane<2>(const VectorOf<2, Differentiable<2>> &,
                                                         const VectorOf<2, Differentiable<2>> &,
                                                         const VectorOf<2, Differentiable<2>> &);
template VectorOf<3, Differentiable<3>> turn_to_plane<3>(const VectorOf<3, Differentiable<3>> &,
                                                         const VectorOf<3, Differentiable<3>> &,
                                                         const VectorOf<3, Differentiable<3>> &);
template SpatialVector<2> couple_force(const FacetBasis<2> &, unsigned int, const SpatialTensor<2> &);
template SpatialVector<3> couple_force(const FacetBasis<3> &, unsigned int, const SpatialTensor<3> &);
template VectorOf<2, Differentiable<2>> couple_force(const FacetBasis<2, Differentiable<2>> &, unsigned int,
                                                     const TensorOf<2, Differentiable<2>> &);
template VectorOf<3, Differentiable<3>> couple_force(const FacetBasis<3, Differentiable<3>> &, unsigned int,
                                                     const TensorOf<3, Differentiable<3>> &);
} // namespace signorini::contact
