// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/physics/vector_kernels.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace signorini
{
/// A cube cut into cells that are not of one form, larger than the caches, and a small random displacement.
class BlockOfCells
{
public:
  enum class Shape
  {
    simplices, ///< six tetrahedra to a cube
    hypercubes
  };

  BlockOfCells(Shape shape, unsigned int n_lanes);

  CellBatches batches() const;
  const double *displacement() const { return nodal_displacement.data()->values; }
  double *force() const { return nodal_force.data()->values; }
  double n_cells() const;

  /// What an evaluation of forces moves between memory and processor at least: geometry and nodes of the
  /// cells, and once each node's displacement and, read and written, force.
  double bytes_per_cell() const;

private:
  struct alignas(64) Line
  {
    double values[8];
  };

  unsigned int n_cubes_along_edge() const { return shape == Shape::simplices ? 48 : 64; }
  void place_nodes();
  std::vector<unsigned int> list_nodes() const; ///< [cell][node]
  void set_cell(std::size_t index, const unsigned int *of_cell, unsigned int n_nodes);
  void set_point(const Eigen::Matrix3d &jacobian, double weight, double *of_point) const;

  Shape shape;
  unsigned int n_lanes;
  std::vector<Eigen::Vector3d> positions;
  std::vector<Line> geometry, nodal_displacement;
  mutable std::vector<Line> nodal_force;
  std::vector<unsigned int> nodes;
};
} // namespace signorini
