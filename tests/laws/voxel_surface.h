// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "box_surface.h"

#include <functional>

namespace signorini::test
{
/// A point of a lattice of unit cells.
template <int dim>
SpatialVector<dim> lattice_point(const std::array<unsigned int, dim> &lattice)
{
  SpatialVector<dim> x;
  for (unsigned int d = 0; d < dim; ++d)
    x[d] = lattice[d];
  return x;
}

/// A body of cells out of a lattice of n × n (× n), in a shape of its own.
template <int dim>
struct VoxelBody
{
  using Lattice = std::array<unsigned int, dim>;

  Lattice n_cells{};
  FacetType type = FacetType::tensor_product; ///< in 3-D a side of a cell may be two triangles
  std::function<bool(const Lattice &)> is_filled;
  /// Where a point of the lattice lies in the undeformed body; cells must not be turned inside out.
  std::function<SpatialVector<dim>(const Lattice &)> place = lattice_point<dim>;
};

/// The faces between cells that are filled and others; of degree 1.
template <int dim>
class VoxelSurface
{
public:
  using Lattice = typename VoxelBody<dim>::Lattice;

  explicit VoxelSurface(const VoxelBody<dim> &voxel_body) : body(voxel_body)
  {
    surface.n_bodies = 1;
    Lattice cell{};
    do
      if (body.is_filled(cell))
        for (unsigned int axis = 0; axis < dim; ++axis)
          for (unsigned int side = 0; side < 2; ++side)
            if (is_outer(cell, axis, side))
              for (unsigned int half = 0; half < (body.type == FacetType::triangle ? 2 : 1); ++half)
                add_facet(cell, axis, side, half);
    while (advance(cell));
  }

  /// The surface where a function of the lattice puts its nodes.
  Positions<dim> positions(const std::function<SpatialVector<dim>(const Lattice &)> &place) const
  {
    Positions<dim> x(surface.n_nodes());
    for (const auto &[lattice, node] : nodes)
      x[node] = place(lattice);
    return x;
  }

  ContactSurface<dim> surface;
  /// Of the facets, in the lattice.
  std::vector<SpatialVector<dim>> normals, centres;

private:
  bool advance(Lattice &cell) const
  {
    for (unsigned int d = 0; d < dim; ++d)
    {
      if (++cell[d] < body.n_cells[d])
        return true;
      cell[d] = 0;
    }
    return false;
  }

  bool is_outer(Lattice cell, unsigned int axis, unsigned int side) const
  {
    if (side == 0 && cell[axis] == 0)
      return true;
    cell[axis] += 2 * side - 1;
    return cell[axis] == body.n_cells[axis] || !body.is_filled(cell);
  }

  void add_facet(const Lattice &cell, unsigned int axis, unsigned int side, unsigned int half)
  {
    Facet<dim> facet;
    facet.type = body.type;
    Lattice behind = cell;
    ++behind[axis];
    facet.layer_thickness = (body.place(behind) - body.place(cell)).norm();
    facet.room = facet.layer_thickness;
    facet.youngs_modulus = 1e3;
    facet.density = 10.;
    const bool reversed = dim == 2 ? (axis == 0) != (side == 1) : side == 0;
    for (unsigned int a = 0; a < facet.n_nodes(); ++a)
    {
      const LocalPoint<dim> xi = contact::node_coordinates(facet, a);
      std::array<unsigned int, 2> steps{};
      for (unsigned int d = 0; d < dim - 1; ++d)
        steps[d] = static_cast<unsigned int>(std::lround(half == 0 ? xi[d] : 1. - xi[d]));
      if (reversed)
      {
        if (dim == 2)
          steps[0] = 1 - steps[0];
        else
          std::swap(steps[0], steps[1]);
      }
      Lattice lattice = cell;
      lattice[axis] += side;
      for (unsigned int d = 1; d < dim; ++d)
        lattice[(axis + d) % dim] += steps[d - 1];
      const auto [entry, is_new] = nodes.emplace(lattice, surface.n_nodes());
      if (is_new)
        surface.reference_positions.push_back(body.place(lattice));
      facet.nodes[a] = entry->second;
    }
    surface.facets.push_back(facet);
    normals.push_back((side == 0 ? -1. : 1.) * SpatialVector<dim>::Unit(axis));
    centres.emplace_back();
    for (unsigned int d = 0; d < dim; ++d)
      centres.back()[d] = cell[d] + (d == axis ? side : .5);
  }

  VoxelBody<dim> body;
  std::map<Lattice, unsigned int> nodes;
};

/// A C that opens along x: two arms of one cell, one cell apart, on a back of one cell, `length` cells long.
template <int dim>
VoxelBody<dim> make_c(unsigned int length)
{
  VoxelBody<dim> c;
  c.n_cells.fill(3);
  c.n_cells[0] = length;
  c.is_filled = [](const auto &cell) { return cell[0] == 0 || cell[dim - 1] != 1; };
  return c;
}

/// A wall of one cell across its last direction.
template <int dim>
VoxelBody<dim> make_wall(unsigned int length)
{
  VoxelBody<dim> wall;
  wall.n_cells.fill(length);
  wall.n_cells[dim - 1] = 1;
  wall.is_filled = [](const auto &) { return true; };
  return wall;
}
} // namespace signorini::test
