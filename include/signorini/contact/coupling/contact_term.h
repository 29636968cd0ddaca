// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/potential/contact_measures.h"
#include "signorini/discretization/node_map.h"
#include "signorini/physics/force_term.h"

#include <Eigen/Core>

namespace signorini
{
/// Contact as a force on the degrees of freedom: what solvers and records ask of it, whatever its potential.
template <int dim>
class ContactTerm : public ForceTerm
{
public:
  /// `is_external`: contact with obstacles, which changes the momentum of the bodies.
  ContactTerm(const std::string &name, bool is_external, const MPI_Comm &communicator);

  /// The nodes that the forces act on.
  virtual const NodeMap<dim> &nodes() const = 0;

  /// Adds the bounds of the potential's add_row_sum_bounds() to every degree of freedom.
  virtual void add_row_sum_bounds(Vector &stiffness, Vector &damping) const = 0;

  /// Of all ranks together (collective).
  virtual contact::ContactMeasures<dim> measure() const = 0;

  /// Resultants by pair over all ranks, the same on all of them, with the damping at the state's velocity
  /// where it has one (collective).
  virtual contact::PairForces<dim> pair_forces(const State &state) const = 0;

  /// What each rank has as that of all ranks, the same on all of them (collective).
  contact::PairForces<dim> sum(const contact::PairForces<dim> &own) const;

  /// Adds a block on some nodes, node-major, to the system's matrix.
  void add_block(const std::vector<unsigned int> &block_nodes, const Eigen::MatrixXd &block,
                 TangentSystem &system) const;

protected:
  /// What each rank measured, with positions from `origin`, as that of all ranks (collective).
  contact::ContactMeasures<dim> sum(contact::ContactMeasures<dim> own,
                                    const SpatialVector<dim> &origin) const;

  /// Adds the same value to all components of a node, from nodal values of every rank (collective).
  void spread(const std::vector<double> &nodal, Vector &values) const;

  const MPI_Comm communicator;
};
} // namespace signorini
