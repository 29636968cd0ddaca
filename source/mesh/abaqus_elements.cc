// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/mesh/abaqus_elements.h"

#include <cctype>

namespace signorini
{
std::optional<AbaqusElementType> find_abaqus_type(const std::string &name)
{
  static const std::vector<std::pair<std::string, AbaqusElementType>> types{
      {"C3D10", {3, 10}}, {"C3D4", {3, 4}},   {"CPS3", {2, 3}},   {"CPE3", {2, 3}},   {"S3", {2, 3}},
      {"STRI3", {2, 3}},  {"M3D3", {2, 3}},   {"SFM3D3", {2, 3}}, {"CPS6", {2, 6}},   {"CPE6", {2, 6}},
      {"S6", {2, 6}},     {"STRI65", {2, 6}}, {"M3D6", {2, 6}},   {"SFM3D6", {2, 6}}, {"T3D2", {1, 2}},
      {"T2D2", {1, 2}},   {"T3D3", {1, 3}},   {"T2D3", {1, 3}}};
  for (const auto &[start, type] : types)
    if (name.compare(0, start.size(), start) == 0 &&
        (name.size() == start.size() || std::isalpha(static_cast<unsigned char>(name[start.size()])) != 0))
      return type;
  return {};
}

std::vector<std::vector<unsigned int>> abaqus_faces(const unsigned int dimension)
{
  return dimension == 3 ? std::vector<std::vector<unsigned int>>{{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}
                        : std::vector<std::vector<unsigned int>>{{0, 1}, {1, 2}, {2, 0}};
}
} // namespace signorini
