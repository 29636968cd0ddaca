// SPDX-License-Identifier: LGPL-2.1-or-later
// Compiled once for each instruction set, whose name and number of lanes the build gives.
#include "signorini/physics/vector_kernels.h"

#include "signorini/physics/lane_laws.h"

namespace signorini
{
namespace SIGNORINI_INSTRUCTION_SET
{
namespace
{
/// What a cell's stretches need of one point: `sum` += weight (H + Hᵀ + HᵀH).
template <int dim>
ALWAYS_INLINE void add_stretch(Lanes weight, const Tensor<dim> &H, Lanes (&sum)[dim * (dim + 1) / 2])
{
  int entry = dim;
  for (int i = 0; i < dim; ++i)
    for (int j = i; j < dim; ++j)
    {
      Lanes stretch = H[i][j] + H[j][i];
      for (int k = 0; k < dim; ++k)
        stretch += H[k][i] * H[k][j];
      sum[i == j ? i : entry++] += weight * stretch;
    }
}

/// P times the transpose of the inverse Jacobian, times the weight: what the force takes from ∂u/∂ξ.
template <int dim>
ALWAYS_INLINE void pull_back(const double *point, const Tensor<dim> &stress, Tensor<dim> &reference_stress)
{
  const Lanes weight = load(point, dim * dim);
  Tensor<dim> weighted;
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j)
      weighted[i][j] = weight * stress[i][j];
  for (int i = 0; i < dim; ++i)
    for (int d = 0; d < dim; ++d)
    {
      Lanes sum = weighted[i][0] * load(point, d * dim);
      for (int j = 1; j < dim; ++j)
        sum += weighted[i][j] * load(point, d * dim + j);
      reference_stress[i][d] = sum;
    }
}

/// H from ∂u/∂ξ.
template <int dim>
ALWAYS_INLINE void push_forward(const double *point, const Tensor<dim> &reference_gradient, Tensor<dim> &H)
{
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j)
    {
      Lanes sum = reference_gradient[i][0] * load(point, j);
      for (int d = 1; d < dim; ++d)
        sum += reference_gradient[i][d] * load(point, d * dim + j);
      H[i][j] = sum;
    }
}

template <int dim>
struct Simplex
{
  static constexpr int n_nodes = dim + 1, n_points = 1;
  using Nodal = Lanes[n_nodes][dim];

  static ALWAYS_INLINE void compute_gradients(const double *geometry, const Nodal &u, Tensor<dim> (&H)[1])
  {
    Tensor<dim> reference_gradient;
    for (int i = 0; i < dim; ++i)
      for (int d = 0; d < dim; ++d)
        reference_gradient[i][d] = u[d + 1][i] - u[0][i];
    push_forward<dim>(geometry, reference_gradient, H[0]);
  }

  template <typename Law>
  static ALWAYS_INLINE void compute_force(const CellBatches &cells, const double *geometry, Nodal &nodal)
  {
    Tensor<dim> H[1], stress, reference_stress;
    compute_gradients(geometry, nodal, H);
    Law::template compute_stress<dim>(cells.shear_modulus,
                                      Law::pressure(cells.bulk_modulus, Law::template volume<dim>(H[0])),
                                      H[0], stress);
    pull_back<dim>(geometry, stress, reference_stress);
    for (int i = 0; i < dim; ++i)
    {
      nodal[0][i] = reference_stress[i][0];
      nodal[1][i] = -reference_stress[i][0];
      for (int d = 1; d < dim; ++d)
      {
        nodal[0][i] += reference_stress[i][d];
        nodal[d + 1][i] = -reference_stress[i][d];
      }
    }
  }
};

/// The derivative along one direction depends on where a point is along the others only: it has half as many
/// values as there are points, and needs differences along its own direction, interpolated along the others.
template <int dim>
struct Hypercube
{
  static constexpr int n_nodes = 1 << dim, n_points = n_nodes, n_halves = n_nodes / 2;
  static constexpr double first_point = 0.21132486540518711775, second_point = 0.78867513459481288225;
  using Nodal = Lanes[n_nodes][dim];
  using Derivatives = Lanes[dim][dim][n_halves]; ///< [component][direction][place along the others]

