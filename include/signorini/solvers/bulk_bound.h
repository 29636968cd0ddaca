// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/physics/internal_force.h"
#include "signorini/physics/viscous_force.h"

#include <memory>
#include <vector>

namespace signorini
{
/// Largest squared natural frequency of the bodies: the maximum over cells of the largest eigenvalue of
/// (cell tangent, cell lumped mass), which bounds that of the assembled system from above (B. Irons, 1970);
/// and the same of the damping by viscosity.
template <int dim>
class BulkBound
{
public:
  /// The arguments must outlive this object.
  BulkBound(const InternalForce<dim> &elasticity,
            const std::vector<std::shared_ptr<ViscousForce<dim>>> &viscosities,
            const std::vector<MaterialParameters> &materials, const Discretization<dim> &discretization);

  /// Of all cells at the present state, that of the last update of the elasticity (collective).
  void update(const State &state);

  /// Of those cells that have been strained by more than a little since they were looked at (collective).
  /// Nothing where the laws are linear.
  void update_strained(const State &state);

  double frequency_squared() const { return largest_frequency_squared; } ///< [1/s²]
  double damping_rate() const { return largest_damping_rate; }           ///< [1/s]

  /// For boost's archives.
  template <typename Archive>
  void serialize(Archive &archive, unsigned int /*version*/)
  {
    archive &frequencies_squared &damping_rates &stretches &largest_frequency_squared &largest_damping_rate;
  }

private:
  using Stretch = typename BatchedForce<dim>::Stretch;

  void update_cells(const std::vector<unsigned int> &cells, const State &state);

  /// Largest eigenvalue of a symmetric matrix of one cell with its lumped mass.
  double largest_eigenvalue(unsigned int cell, const std::vector<double> &matrix) const;

  const InternalForce<dim> *elasticity;
  const std::vector<std::shared_ptr<ViscousForce<dim>>> *viscosities;
  const std::vector<MaterialParameters> *materials;
  const Discretization<dim> *discretization;
  std::vector<double> frequencies_squared, damping_rates; ///< [own cell]
  std::vector<Stretch> stretches; ///< [own cell] as it was looked at; laws that are not linear only
  double largest_frequency_squared = 0., largest_damping_rate = 0.; ///< of all ranks
};
} // namespace signorini
