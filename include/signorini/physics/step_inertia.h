// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/discretization/discretization.h"
#include "signorini/physics/force_term.h"

namespace signorini
{
/// The inertia of an implicit step by the midpoint rule, as a force that derives from
/// (u − u_n)·M (u − u_n)/Δt²: the displacement u at the end of the step costs the velocity 2 (u − u_n)/Δt −
/// v_n.
template <int dim>
class StepInertia : public ForceTerm
{
public:
  /// `lumped_mass` must outlive this object.
  explicit StepInertia(const Vector &lumped_mass);

  /// The step begins at `start` and lasts so long [s].
  void set_step(const Vector &start, double time_step);

  void update(const State &state) override;
  double energy() const override;
  void add_force(Vector &force) const override;
  void add_tangent(TangentSystem &system) const override;

private:
  const Vector *mass;
  Vector start;
  Vector way; ///< u − u_n, owned entries
  double time_step = 0.;
};

/// A force that stays as it is.
template <int dim>
class ConstantForce : public ForceTerm
{
public:
  explicit ConstantForce(const std::string &name);

  /// `nodal` on free degrees of freedom [N]; its energy counts from the displacement `start`.
  void set(const Vector &nodal, const Vector &start);

  void update(const State &state) override;
  double energy() const override { return work_to_do; }
  void add_force(Vector &force) const override;

private:
  Vector nodal, start;
  double work_to_do = 0.;
};
} // namespace signorini
