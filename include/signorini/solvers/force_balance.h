// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/base/run_time.h"
#include "signorini/discretization/supports.h"
#include "signorini/discretization/surface_map.h"
#include "signorini/solvers/scene_forces.h"

#include <functional>

namespace signorini
{
/// The forces on all nodes and how far every body is from equilibrium.
///
/// Bodies may differ by orders of magnitude in force, so each is judged by itself: the norm of its residual
/// over the root of the sum of squares of the elastic, contact and load forces on it, each counted before
/// they cancel. A body that carries no load and whose forces are all round-off is at rest.
template <int dim>
class ForceBalance
{
public:
  /// The arguments must outlive this object. `map` is null in scenes without contact.
  ForceBalance(const Discretization<dim> &discretization, const SupportedDofs<dim> &supports,
               unsigned int n_bodies, const SceneForces<dim> &forces, const SurfaceMap<dim> *map,
               RunTime &run_time);

  /// Forces at `state` (collective).
  void compute(const State &state);

  /// Sum of all forces on free degrees of freedom, zero on supported ones [N].
  const Vector &residual() const { return free_forces; }

  /// Forces that the supports exert, on supported entries only [N].
  const Vector &reactions() const { return support_forces; }

  /// Computes the forces and judges the bodies by them (collective). Returns the largest relative residual,
  /// NaN where forces are not finite.
  double judge(const State &state);

  /// Whether all bodies were last judged within the tolerance; or, where the residual stopped falling, within
  /// what round-off lets it be evaluated to.
  bool is_within(double tolerance, bool has_stagnated) const;

  /// The body farthest from equilibrium at the last judgement.
  unsigned int worst_body() const;

  bool is_touched(unsigned int body) const { return norms[body].contact > 0.; }

  bool is_loaded(unsigned int body) const { return norms[body].load > 0.; }

  /// Resultant of a body's residual forces where they nearly all point one way, as those of a body that
  /// nothing holds in that direction do; else zero [N] (collective).
  SpatialVector<dim> unbalanced_force(unsigned int body) const;

  /// What round-off may leave of a body's residual, relative like that.
  double round_off_share(unsigned int body) const { return round_off_shares[body]; }

  /// The energy of all terms and the held energy of friction at the state of compute() [J] (collective).
  double energy() const;

  const std::vector<std::shared_ptr<ForceTerm>> &terms() const { return all_terms; }

  /// What is remembered from one state to the next, for boost's archives.
  template <typename Archive>
  void serialize(Archive &archive, unsigned int /*version*/)
  {
    archive &largest_magnitudes;
  }

private:
  struct BodyNorms
  {
    double elastic = 0., contact = 0., load = 0.; ///< [N]
    double scale() const;
  };

  double &norm_of(ForceTerm::Kind kind, unsigned int body);
  std::vector<double> compute_body_norms(const Vector &values) const;
  Vector compute_contact_round_off(const State &state) const;

  const Discretization<dim> *discretization;
  const SupportedDofs<dim> *supports;
  const SceneForces<dim> *forces;
  const SurfaceMap<dim> *map;
  RunTime *run_time;
  std::vector<std::shared_ptr<ForceTerm>> all_terms;

  /// Adds to the residual and the norms of that kind what `add_force` adds to local and ghost entries.
  void add(ForceTerm::Kind kind, const std::function<void(Vector &)> &add_force);

  const Vector velocity; ///< none
  Vector free_forces, support_forces;
  std::vector<BodyNorms> norms;
  std::vector<double> largest_magnitudes; ///< [body] of elastic forces before they cancel, so far [N]
  std::vector<double> relative_residuals, round_off_shares; ///< of every body at the last judgement
};
} // namespace signorini
