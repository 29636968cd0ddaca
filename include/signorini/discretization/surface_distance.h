// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/mesh/simplex_mesh.h"

#include <memory>
#include <string>

namespace signorini
{
/// Distance from the faces of one boundary: triangles, in 2-D edges.
class SurfaceDistance
{
public:
  /// The boundary must be one of the mesh, which may be without cells.
  SurfaceDistance(const SimplexMesh &mesh, const std::string &boundary);
  ~SurfaceDistance();

  /// [m]
  double operator()(const Triple &point) const;

private:
  struct Tree;
  std::unique_ptr<Tree> tree;
};
} // namespace signorini
