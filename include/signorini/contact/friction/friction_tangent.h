// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/friction/slip_history.h"
#include "signorini/contact/potential/contact_pair.h"

#include <Eigen/Core>

namespace signorini::contact
{
/// A point in a step under way.
template <int dim>
struct RubbingPoint
{
  const ContactPair<dim> &pair;
  const PairFoot<dim> &foot;
  const PairStencil<dim> &stencil;
  const Facet<dim> *target;        ///< null on an obstacle
  const PointSlip<dim> &before;    ///< at the last accepted step
  bool is_held = false;            ///< sticks whatever its limit
  SpatialVector<dim> old_position; ///< of the point, then [m]
  double coefficient = 0.;         ///< of friction, μ
};

/// Minus the derivative of the forces of friction on the nodes of the stencil by their positions, node-major,
/// for a pressure without damping. All that depends on the positions is counted: pressure, normal, foot, turn
/// of the target and place of the force; hence it is not symmetric. By automatic differentiation.
/// `target` and `old_target` are the nodes of the target facet now and at the last accepted step. Overwrites
/// `block`.
template <int dim>
void compute_body_friction_tangent(const RubbingPoint<dim> &point, const FacetNodes<dim> &target,
                                   const FacetNodes<dim> &old_target, Eigen::MatrixXd &block);

/// The same on an obstacle that moved by `shift` since, with the Hessian of its depth. Overwrites `block`.
template <int dim>
void compute_obstacle_friction_tangent(const RubbingPoint<dim> &point, const SpatialVector<dim> &shift,
                                       const SpatialTensor<dim> &depth_hessian, Eigen::MatrixXd &block);
} // namespace signorini::contact
