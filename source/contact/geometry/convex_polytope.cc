// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/geometry/convex_polytope.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace signorini::contact
{
template <int dim>
ConvexPolytope<dim>::ConvexPolytope(const std::array<Coordinates, dim + 1> &corners)
    : vertices_(corners.begin(), corners.end())
{
  if constexpr (dim == 2)
    faces_ = {Face{0, {1, 2}}, Face{1, {2, 0}}, Face{2, {0, 1}}};
  else
    faces_ = {Face{0, {1, 2, 3}}, Face{1, {0, 3, 2}}, Face{2, {0, 1, 3}}, Face{3, {0, 2, 1}}};
}

/// One polytope on its way to what a cut leaves of it.
template <int dim>
class ConvexPolytope<dim>::Cut
{
public:
  Cut(const ConvexPolytope &whole_polytope, const Distances &distances_of_vertices)
      : whole(whole_polytope), distances(distances_of_vertices)
  {
    kept.fill(none);
  }

  void add_part_inside(const Face &face)
  {
    if (std::none_of(face.vertices.begin(), face.vertices.end(),
                     [this](unsigned int v) { return distances[v] > 0.; }))
      return;
    Face part{face.label, {}};
    const std::size_t n = face.vertices.size();
    for (std::size_t i = 0; i < n; ++i)
    {
      const unsigned int begin = face.vertices[i], end = face.vertices[(i + 1) % n];
      if (distances[begin] >= 0.)
        part.vertices.push_back(keep(begin));
      const bool is_edge = dim == 3 || i == 0; // a segment has no way back
      if (is_edge && distances[begin] * distances[end] < 0.)
        part.vertices.push_back(cut_edge(begin, end));
    }
    add_rim(part);
    faces.push_back(part);
  }

  /// Closes the hole with faces in the plane of the cut, one unless round-off bent the polytope. What is left
  /// of the surface has its rim in that plane, and a rim is closed: every edge has a next one.
  void close(unsigned int label)
  {
    while (!rim.empty())
    {
      Face face{label, {rim.back().first, rim.back().second}};
      rim.pop_back();
      if constexpr (dim == 3)
        while (face.vertices.back() != face.vertices.front())
        {
          const auto next = std::find_if(
              rim.begin(), rim.end(), [&](const Edge &edge) { return edge.first == face.vertices.back(); });
          face.vertices.push_back(next->second);
          rim.erase(next);
        }
      if (dim == 3)
        face.vertices.pop_back();
      if (face.vertices.size() >= dim && face.vertices.front() != face.vertices.back())
        faces.push_back(face);
    }
  }

  Vertices vertices;
  Faces faces;

private:
  static constexpr unsigned int none = -1;
  using Edge = std::pair<unsigned int, unsigned int>;

  unsigned int add_vertex(const Coordinates &coordinates, bool lies_in_plane)
  {
    is_in_plane.push_back(lies_in_plane);
    vertices.push_back(coordinates);
    return static_cast<unsigned int>(vertices.size() - 1);
  }

  unsigned int keep(unsigned int vertex)
  {
    if (kept[vertex] == none)
      kept[vertex] = add_vertex(whole.vertices_[vertex], distances[vertex] == 0.);
    return kept[vertex];
  }

  /// Both faces at an edge get the same new vertex.
  unsigned int cut_edge(unsigned int begin, unsigned int end)
  {
    const Edge edge = std::minmax(begin, end);
    for (const auto &[known, vertex] : cut_edges)
      if (known == edge)
        return vertex;
    const double from = distances[begin], to = distances[end];
    const unsigned int vertex =
        add_vertex((from * whole.vertices_[end] - to * whole.vertices_[begin]) / (from - to), true);
    cut_edges.emplace_back(edge, vertex);
    return vertex;
  }

  /// The cut face runs along the edges in the plane the other way round. In 2-D it begins where a segment
  /// ends in the plane, and ends where one begins.
  void add_rim(const Face &part)
  {
    const std::size_t n = part.vertices.size();
    if constexpr (dim == 3)
    {
      for (std::size_t i = 0; i < n; ++i)
      {
        const unsigned int begin = part.vertices[i], end = part.vertices[(i + 1) % n];
        if (is_in_plane[begin] && is_in_plane[end])
          rim.emplace_back(end, begin);
      }
    }
    else
    {
      const auto complete = [this](unsigned int Edge::*end, unsigned int vertex)
      {
        const auto open =
            std::find_if(rim.begin(), rim.end(), [end](const Edge &edge) { return edge.*end == none; });
        if (open != rim.end())
          (*open).*end = vertex;
        else
          rim.emplace_back(end == &Edge::first ? Edge{vertex, none} : Edge{none, vertex});
      };
      if (is_in_plane[part.vertices[1]])
        complete(&Edge::first, part.vertices[1]);
      if (is_in_plane[part.vertices[0]])
        complete(&Edge::second, part.vertices[0]);
    }
  }

  const ConvexPolytope &whole;
  const Distances &distances;
  std::array<unsigned int, 32> kept;
  boost::container::static_vector<bool, 32> is_in_plane;
  boost::container::static_vector<std::pair<Edge, unsigned int>, 32> cut_edges;
  boost::container::static_vector<Edge, 32> rim;
};

template <int dim>
void ConvexPolytope<dim>::clip(Distances distances, unsigned int label, double tolerance)
{
  bool has_inside = false, has_outside = false;
  for (std::size_t v = 0; v < vertices_.size(); ++v)
  {
    if (std::abs(distances[v]) <= tolerance)
      distances[v] = 0.;
    has_inside |= distances[v] > 0.;
    has_outside |= distances[v] < 0.;
  }
  if (!has_inside)
  {
    vertices_.clear();
    faces_.clear();
  }
  else if (has_outside)
  {
    Cut cut(*this, distances);
    for (const Face &face : faces_)
      cut.add_part_inside(face);
    cut.close(label);
    vertices_ = std::move(cut.vertices);
    faces_ = std::move(cut.faces);
  }
}

template class ConvexPolytope<2>;
template class ConvexPolytope<3>;
} // namespace signorini::contact
