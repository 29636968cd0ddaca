// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>

// Compiled once for each instruction set: nothing here may bring inline functions along, of which the linker
// would keep any one copy.
namespace signorini
{
/// Linear cells of one shape and one elastic material, as many at a time as a vector register has lanes.
/// Nodal values are rows of four numbers, the last of which, or two in 2-D, mean nothing.
struct CellBatches
{
  std::size_t n_batches;
  /// [batch][point][entry][lane]: the inverse Jacobian ∂ξ_d/∂X_j by rows d [1/m], then the quadrature weight
  /// × Jacobian [m³; m² in 2-D]. Aligned to 64 bytes.
  const double *geometry;
  /// [batch][node][lane] → row of the nodal values. Lanes to spare belong to a node that does not move.
  const unsigned int *nodes;
  double shear_modulus; ///< [Pa]
  double bulk_modulus;  ///< [Pa]
};

/// What is computed of CellBatches. `displacement` and `force` are rows of nodal values, aligned to 32 bytes.
template <int dim>
struct VectorKernels
{
  /// Adds −∂W/∂u, of the same energy as CellKernel for degree 1; not a number where a law knows none.
  using AddForce = void (*)(const CellBatches &cells, const double *displacement, double *force);

  /// Overwrites `stretches`, [batch][entry][lane], with the volume means of H + Hᵀ + HᵀH: its diagonal, then
  /// what stands above it by rows.
  using ComputeStretches = void (*)(const CellBatches &cells, const double *displacement, double *stretches);

  /// Overwrites `parts`, [batch][entry][lane]: ∫ψ_shape dV [J; J/m in 2-D], the volume mean of the strain v
  /// that U speaks of, and the volume [m³; m² in 2-D]. The energy is the first plus the volume times U.
  using ComputeEnergyParts = void (*)(const CellBatches &cells, const double *displacement, double *parts);
  static constexpr unsigned int n_energy_parts = 3;

  /// Of one shape: with one point for simplices; with 2^dim Gauss points and nodes, x fastest, for
  /// hypercubes. Energy of volume: of the mean over the cell.
  struct OfShape
  {
    struct OfLaw
    {
      AddForce add_force;
      ComputeEnergyParts compute_energy_parts;
    };
    OfLaw linear_elastic;
    OfLaw neo_hookean;
    ComputeStretches compute_stretches;
  };

  const char *instruction_set;
  unsigned int n_lanes;
  OfShape simplex;
  OfShape hypercube;
};

/// All that this machine can run, best first; `n` receives how many.
template <int dim>
const VectorKernels<dim> *const *all_vector_kernels(unsigned int &n);

/// The best that this machine can run.
template <int dim>
const VectorKernels<dim> &best_vector_kernels();
} // namespace signorini
