// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/coupling/friction_force.h"
#include "signorini/discretization/supports.h"
#include "signorini/physics/momentum.h"

#include <memory>
#include <unordered_map>
#include <vector>

namespace signorini
{
/// The contact forces of an explicit step, found implicitly: from the positions that a step without contact
/// leads to, those increments δ of the nodes near contact that the forces at the end of the step give their
/// masses (contact::ContactProblem). The step is then as long as the bodies allow, whatever the penalty; the
/// surface takes the energy of what bounces within a step out of the motion, which is booked.
///
/// Momenta are exact: forces of a pair are equal and opposite and have no moment about the positions at the
/// start of the step, where they act (doc/theory.md, section 7).
template <int dim>
class ImplicitContact
{
public:
  using Terms = std::vector<std::shared_ptr<ContactForce<dim>>>;
  using Frictions = std::vector<std::shared_ptr<FrictionForce<dim>>>;

  /// What a step did besides moving the nodes.
  struct Booking
  {
    double loss = 0.;              ///< energy that the step took out of motion and contact [J]
    double dissipated = 0.;        ///< by the damping [J]
    double rubbed_off = 0.;        ///< by friction [J]
    double work_of_obstacles = 0.; ///< that of what moves them [J]
    VectorAndMoment outer_impulse; ///< of obstacles, about the start of the step [N s]
  };

  /// `frictions`: one on each of the terms, or none. `mass` is the lumped one. The arguments must outlive
  /// this object.
  ImplicitContact(const Discretization<dim> &discretization, const SupportedDofs<dim> &supports,
                  const Terms &terms, const Frictions &frictions, const Vector &mass);

  /// Takes the energy of the contact at the last update of the terms, to `state`, for that of the start
  /// (collective).
  void start(const State &state);

  /// Moves `state`, where a step of this length from `start` without contact forces has led, to where it
  /// leads with them, and accepts the slips. `other_force`: on the nodes at the start of the step, without
  /// contact. Throws NumericalError.
  Booking move(const Vector &start, double time_step, const Vector &other_force, State &state);

  /// Forces of the last move, damping and friction included, on all nodes [N].
  const Vector &force() const { return total_force; }

  /// What is remembered from step to step, for boost's archives.
  template <typename Archive>
  void serialize(Archive &archive, unsigned int /*version*/)
  {
    archive &stored;
  }

private:
  using Increments = std::vector<SpatialVector<dim>>;

  /// Nodes of the problem of one step, the same on every rank, by their first degrees of freedom.
  using NumberOfNode = std::unordered_map<dealii::types::global_dof_index, unsigned int>;

  /// Of the nodes of each term, [term] (collective).
  std::vector<Increments> find_increments(double least, double time_step) const;
  /// Of the problem's nodes, by number (collective).
  std::vector<SpatialVector<dim>> gather_masses(const NumberOfNode &number_of_node) const;
  static Increments pick(const Increments &increments, const NumberOfNode &number_of_node,
                         const NodeMap<dim> &map);
  void compute_forces();
  void book_obstacles(const State &state, Booking &booking) const;

  const Discretization<dim> *discretization;
  const Terms *terms;
  const Frictions *frictions;
  Vector inverse_mass; ///< 0 where a support holds or a node hangs
  std::unordered_map<dealii::types::global_dof_index, SpatialVector<dim>>
      surface_masses;   ///< of this rank's surface nodes, infinite where a support holds [kg; kg/m in 2-D]
  Vector elastic_force; ///< of springs and elastic slips
  Vector damping_force, total_force, outer_force;
  double stored = 0.; ///< energy in springs and elastic slips at the end of the last move [J]
};
} // namespace signorini
