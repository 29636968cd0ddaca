// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/adaptivity/boundary_faces.h"
#include "signorini/adaptivity/error_estimate.h"
#include "signorini/adaptivity/stress_recovery.h"
#include "signorini/discretization/surface_map.h"
#include "signorini/scene/scene.h"
#include "signorini/solvers/scene_forces.h"

namespace signorini
{
/// Estimates the error of an equilibrium in two parts.
///
/// *Discretisation:* η_K² = ∫_K (σ* − σ_h) : C⁻¹ : (σ* − σ_h) dV with a recovered stress σ*, which on
/// boundary faces is made to balance what is known of their traction t: σ* n = t with t of the loads, of
/// contact, or zero, in every component that no support prescribes. A free face and a face under contact
/// pressure are not the same. Faces that the volume potential presses on, which knows no traction, stay as
/// recovered.
///
/// *Contact:* η_K² = Σ_q A_q k_A d_q² over the points of the cell's facets; W of every overlap of the volume
/// potential that the cell takes part in, as the sum over both cells is 2W then too. Load controlled, the
/// penalty lowers the minimum of the energy by half the sum of these, as ‖e‖²/2 raises it for a
/// discretisation error e.
template <int dim>
class ErrorEstimator
{
public:
  /// The arguments must outlive this object. `map` is null in scenes without contact.
  ErrorEstimator(const Discretization<dim> &discretization, const Scene<dim> &scene,
                 const SceneForces<dim> &forces, const SurfaceMap<dim> *map);

  /// Of `state`, which the forces must have been updated to (collective).
  ErrorEstimate estimate(const State &state);

  /// Of all contact, [facet][node of the facet], non-zero for this rank's facets only [Pa].
  NodalPressures<dim> contact_pressures() const;

  const std::vector<BoundaryFace<dim>> &boundary_faces() const { return faces; }

private:
  void balance_tractions(const BoundaryFace<dim> &face, double time, const NodalPressures<dim> &pressures,
                         std::vector<Eigen::Matrix3d> &nodal) const;
  SpatialVector<dim> load_traction(const BoundaryFace<dim> &face, unsigned int node, double time) const;
  /// [boundary face]
  std::vector<bool> find_unknown_tractions() const;
  void add_contact_errors(ErrorEstimate &result) const;
  void find_unseen_contact(const State &state, ErrorEstimate &result) const;
  double squared_error(unsigned int cell, const std::vector<Eigen::Matrix3d> &nodal) const;

  const Discretization<dim> *discretization;
  const Scene<dim> *scene;
  const SceneForces<dim> *forces;
  const SurfaceMap<dim> *map;
  StressRecovery<dim> recovery;
  std::vector<BoundaryFace<dim>> faces;
};
} // namespace signorini