  /// Index of a node or point without the bit of direction d, and with a zero put in there.
  static constexpr int strike(int index, int d) { return (index & ((1 << d) - 1)) | (index >> (d + 1) << d); }
  static constexpr int widen(int half, int d) { return (half & ((1 << d) - 1)) | (half >> d << (d + 1)); }

  static ALWAYS_INLINE void interpolate(Lanes (&values)[n_halves])
  {
    for (int e = 1; e < n_halves; e *= 2)
      for (int i = 0; i < n_halves; ++i)
        if ((i & e) == 0)
        {
          const Lanes difference = values[i | e] - values[i];
          values[i | e] = values[i] + second_point * difference;
          values[i] += first_point * difference;
        }
  }

  /// The transpose of interpolate().
  static ALWAYS_INLINE void distribute(Lanes (&values)[n_halves])
  {
    for (int e = 1; e < n_halves; e *= 2)
      for (int i = 0; i < n_halves; ++i)
        if ((i & e) == 0)
        {
          const Lanes to_second = first_point * values[i] + second_point * values[i | e];
          values[i] += values[i | e] - to_second;
          values[i | e] = to_second;
        }
  }

  static ALWAYS_INLINE void compute_gradients(const double *geometry, const Nodal &u,
                                              Tensor<dim> (&H)[n_points])
  {
    Derivatives derivatives;
    for (int i = 0; i < dim; ++i)
      for (int d = 0; d < dim; ++d)
      {
        for (int half = 0; half < n_halves; ++half)
          derivatives[i][d][half] = u[widen(half, d) | 1 << d][i] - u[widen(half, d)][i];
        interpolate(derivatives[i][d]);
      }
    for (int q = 0; q < n_points; ++q)
    {
      Tensor<dim> reference_gradient;
      for (int i = 0; i < dim; ++i)
        for (int d = 0; d < dim; ++d)
          reference_gradient[i][d] = derivatives[i][d][strike(q, d)];
      push_forward<dim>(geometry + q * (dim * dim + 1) * n_lanes, reference_gradient, H[q]);
    }
  }

