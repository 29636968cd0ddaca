// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/discretization/discretization.h"
#include "signorini/physics/momentum.h"
#include "signorini/physics/state.h"
#include "signorini/scene/scene.h"

namespace signorini
{
/// Adapts the mesh of a moving scene by the flags of its cells and carries the motion over (doc/theory.md,
/// section 11; collective):
///
/// - Displacement and velocity are interpolated, except that the affine field which fits a body best in the
///   mean of squares is evaluated at the new nodes themselves: where these lie on a curve and not between
///   the old ones, a body that has turned is not strained by it. Components that a support of the body
///   prescribes are interpolated as they are.
/// - What points remember is interpolated as Discretization::adapt() does.
/// - The densities in `scene` are scaled so that every body keeps its mass.
/// - Every body gets the rigid velocity that gives it back its momentum and its angular momentum, as far as
///   no support of the body acts on them.
///
/// Returns by how much the momentum, and its moment about the origin, of bodies with supports changed
/// otherwise.
template <int dim>
VectorAndMoment adapt_in_motion(Scene<dim> &scene, Discretization<dim> &discretization, State &state,
                                PointValues &memory);
} // namespace signorini
