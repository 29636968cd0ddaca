// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

namespace signorini
{
/// Throws InputError unless the file is one of Gmsh's (2.2 or 4.1) or legacy VTK with all its parts, text
/// ones with as many nodes and elements as they say. Gmsh itself runs what it does not know as a script,
/// leaves out elements beyond the number stated, and falls over a missing node.
void check_gmsh_format(const std::string &path);
} // namespace signorini