  template <typename Law>
  static ALWAYS_INLINE void compute_force(const CellBatches &cells, const double *geometry, Nodal &nodal)
  {
    Tensor<dim> H[n_points];
    compute_gradients(geometry, nodal, H);
    Lanes volume = {}, strain = {};
    for (int q = 0; q < n_points; ++q)
    {
      const Lanes weight = load(geometry, q * (dim * dim + 1) + dim * dim);
      volume += weight;
      strain += weight * Law::template volume<dim>(H[q]);
    }
    const Lanes pressure = Law::pressure(cells.bulk_modulus, strain / volume);
    Derivatives collected = {};
    for (int q = 0; q < n_points; ++q)
    {
      Tensor<dim> stress, reference_stress;
      Law::template compute_stress<dim>(cells.shear_modulus, pressure, H[q], stress);
      pull_back<dim>(geometry + q * (dim * dim + 1) * n_lanes, stress, reference_stress);
      for (int i = 0; i < dim; ++i)
        for (int d = 0; d < dim; ++d)
          collected[i][d][strike(q, d)] += reference_stress[i][d];
    }
    for (int i = 0; i < dim; ++i)
    {
      for (int a = 0; a < n_nodes; ++a)
        nodal[a][i] = Lanes{};
      for (int d = 0; d < dim; ++d)
      {
        distribute(collected[i][d]);
        for (int half = 0; half < n_halves; ++half)
        {
          nodal[widen(half, d)][i] += collected[i][d][half];
          nodal[widen(half, d) | 1 << d][i] -= collected[i][d][half];
        }
      }
    }
  }
};

/// Calls `action(batch, geometry, nodes, u)`.
template <int dim, typename Shape, typename Action>
ALWAYS_INLINE void for_each_batch(const CellBatches &cells, const double *displacement, const Action &action)
{
  for (std::size_t batch = 0; batch < cells.n_batches; ++batch)
  {
    const double *geometry = cells.geometry + batch * Shape::n_points * (dim * dim + 1) * n_lanes;
    const unsigned int *nodes = cells.nodes + batch * Shape::n_nodes * n_lanes;
    typename Shape::Nodal nodal;
    for (int a = 0; a < Shape::n_nodes; ++a)
      gather<dim>(nodes + a * n_lanes, displacement, nodal[a]);
    action(batch, geometry, nodes, nodal);
  }
}

template <int dim, typename Shape, typename Law>
void add_force(const CellBatches &cells, const double *displacement, double *force)
{
  for_each_batch<dim, Shape>(
      cells, displacement,
      [&](std::size_t, const double *geometry, const unsigned int *nodes, typename Shape::Nodal &nodal)
          __attribute__((always_inline)) {
            Shape::template compute_force<Law>(cells, geometry, nodal);
            for (int a = 0; a < Shape::n_nodes; ++a)
              scatter<dim>(nodes + a * n_lanes, nodal[a], force);
          });
}

template <int dim, typename Shape, typename Law>
void compute_energy_parts(const CellBatches &cells, const double *displacement, double *parts)
{
  for_each_batch<dim, Shape>(
      cells, displacement,
      [&](std::size_t batch, const double *geometry, const unsigned int *, typename Shape::Nodal &nodal)
          __attribute__((always_inline)) {
            Tensor<dim> H[Shape::n_points];
            Shape::compute_gradients(geometry, nodal, H);
            Lanes energy = {}, volume = {}, strain = {};
            for (int q = 0; q < Shape::n_points; ++q)
            {
              const Lanes weight = load(geometry, q * (dim * dim + 1) + dim * dim);
              volume += weight;
              strain += weight * Law::template volume<dim>(H[q]);
              energy += weight * Law::template shape_energy<dim>(cells.shear_modulus, H[q]);
            }
            Lanes *of_batch =
                reinterpret_cast<Lanes *>(parts + batch * VectorKernels<dim>::n_energy_parts * n_lanes);
            of_batch[0] = energy;
            of_batch[1] = strain / volume;
            of_batch[2] = volume;
          });
}

template <int dim, typename Shape>
void compute_stretches(const CellBatches &cells, const double *displacement, double *stretches)
{
  constexpr int n_entries = dim * (dim + 1) / 2;
  for_each_batch<dim, Shape>(
      cells, displacement,
      [&](std::size_t batch, const double *geometry, const unsigned int *, typename Shape::Nodal &nodal)
          __attribute__((always_inline)) {
            Tensor<dim> H[Shape::n_points];
            Shape::compute_gradients(geometry, nodal, H);
            Lanes volume = {}, sum[n_entries] = {};
            for (int q = 0; q < Shape::n_points; ++q)
            {
              const Lanes weight = load(geometry, q * (dim * dim + 1) + dim * dim);
              volume += weight;
              add_stretch<dim>(weight, H[q], sum);
            }
            Lanes *of_batch = reinterpret_cast<Lanes *>(stretches + batch * n_entries * n_lanes);
            for (int entry = 0; entry < n_entries; ++entry)
              of_batch[entry] = sum[entry] / volume;
          });
}

template <int dim, typename Shape>
constexpr typename VectorKernels<dim>::OfShape of_shape{
    {&add_force<dim, Shape, LinearElasticLaw>, &compute_energy_parts<dim, Shape, LinearElasticLaw>},
    {&add_force<dim, Shape, NeoHookeanLaw>, &compute_energy_parts<dim, Shape, NeoHookeanLaw>},
    &compute_stretches<dim, Shape>};

#define TEXT_OF(name) #name
#define TEXT(name) TEXT_OF(name)
template <int dim>
constexpr VectorKernels<dim> kernels{TEXT(SIGNORINI_INSTRUCTION_SET), n_lanes, of_shape<dim, Simplex<dim>>,
                                     of_shape<dim, Hypercube<dim>>};
} // namespace

template <int dim>
const VectorKernels<dim> &vector_kernels()
{
  return kernels<dim>;
}

template const VectorKernels<2> &vector_kernels<2>();
template const VectorKernels<3> &vector_kernels<3>();
} // namespace SIGNORINI_INSTRUCTION_SET
} // namespace signorini
