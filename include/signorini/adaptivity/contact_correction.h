// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/adaptivity/boundary_faces.h"
#include "signorini/adaptivity/stress_recovery.h"
#include "signorini/scene/scene.h"
#include "signorini/solvers/scene_forces.h"

namespace signorini
{
/// Consistent correction of the penalty: multipliers of the contact are the normal pressures λ = −n·σ* n of
/// the recovered stress σ*, where there is contact, so that the law p = max(0, λ + k_A d) asks for a
/// penetration no more than for what the discretisation misses. This is the traction of Nitsche's method (F.
/// Chouly, P. Hild, 2013, in its form without adjoint terms), taken from the last equilibrium: finding
/// equilibria and updating the multipliers in turn, an Uzawa iteration, leads to it.
template <int dim>
class ContactCorrection
{
public:
  /// The arguments must outlive this object; `faces`: see collect_boundary_faces().
  ContactCorrection(const Discretization<dim> &discretization, const Scene<dim> &scene,
                    const SceneForces<dim> &forces, const SurfaceMap<dim> &map,
                    const std::vector<BoundaryFace<dim>> &faces);

  /// Of all terms of contact, [term].
  using Multipliers = std::vector<NodalPressures<dim>>;

  /// Sets the multipliers by the stresses and pressures of the equilibrium `state`, which the forces were
  /// updated to. Returns their largest change over the largest of them (collective).
  double update(const State &state);

  const Multipliers &multipliers() const { return current; }

  /// Goes back to former multipliers.
  void set(Multipliers multipliers);

private:
  /// Pressure per undeformed area that balances a stress at a node of a face; `positions`: of the surface's
  /// nodes.
  double normal_pressure(const BoundaryFace<dim> &face, unsigned int node, const Eigen::Matrix3d &stress,
                         const std::vector<SpatialVector<dim>> &positions) const;

  const Scene<dim> *scene;
  const SceneForces<dim> *forces;
  const SurfaceMap<dim> *map;
  const Discretization<dim> *discretization;
  StressRecovery<dim> recovery;
  const std::vector<BoundaryFace<dim>> *faces;
  Multipliers current;
};
} // namespace signorini
