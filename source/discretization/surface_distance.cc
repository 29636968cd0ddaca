// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/discretization/surface_distance.h"

#include <Eigen/Dense>

#include <algorithm>
#include <limits>

namespace signorini
{
namespace
{
using Corner = Eigen::Vector3d;

constexpr std::size_t most_faces_of_leaf = 4;

double distance_to_edge(const Corner &point, const Corner &a, const Corner &b)
{
  const Corner along = b - a;
  const double at = std::clamp((point - a).dot(along) / along.squaredNorm(), 0., 1.);
  return (point - a - at * along).norm();
}

/// The foot in the plane counts if it lies inside, else the nearest edge.
double distance_to_triangle(const Corner &point, const std::array<Corner, 3> &corners)
{
  const Corner normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  bool is_inside = true;
  double to_edges = std::numeric_limits<double>::max();
  for (unsigned int v = 0; v < 3; ++v)
  {
    const Corner &a = corners[v], &b = corners[(v + 1) % 3];
    is_inside = is_inside && (b - a).cross(point - a).dot(normal) >= 0.;
    to_edges = std::min(to_edges, distance_to_edge(point, a, b));
  }
  return is_inside ? std::abs((point - corners[0]).dot(normal.normalized())) : to_edges;
}
} // namespace

/// A binary tree of boxes about faces, halved along their longest side.
struct SurfaceDistance::Tree
{
  struct Face
  {
    std::array<Corner, 3> corners;
    Corner centre = Corner::Zero();
  };
  struct Box
  {
    Corner low, high;
    std::size_t begin, end;            // faces
    std::size_t first = 0, second = 0; // boxes; none in a leaf
  };

  unsigned int dimension;
  std::vector<Face> faces;
  std::vector<Box> boxes;

  std::size_t add_box(const std::size_t begin, const std::size_t end)
  {
    Box box{Corner::Constant(std::numeric_limits<double>::max()),
            Corner::Constant(std::numeric_limits<double>::lowest()), begin, end};
    for (std::size_t face = begin; face < end; ++face)
      for (unsigned int v = 0; v < dimension; ++v)
      {
        box.low = box.low.cwiseMin(faces[face].corners[v]);
        box.high = box.high.cwiseMax(faces[face].corners[v]);
      }
    const std::size_t number = boxes.size();
    boxes.push_back(box);
    if (end - begin > most_faces_of_leaf)
    {
      Eigen::Index axis = 0;
      (box.high - box.low).maxCoeff(&axis);
      const std::size_t middle = (begin + end) / 2;
      std::nth_element(faces.begin() + begin, faces.begin() + middle, faces.begin() + end,
                       [axis](const Face &a, const Face &b) { return a.centre[axis] < b.centre[axis]; });
      const std::size_t first = add_box(begin, middle), second = add_box(middle, end);
      boxes[number].first = first;
      boxes[number].second = second;
    }
    return number;
  }

  double to_box(const std::size_t number, const Corner &point) const
  {
    const Box &box = boxes[number];
    return (box.low - point).cwiseMax(point - box.high).cwiseMax(0.).norm();
  }

  /// Lowers `least` to the distance of the nearest face in a box.
  void search(const std::size_t number, const Corner &point, double &least) const
  {
    if (to_box(number, point) >= least)
      return;
    const Box &box = boxes[number];
    if (box.first == 0)
    {
      for (std::size_t face = box.begin; face < box.end; ++face)
      {
        const std::array<Corner, 3> &corners = faces[face].corners;
        least = std::min(least, dimension == 3 ? distance_to_triangle(point, corners)
                                               : distance_to_edge(point, corners[0], corners[1]));
      }
      return;
    }
    const bool is_second_nearer = to_box(box.second, point) < to_box(box.first, point);
    search(is_second_nearer ? box.second : box.first, point, least);
    search(is_second_nearer ? box.first : box.second, point, least);
  }
};

SurfaceDistance::SurfaceDistance(const SimplexMesh &mesh, const std::string &boundary)
    : tree(std::make_unique<Tree>())
{
  tree->dimension = mesh.dimension;
  for (const SimplexMesh::Face &face : mesh.faces)
    if (mesh.boundary_names[face.boundary] == boundary)
    {
      tree->faces.emplace_back();
      for (unsigned int v = 0; v < mesh.dimension; ++v)
      {
        const Corner corner(mesh.vertices[face.vertices[v]].data());
        tree->faces.back().corners[v] = corner;
        tree->faces.back().centre += corner / mesh.dimension;
      }
    }
  tree->add_box(0, tree->faces.size());
}

SurfaceDistance::~SurfaceDistance() = default;

double SurfaceDistance::operator()(const Triple &point) const
{
  double least = std::numeric_limits<double>::max();
  tree->search(0, Corner(point.data()), least);
  return least;
}
} // namespace signorini
