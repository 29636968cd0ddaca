// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/base/spatial_vector.h"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace signorini
{
/// A tetrahedron (triangle in 2-D) of a body that may overlap those of other bodies. Its vertices may come in
/// any order.
template <int dim>
struct Simplex
{
  static constexpr unsigned int n_vertices = dim + 1;

  std::array<unsigned int, n_vertices> vertices{}; ///< nodes of the volume, or its centres counted after them
  unsigned int body = 0;                           ///< index of the body it belongs to
  unsigned int cell = 0;                           ///< index of its element among those of all ranks
  bool owned = true;                               ///< whether this rank evaluates its pairs
  double youngs_modulus = 0.;                      ///< E [Pa]
  double density = 0.;                             ///< ρ [kg/m³]
  double height = 0.;          ///< H: undeformed height above its outer face, see compute_heights() [m]
  double layer_thickness = 0.; ///< h: undeformed size of its element along the normal of that face [m]
};

/// The bodies of a scene as the volume potential sees them: simplices on nodes. Bodies share no nodes. Every
/// rank holds all simplices; `Simplex::owned` says whose pairs it evaluates.
template <int dim>
struct ContactVolume
{
  /// All positions are from here [m]: near the bodies, so that overlaps keep their digits in scenes far from
  /// the origin of the coordinates.
  SpatialVector<dim> origin = SpatialVector<dim>::Zero();
  std::vector<SpatialVector<dim>> reference_positions; ///< one a node, undeformed [m]

  /// Further vertices, each the mean of these nodes: centres of cells and of their faces.
  std::vector<std::vector<unsigned int>> centres;
  std::vector<Simplex<dim>> simplices;
  unsigned int n_bodies = 0;

  unsigned int n_nodes() const { return static_cast<unsigned int>(reference_positions.size()); }

  /// Calls `visit(node, weight)` for the nodes whose weighted mean the vertex is.
  template <typename Visit>
  void for_each_node(unsigned int vertex, const Visit &visit) const
  {
    if (vertex < n_nodes())
      return visit(vertex, 1.);
    const std::vector<unsigned int> &nodes = centres[vertex - n_nodes()];
    for (const unsigned int node : nodes)
      visit(node, 1. / static_cast<double>(nodes.size()));
  }

  /// Positions of all vertices, nodes first, where the nodes lie at `positions` [m].
  std::vector<SpatialVector<dim>> vertex_positions(const std::vector<SpatialVector<dim>> &positions) const
  {
    std::vector<SpatialVector<dim>> all(positions);
    for (unsigned int vertex = n_nodes(); vertex < n_nodes() + centres.size(); ++vertex)
    {
      all.push_back(SpatialVector<dim>::Zero());
      for_each_node(vertex,
                    [&](unsigned int node, double weight) { all.back() += weight * positions[node]; });
    }
    return all;
  }
};

/// Splits quadrilaterals into 4 triangles through their centre, and hexahedra into 24 tetrahedra through
/// their centre and the centres of their faces, so that neighbours agree on their common face.
template <int dim>
class CellSplitter
{
public:
  using Cell = std::array<unsigned int, 1 << dim>; ///< nodes in lexicographic order: (i, j, k) at i + 2j + 4k

  /// Splits cells into simplices of `contact_volume`, which must outlive this object.
  explicit CellSplitter(ContactVolume<dim> &contact_volume) : volume(contact_volume) {}

  /// Appends the simplices of a cell, each with the properties of `properties`. All nodes must be there
  /// before, as centres are counted after them.
  void add(const Cell &cell, Simplex<dim> properties)
  {
    const unsigned int centre = centre_of({cell.begin(), cell.end()});
    for (unsigned int axis = 0; axis < dim; ++axis)
      for (unsigned int side = 0; side < 2; ++side)
      {
        std::array<unsigned int, 1 << (dim - 1)> face;
        unsigned int n = 0;
        for (unsigned int i = 0; i < cell.size(); ++i)
          if ((i >> axis & 1) == side)
            face[n++] = cell[i];
        if constexpr (dim == 2)
          append({face[0], face[1], centre}, properties);
        else
        {
          const unsigned int middle = centre_of({face.begin(), face.end()});
          const std::array<unsigned int, 4> around{face[0], face[1], face[3], face[2]};
          for (unsigned int i = 0; i < 4; ++i)
            append({around[i], around[(i + 1) % 4], middle, centre}, properties);
        }
      }
  }

private:
  void append(const std::array<unsigned int, dim + 1> &vertices, Simplex<dim> &simplex)
  {
    simplex.vertices = vertices;
    volume.simplices.push_back(simplex);
  }

  unsigned int centre_of(std::vector<unsigned int> nodes)
  {
    std::sort(nodes.begin(), nodes.end());
    const auto [entry, is_new] =
        known.emplace(nodes, volume.n_nodes() + static_cast<unsigned int>(volume.centres.size()));
    if (is_new)
      volume.centres.push_back(nodes);
    return entry->second;
  }

  ContactVolume<dim> &volume;
  std::map<std::vector<unsigned int>, unsigned int> known;
};

/// Volume of a simplex [m³; m² in 2-D], whatever the order of its vertices.
template <int dim>
double measure_simplex(const std::array<SpatialVector<dim>, dim + 1> &x)
{
  SpatialTensor<dim> edges;
  for (unsigned int i = 0; i < dim; ++i)
    edges.col(i) = x[i + 1] - x[0];
  return std::abs(edges.determinant()) / (dim == 2 ? 2. : 6.);
}

/// Area of the face opposite one vertex [m²; m in 2-D].
template <int dim>
double measure_face(const std::array<SpatialVector<dim>, dim + 1> &x, unsigned int opposite)
{
  std::array<SpatialVector<dim>, dim> corner;
  for (unsigned int i = 0; i < dim; ++i)
    corner[i] = x[i < opposite ? i : i + 1];
  if constexpr (dim == 2)
    return (corner[1] - corner[0]).norm();
  else
  {
    const SpatialVector<dim> u = corner[1] - corner[0], v = corner[2] - corner[0];
    return .5 * std::sqrt(std::max(0., u.squaredNorm() * v.squaredNorm() - u.dot(v) * u.dot(v)));
  }
}

/// Sets H and h of all simplices from the undeformed positions. H is the mean height above the outer faces,
/// those that belong to no other simplex, and dim·V over the mean area of all faces where there is none. h is
/// H, or 2H in a simplex that reaches from an outer face to the centre of a split cell. Simplices that touch
/// the surface with an edge or a corner lie in the layer of those around: their h is the mean of the h there,
/// by area.
template <int dim>
void compute_heights(ContactVolume<dim> &volume)
{
  using Face = std::array<unsigned int, dim>;
  const auto face_of = [](const Simplex<dim> &simplex, unsigned int opposite)
  {
    Face face;
    for (unsigned int i = 0; i < dim; ++i)
      face[i] = simplex.vertices[i < opposite ? i : i + 1];
    std::sort(face.begin(), face.end());
    return face;
  };
  std::map<Face, unsigned int> n_simplices;
  for (const Simplex<dim> &simplex : volume.simplices)
    for (unsigned int i = 0; i <= dim; ++i)
      ++n_simplices[face_of(simplex, i)];

  const auto positions = volume.vertex_positions(volume.reference_positions);
  // of the outer faces at every vertex
  std::vector<double> areas(positions.size(), 0.), layer_volumes(positions.size(), 0.);
  std::vector<Simplex<dim> *> without_outer_face;
  for (Simplex<dim> &simplex : volume.simplices)
  {
    std::array<SpatialVector<dim>, dim + 1> x;
    for (unsigned int i = 0; i <= dim; ++i)
      x[i] = positions[simplex.vertices[i]];
    double area = 0., inverse_areas = 0.;
    std::vector<unsigned int> outer_faces;
    for (unsigned int i = 0; i <= dim; ++i)
    {
      area += measure_face<dim>(x, i) / (dim + 1);
      if (n_simplices[face_of(simplex, i)] == 1)
      {
        inverse_areas += 1. / measure_face<dim>(x, i);
        outer_faces.push_back(i);
      }
    }
    simplex.height =
        dim * measure_simplex<dim>(x) *
        (outer_faces.empty() ? 1. / area : inverse_areas / static_cast<double>(outer_faces.size()));
    const bool is_part_of_cell = std::any_of(simplex.vertices.begin(), simplex.vertices.end(),
                                             [&](unsigned int v) { return v >= volume.n_nodes(); });
    simplex.layer_thickness = (is_part_of_cell ? 2. : 1.) * simplex.height;
    for (const unsigned int i : outer_faces)
      for (const unsigned int vertex : face_of(simplex, i))
      {
        areas[vertex] += measure_face<dim>(x, i);
        layer_volumes[vertex] += measure_face<dim>(x, i) * simplex.layer_thickness;
      }
    if (outer_faces.empty())
      without_outer_face.push_back(&simplex);
  }

  for (Simplex<dim> *simplex : without_outer_face)
  {
    double area = 0., layer_volume = 0.;
    for (const unsigned int vertex : simplex->vertices)
    {
      area += areas[vertex];
      layer_volume += layer_volumes[vertex];
    }
    if (area > 0.)
      simplex->layer_thickness = layer_volume / area;
  }
}
} // namespace signorini
