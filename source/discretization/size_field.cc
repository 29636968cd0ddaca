// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/discretization/size_field.h"

#include "signorini/discretization/body_mesh.h"
#include "signorini/discretization/surface_distance.h"
#include "signorini/mesh/simplex_geometry.h"

#include <algorithm>
#include <cmath>

namespace signorini
{
namespace
{
using DistanceField = std::function<double(const Triple &)>;

/// Distance from what the mesh is graded towards.
DistanceField make_distance(const MeshParameters &mesh, const unsigned int dimension)
{
  const MeshParameters::Grading &grading = *mesh.grading;
  if (!grading.boundary)
    return [point = grading.point](const Triple &x) { return distance(x, point); };
  const std::string boundary = *grading.boundary;
  if (mesh.shape == MeshParameters::Shape::file)
  {
    const auto to_surface = std::make_shared<SurfaceDistance>(*mesh.surface_of_file, boundary);
    return [to_surface](const Triple &x) { return (*to_surface)(x); };
  }
  if (dimension == 3)
    return [mesh, boundary](const Triple &x)
    { return distance_to_boundary<3>(mesh, boundary, dealii::Point<3>(x[0], x[1], x[2])); };
  return [mesh, boundary](const Triple &x)
  { return distance_to_boundary<2>(mesh, boundary, dealii::Point<2>(x[0], x[1])); };
}
} // namespace

SizeField make_size_field(const MeshParameters &mesh, const unsigned int dimension)
{
  const double coarse = mesh.element_size / std::pow(2., mesh.refinements);
  if (!mesh.grading)
    return [coarse](const Triple & /*point*/) { return coarse; };
  const double fine = coarse / std::pow(2., mesh.grading->levels);
  const double near = std::max(mesh.grading->distance, fine);
  return [coarse, fine, near, to_fine = make_distance(mesh, dimension)](const Triple &x)
  { return std::min(coarse, fine * std::max(1., to_fine(x) / near)); };
}

double coarsest_size(const MeshParameters &mesh, const unsigned int dimension)
{
  double longest = mesh.element_size;
  for (unsigned int d = 0; d < dimension && mesh.element_size == 0.; ++d)
    longest = std::max(longest, (mesh.upper_corner[d] - mesh.lower_corner[d]) / mesh.cells[d]);
  return longest;
}
} // namespace signorini
