// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/coupling/contact_term.h"
#include "signorini/contact/potential/contact_potential.h"
#include "signorini/contact/potential/contact_problem.h"
#include "signorini/discretization/surface_map.h"
#include "signorini/physics/force_term.h"
#include "signorini/scene/obstacle_motion.h"

#include <optional>

namespace signorini
{
/// The surface contact potential as a force on the degrees of freedom.
template <int dim>
class ContactForce : public ContactTerm<dim>
{
public:
  /// `is_external`: contact with obstacles, which changes the momentum of the bodies. The surface is a copy
  /// of `map`, which holds facets of other ranks as far as they are near.
  ContactForce(const std::string &name, bool is_external, const SurfaceMap<dim> &map,
               const typename contact::ContactPotential<dim>::Obstacles &obstacles,
               const contact::PotentialSettings &settings, const MPI_Comm &communicator);

  /// Lets the obstacles move from now on; one motion each.
  void set_motions(const std::vector<ObstacleMotion<dim>> &obstacle_motions) { motions = obstacle_motions; }

  double renew(const State &state) override;
  void update(const State &state) override;
  double energy() const override;
  void add_force(Vector &force) const override;
  void add_couplings(const dealii::AffineConstraints<double> &constraints,
                     dealii::TrilinosWrappers::SparsityPattern &pattern) const override;
  void add_tangent(TangentSystem &system) const override;
  unsigned int n_searches() const override { return potential.n_searches(); }

  /// Adds the damping forces at the given velocities; returns the power dissipated by all ranks [W].
  double add_damping_force(const Vector &velocity, Vector &force) const;

  /// Adds the contact and damping forces at the given velocities to `force`, and the latter to
  /// `damping_force`.
  void add_all_forces(const Vector &velocity, Vector &force, Vector &damping_force) const;

  /// See ContactPotential::find_entries() and linearize(); after update().
  void find_entries(const Vector &start) { potential.find_entries(map.positions(start)); }
  void linearize(const Vector &start) { potential.linearize(map.positions(start)); }

  /// Adds the points of this rank that overlap by more than `least` [m], on nodes that do not hang, which the
  /// problem knows by their first degrees of freedom.
  void add_points(double least, contact::ContactProblem<dim> &problem) const;

  /// Adds one of them.
  void add_point(const contact::LinearPoint<dim> &point, contact::ContactProblem<dim> &problem) const;

  /// See ContactPotential::follow().
  void follow(const std::vector<SpatialVector<dim>> &increments, double time_step)
  {
    potential.follow(increments, time_step);
  }

  /// Holds the points, feet and normals of the last update, acting where they are at `start`, and takes the
  /// depths of later states as linear functions of the displacement, until thaw().
  void freeze(const Vector &start);
  void thaw() { is_frozen = false; }

  const SurfaceMap<dim> &nodes() const override { return map; }
  void add_row_sum_bounds(Vector &stiffness, Vector &damping) const override;
  contact::ContactMeasures<dim> measure() const override;
  contact::PairForces<dim> pair_forces(const State &state) const override;

  /// See ContactPotential::obstacle_forces(), over all ranks (collective).
  contact::ObstacleForces<dim> obstacle_forces(const Vector &velocity) const;

  /// By how much each obstacle moved from the time before to that of the last update [m].
  std::vector<SpatialVector<dim>> obstacle_increments() const;

  /// Pressure by node of this rank's surface, own nodes first, where there is area that faces another
  /// surface: force without damping over that area; of quadratic triangles, whose corners have no area, both
  /// are those of the linear functions of the corners [Pa] (collective).
  std::vector<std::optional<double>> nodal_pressures() const;

  /// This rank's facets in a contact that they are too large to see at that state, and that is deeper than
  /// `unheeded_depth` [m], see contact::find_unseen_contact() (collective).
  std::vector<unsigned int> unseen_contact(const State &state, double unheeded_depth) const;

  /// A length within which contact is looked for [m]: half the thinnest layer of cells.
  double skin() const { return potential.pair_list().skin(); }

  /// See ContactPotential::facet_errors(); of this rank's facets, and zero for others.
  std::vector<double> facet_errors() const { return potential.facet_errors(); }

  /// Pressure at the nodes of this rank's facets, [facet][node of the facet], non-zero for these only: the
  /// L2 projection of the pressure of the facet's own points onto the (bi)linear functions of the facet, cut
  /// off below 0 [Pa].
  NodalPressures<dim> facet_pressures() const;

  /// The same as a mean over the facets of all ranks under pressure at a node of this rank's surface, by
  /// area, [node] [Pa] (collective): without the noise of single points.
  std::vector<double> projected_pressures() const;

  /// See PairList::set_penalty_factor(); the energy is another one afterwards.
  void set_penalty_factor(double penalty_factor) { potential.set_penalty_factor(penalty_factor); }

  /// See PairList::set_multipliers(); of this rank's facets.
  void set_multipliers(const NodalPressures<dim> &multipliers) { potential.set_multipliers(multipliers); }

  /// How many pairs each of this rank's facets has, near its targets or in contact, [facet].
  std::vector<unsigned int> n_pairs_of_facets() const;

  /// This rank's points.
  std::vector<contact::ContactSample<dim>> samples() const;

  const ContactSurface<dim> &surface() const { return map.surface(); }

  /// Of the surface's nodes, from its origin [m].
  std::vector<SpatialVector<dim>> positions(const Vector &displacement) const
  {
    return map.positions(displacement);
  }

  /// What acts on this rank's facets; positions in it are from the surface's origin.
  const contact::ContactPotential<dim> &surface_potential() const { return potential; }

  /// What the potential remembers between two steps, for boost's archives.
  template <typename Archive>
  void serialize(Archive &archive, unsigned int /*version*/)
  {
    // What is remembered of foreign facets is told by their places: these must be held first.
    std::vector<SpatialVector<dim>> searched = potential.pair_list().positions_at_search();
    archive &searched;
    if (Archive::is_loading::value && is_any(!searched.empty()))
      take_facets(searched);
    archive &potential;
  }

private:
  /// Puts the obstacles where they are at that time.
  void move_obstacles(double time);
  /// Whether it is so on any rank (collective).
  bool is_any(bool is_here) const;
  /// Holds the facets of other ranks that are near at these positions of the own nodes (collective).
  void take_facets(const std::vector<SpatialVector<dim>> &positions);
  /// Searches neighbours of all ranks; returns this rank's part of the jump of the energy [J] (collective).
  double search(const State &state, const std::vector<SpatialVector<dim>> &positions);
  /// This rank's part of the force by node, without damping [N].
  std::vector<SpatialVector<dim>> nodal_forces() const;
  /// This rank's part of the area by node, ∫N dA over the sampled parts of the faces that face another
  /// surface [m²; m in 2-D].
  std::vector<double> nodal_areas() const;

  SurfaceMap<dim> map;
  contact::ContactPotential<dim> potential;
  bool is_frozen = false;
  std::vector<ObstacleMotion<dim>> motions; ///< one an obstacle; empty if none moves
};
} // namespace signorini
