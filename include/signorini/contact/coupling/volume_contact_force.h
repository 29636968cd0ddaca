// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/coupling/contact_term.h"
#include "signorini/contact/potential/volume_potential.h"
#include "signorini/discretization/volume_map.h"

namespace signorini
{
/// The volume contact potential as a force on the degrees of freedom: contact of bodies, without damping.
template <int dim>
class VolumeContactForce : public ContactTerm<dim>
{
public:
  /// `map` must outlive this object.
  VolumeContactForce(const std::string &name, const VolumeMap<dim> &map,
                     const contact::VolumePotentialSettings &settings, const MPI_Comm &communicator);

  double renew(const State &state) override;
  void update(const State &state) override;
  double energy() const override;
  void add_force(Vector &force) const override;
  void add_couplings(const dealii::AffineConstraints<double> &constraints,
                     dealii::TrilinosWrappers::SparsityPattern &pattern) const override;
  void add_tangent(TangentSystem &system) const override;
  unsigned int n_searches() const override { return potential.n_searches(); }

  const NodeMap<dim> &nodes() const override { return *map; }
  void add_row_sum_bounds(Vector &stiffness, Vector &damping) const override;
  contact::ContactMeasures<dim> measure() const override;
  contact::PairForces<dim> pair_forces(const State &state) const override;

  /// The own cell of the first simplex of every pair of this rank, near or overlapping, [pair].
  std::vector<unsigned int> cells_of_pairs() const;

  /// Square of what the penalty leaves of the error in the energy norm, 2W of the overlaps, half to either
  /// element, [own cell] [J; J/m in 2-D] (collective).
  std::vector<double> cell_errors() const;

  /// Faces of elements, inner ones included, which lie in another body at least in part: each by the first
  /// degrees of freedom of its nodes in ascending order; of all ranks, on every rank (collective).
  std::set<std::vector<dealii::types::global_dof_index>> faces_in_contact() const;

private:
  const VolumeMap<dim> *map;
  contact::VolumePotential<dim> potential;
};
} // namespace signorini
