// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/friction/differentiable.h"
#include "signorini/contact/friction/slip_history.h"

namespace signorini::contact
{
/// How a point and its target moved since the last accepted step (doc/theory.md, section 6a). `Number`:
/// double or Differentiable.
template <int dim, typename Number = double>
struct SlipMotion
{
  using Vector = VectorOf<dim, Number>;

  Vector now; ///< from the target's material point at the foot (of an obstacle: the origin) to the point [m]
  Vector before;                                                  ///< the same then [m]
  TensorOf<dim, Number> turn = TensorOf<dim, Number>::Identity(); ///< of the target, Q
  Vector shift = Vector::Zero();                                  ///< of an obstacle [m]
  Vector normal;                                                  ///< of the target now

  /// The elastic slip there was, as it would be now had nothing slipped since [m].
  Vector carry(const PointSlip<dim> &slip) const;

  /// Δs, across the normal [m].
  Vector find_increment() const;

  /// The share of the step in which a point has touched that did not when it began and overlaps by `overlap`
  /// [m] now, on a straight way; 1 for one that does not touch yet.
  Number find_share(const Number &overlap) const;

private:
  /// Of the point beyond its target [m].
  Vector find_motion() const { return now - turn * before - shift; }
};
} // namespace signorini::contact
