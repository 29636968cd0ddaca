// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Core>
#include <boost/container/static_vector.hpp>

#include <array>

namespace signorini::contact
{
/// A convex polyhedron (polygon in 2-D), the overlap of two simplices or a part of it.
///
/// A vertex is not given by its position but by its barycentric coordinates with respect to both simplices,
/// those of the first one before those of the second. All planes ever cut along are zeros of linear functions
/// of these, so a cut needs no geometry, and nothing is lost far from the origin of the coordinates.
///
/// The polytope is closed combinatorially: every edge of a face is the reversed edge of another one (in 2-D:
/// every segment ends where another begins), however the vertices lie by the plane that cuts.
template <int dim>
class ConvexPolytope
{
public:
  static constexpr unsigned int n_coordinates = 2 * (dim + 1);
  using Coordinates = Eigen::Matrix<double, n_coordinates, 1>;

  struct Face
  {
    unsigned int label = 0; ///< of the plane it lies in
    boost::container::static_vector<unsigned int, 16>
        vertices; ///< anticlockwise as seen from outside; in 2-D begin and end
  };

  using Vertices = boost::container::static_vector<Coordinates, 32>;
  using Faces = boost::container::static_vector<Face, 16>;
  using Distances = std::array<double, 32>;

  /// Nothing.
  ConvexPolytope() = default;

  /// The simplex with these vertices; the face opposite vertex i gets the label i.
  explicit ConvexPolytope(const std::array<Coordinates, dim + 1> &corners);

  /// Keeps the part where a linear function is positive that has these values at the vertices, one a vertex,
  /// and labels the face made by the cut. Values within `tolerance` of zero count as zero: vertices there
  /// stay as they are. Without a vertex beyond, nothing changes; without a vertex inside, nothing is left.
  void clip(Distances distances, unsigned int label, double tolerance);

  bool is_empty() const { return faces_.empty(); }
  const Vertices &vertices() const { return vertices_; }
  const Faces &faces() const { return faces_; }

  /// Calls `visit(corners)` for simplices that make up a face, each an array of dim pointers to coordinates.
  template <typename Visit>
  void for_each_part(const Face &face, const Visit &visit) const
  {
    std::array<const Coordinates *, dim> corners;
    corners[0] = &vertices_[face.vertices[0]];
    for (std::size_t i = 1; i + (dim - 2) < face.vertices.size(); ++i)
    {
      for (unsigned int j = 1; j < dim; ++j)
        corners[j] = &vertices_[face.vertices[i + j - 1]];
      visit(corners);
    }
  }

private:
  class Cut;

  Vertices vertices_;
  Faces faces_;
};
} // namespace signorini::contact
