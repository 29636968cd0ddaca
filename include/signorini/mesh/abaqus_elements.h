// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace signorini
{
struct AbaqusElementType
{
  unsigned int dimension;
  unsigned int n_nodes;
};

/// Type of a simplex by its name in upper case, variants such as C3D10M included; nothing for any other
/// element.
std::optional<AbaqusElementType> find_abaqus_type(const std::string &name);

/// Local vertices of the faces S1, S2, … of a simplex.
std::vector<std::vector<unsigned int>> abaqus_faces(unsigned int dimension);
} // namespace signorini
