// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/discretization/supports.h"
#include "signorini/parameters/parameter_text.h"

#include <vector>

namespace signorini
{
/// Whether the supports of each body leave no rigid motion free: the Gram matrix of its rigid motions at the
/// supported degrees of freedom has full rank.
template <int dim>
std::vector<bool> find_held_bodies(const Scene<dim> &scene, const SupportedDofs<dim> &supports);

/// Throws InputError, with the place in `text`, for a body that neither supports nor possible contact hold,
/// and for bodies that can touch each other only and whose supports leave a rigid motion of them all
/// together.
template <int dim>
void check_held(const ParameterText &text, const Parameters &parameters, const Scene<dim> &scene,
                const SupportedDofs<dim> &supports);
} // namespace signorini
