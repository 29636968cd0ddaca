// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/discretization/discretization.h"
#include "signorini/physics/vector_kernels.h"

#include <deal.II/base/aligned_vector.h>

#include <array>
#include <vector>

namespace signorini
{
/// Elastic forces by VectorKernels: of bodies with linear cells whose law remembers nothing. Others have no
/// cells here.
template <int dim>
class BatchedForce
{
public:
  /// Symmetric, as in VectorKernels: the diagonal, then what stands above it by rows.
  using Stretch = std::array<double, dim *(dim + 1) / 2>;

  /// `kernels` must be among all_vector_kernels(). The discretization must outlive this object.
  BatchedForce(const std::vector<MaterialParameters> &materials, const Discretization<dim> &discretization,
               const VectorKernels<dim> &kernels = best_vector_kernels<dim>());

  bool has_body(unsigned int body) const { return bodies[body]; }

  /// Adds −∂W/∂u to local and ghost entries.
  void add_force(const Vector &displacement, Vector &force) const;

  /// Energy of its cells [J; J/m in 2-D]. Of this rank alone.
  double energy(const Vector &displacement) const;

  /// Writes the volume means of H + Hᵀ + HᵀH of its cells to `stretches` [own cell].
  void compute_stretches(const Vector &displacement, std::vector<Stretch> &stretches) const;

private:
  /// Cells of one shape and material.
  struct Group
  {
    MaterialParameters::Model model;
    bool is_simplex;
    double shear_modulus, bulk_modulus; ///< [Pa]
    std::vector<unsigned int> cells;    ///< in their order in the batches
    dealii::AlignedVector<double> geometry;
    std::vector<unsigned int> nodes;
  };

  static constexpr unsigned int n_of_row = 4;

  Group &group_of(const MaterialParameters &material, bool is_simplex);
  void fill(Group &group) const;
  void set_geometry(Group &group, std::size_t place, unsigned int cell) const;
  CellBatches batches_of(const Group &group) const;
  const typename VectorKernels<dim>::OfShape &kernels_of(const Group &group) const;
  const typename VectorKernels<dim>::OfShape::OfLaw &law_kernels_of(const Group &group) const;
  void set_nodal_displacement(const Vector &displacement) const;

  const Discretization<dim> *discretization;
  const VectorKernels<dim> *kernels;
  std::vector<bool> bodies;
  std::vector<Group> groups;
  unsigned int n_nodes = 0;
  /// [local and ghost node, then one that never moves][component and what fills the row up].
  mutable dealii::AlignedVector<double> nodal_displacement, nodal_force; ///< the force is zero between calls
};
} // namespace signorini
