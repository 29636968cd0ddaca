// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/base/spatial_vector.h"
#include "signorini/discretization/discretization.h"

#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <array>
#include <vector>

namespace signorini
{
/// Vector fields on the tetrahedra of a discretization, for evaluation at any undeformed point of their
/// bodies. Every rank holds all of it. It stays what it is when the mesh changes.
///
/// Cells are found by their boxes and barycentric coordinates in the straight-edged cell; a point outside of
/// all of them, as on a curved boundary, belongs to the cell that it is outside of least.
template <int dim>
class SimplexField
{
public:
  /// Takes the nodal values of `fields` (collective).
  SimplexField(const Discretization<dim> &discretization, const std::vector<const Vector *> &fields);

  /// The fields' values at a point of a body, [field].
  std::vector<SpatialVector<dim>> evaluate(unsigned int body, const dealii::Point<dim> &x) const;

private:
  using BoostPoint = boost::geometry::model::point<double, dim, boost::geometry::cs::cartesian>;
  using Box = boost::geometry::model::box<BoostPoint>;
  using Tree = boost::geometry::index::rtree<std::pair<Box, unsigned int>, boost::geometry::index::rstar<16>>;
  using Barycentric = Eigen::Matrix<double, dim + 1, 1>;

  /// Barycentric coordinates of x are `offset` + `slopes` x.
  struct Cell
  {
    Eigen::Matrix<double, dim + 1, dim> slopes;
    Barycentric offset;
    std::size_t first_value;
  };

  void add_cells_of_rank(const std::vector<double> &packed,
                         std::vector<std::vector<std::pair<Box, unsigned int>>> &boxes);
  Barycentric coordinates(unsigned int cell, const SpatialVector<dim> &x) const;
  unsigned int find_cell(unsigned int body, const SpatialVector<dim> &x) const;

  unsigned int n_fields, n_nodes;
  unsigned int degree;
  std::vector<Cell> cells;
  std::vector<SpatialVector<dim>> values; ///< [cell][field][node]
  std::vector<Tree> trees;                ///< one a body
};
} // namespace signorini
