// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/parameters/declarations.h"
#include "signorini/parameters/parameters.h"

#include <string>
#include <vector>

namespace signorini
{
/// Declare `Obstacle NAME`, with the keys that belong to its shape.
void declare_obstacle(Declarations &declarations, const DeclarationScope &scope, const std::string &name);

/// Read and check it. Throws InputError.
ObstacleParameters read_obstacle(const ParameterText &text, const Declarations &in_use,
                                 const std::string &name, unsigned int dimension);

/// Declare `Contact`.
void declare_contact(Declarations &declarations, const DeclarationScope &scope);

/// Read and check it; excluded pairs must name one of `bodies` and one of `bodies` or `obstacles`,
/// self-contact some of `bodies`. Throws InputError.
ContactParameters read_contact(const ParameterText &text, const Declarations &in_use,
                               const std::vector<std::string> &bodies,
                               const std::vector<std::string> &obstacles);

/// Whether these two, named in either order, never touch: one and the same unless it has self-contact.
bool is_pair_excluded(const ContactParameters &contact, const std::string &one, const std::string &other);
} // namespace signorini
