// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/coupling/contact_force.h"
#include "signorini/contact/friction/friction.h"

namespace signorini
{
/// The friction of a surface contact as a force on the degrees of freedom. It has a memory, so it is no force
/// term: its energy depends on the way, and every step must be accepted once.
template <int dim>
class FrictionForce
{
public:
  /// On `contact`, which must outlive this object, with the friction coefficient μ ≥ 0.
  FrictionForce(const ContactForce<dim> &contact, double coefficient, contact::SlidUnder slid_under,
                const MPI_Comm &communicator);

  bool is_external() const { return contact->is_external; }

  /// Those of the contact.
  std::vector<SpatialVector<dim>> obstacle_increments() const { return contact->obstacle_increments(); }

  /// Slips from the last accepted step to the state that the contact was updated to, under the pressures with
  /// damping at `velocity`; where its depths are linear, linear ones (collective).
  void update(const Vector &velocity);

  /// See contact::Friction::linearize(), for_each_linear_point() and follow(): after those of the contact,
  /// whose add_points() this one's add_points() replaces (linearize() is collective).
  void linearize(double least, const Vector &acting)
  {
    follow_surface();
    friction.linearize(least, contact->positions(acting));
  }
  void add_points(double least, contact::ContactProblem<dim> &problem) const;
  void follow() { friction.follow(); }

  /// Stored in the elastic slip of all ranks together [J; J/m in 2-D] (collective).
  double energy() const;

  /// See contact::Friction::hold(), release() and held_energy(); the latter of all ranks together
  /// (collective).
  void hold() { friction.hold(); }
  void release() { friction.release(); }
  double held_energy() const;

  /// Adds to local and ghost entries; the caller collects.
  void add_force(Vector &force) const;

  /// Adds minus its derivative by the displacement, which is not symmetric, to a matrix with the couplings of
  /// the contact; see contact::Friction::for_each_tangent().
  void add_tangent(TangentSystem &system) const;

  /// Accepts the step; returns what all ranks dissipated in it [J; J/m in 2-D] (collective).
  double commit();

  /// Resultants by pair over all ranks, the same on all of them (collective).
  contact::PairForces<dim> pair_forces() const { return contact->sum(friction.pair_forces()); }

  /// See contact::Friction::placed_slips(); of all ranks, on every rank, where they are in space
  /// (collective).
  std::vector<contact::PlacedSlip<dim>> placed_slips() const;

  /// See contact::Friction::remember().
  void remember(std::vector<contact::PlacedSlip<dim>> slips);

  /// What this rank's points remember, for boost's archives.
  template <typename Archive>
  void serialize(Archive &archive, unsigned int /*version*/)
  {
    archive &friction &n_searches_of_memory;
  }

private:
  /// Where the nodes were at the last commit is asked anew of their ranks once other facets are held
  /// (collective).
  void follow_surface();

  const ContactForce<dim> *contact;
  contact::Friction<dim> friction;
  MPI_Comm communicator;
  unsigned int n_searches_of_memory = 0;
};
} // namespace signorini
