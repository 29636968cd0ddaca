// SPDX-License-Identifier: LGPL-2.1-or-later
#include "block_of_cells.h"

#include "signorini/physics/batch_order.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <random>

namespace signorini
{
namespace
{
constexpr unsigned int n_entries = 10; ///< of a point

/// ∂N/∂ξ of a hexahedron's node at Gauss point q of 2×2×2; both numbered x fastest.
Eigen::Vector3d reference_gradient(unsigned int node, unsigned int q)
{
  const std::array<double, 2> points{{0.5 - 0.5 / std::sqrt(3.), 0.5 + 0.5 / std::sqrt(3.)}};
  Eigen::Vector3d gradient;
  for (unsigned int d = 0; d < 3; ++d)
  {
    gradient[d] = 1.;
    for (unsigned int e = 0; e < 3; ++e)
    {
      const bool is_upper = node >> e & 1;
      const double x = points[q >> e & 1];
      gradient[d] *= e == d ? (is_upper ? 1. : -1.) : (is_upper ? x : 1. - x);
    }
  }
  return gradient;
}
} // namespace

BlockOfCells::BlockOfCells(Shape the_shape, unsigned int number_of_lanes)
    : shape(the_shape), n_lanes(number_of_lanes)
{
  place_nodes();
  const std::vector<unsigned int> cell_nodes = list_nodes();
  const unsigned int n_nodes = shape == Shape::simplices ? 4 : 8;
  const std::vector<unsigned int> order = make_batch_order(cell_nodes, n_nodes, n_lanes);
  geometry.resize(order.size() * (shape == Shape::simplices ? 1 : 8) * n_entries / 8);
  nodes.resize(cell_nodes.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    set_cell(i, &cell_nodes[order[i] * n_nodes], n_nodes);
}

std::vector<unsigned int> BlockOfCells::list_nodes() const
{
  const unsigned int n = n_cubes_along_edge();
  constexpr unsigned int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  std::vector<unsigned int> all;
  for (unsigned int k = 0; k < n; ++k)
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int i = 0; i < n; ++i)
      {
        std::array<unsigned int, 8> corners;
        for (unsigned int c = 0; c < 8; ++c)
          corners[c] = ((k + (c >> 2)) * (n + 1) + j + (c >> 1 & 1)) * (n + 1) + i + (c & 1);
        if (shape == Shape::hypercubes)
          all.insert(all.end(), corners.begin(), corners.end());
        else
          for (const auto &order : orders) // from corner 0 to corner 7 along three edges
            for (const unsigned int c : {0u, 1u << order[0], 1u << order[0] | 1u << order[1], 7u})
              all.push_back(corners[c]);
      }
  return all;
}

void BlockOfCells::place_nodes()
{
  const unsigned int n = n_cubes_along_edge();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> within(-0.1 / n, 0.1 / n);
  for (unsigned int k = 0; k <= n; ++k)
    for (unsigned int j = 0; j <= n; ++j)
      for (unsigned int i = 0; i <= n; ++i)
        positions.emplace_back(double(i) / n + within(random), double(j) / n + within(random),
                               double(k) / n + within(random));
  nodal_displacement.resize((positions.size() + 1) / 2);
  nodal_force.resize(nodal_displacement.size());
  for (Line &line : nodal_displacement)
    for (double &value : line.values)
      value = 0.01 * within(random);
}

void BlockOfCells::set_point(const Eigen::Matrix3d &jacobian, double weight, double *of_point) const
{
  const Eigen::Matrix3d inverse = jacobian.inverse();
  for (int d = 0; d < 3; ++d)
    for (int j = 0; j < 3; ++j)
      of_point[(3 * d + j) * n_lanes] = inverse(d, j);
  of_point[9 * n_lanes] = weight * jacobian.determinant();
}

void BlockOfCells::set_cell(std::size_t index, const unsigned int *of_cell, unsigned int n_nodes)
{
  const std::size_t batch = index / n_lanes, lane = index % n_lanes, n_points = n_nodes == 8 ? 8 : 1;
  for (std::size_t a = 0; a < n_nodes; ++a)
    nodes[(batch * n_nodes + a) * n_lanes + lane] = of_cell[a];
  for (unsigned int q = 0; q < n_points; ++q)
  {
    Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();
    if (n_points == 8)
      for (unsigned int a = 0; a < 8; ++a)
        jacobian += positions[of_cell[a]] * reference_gradient(a, q).transpose();
    else
      for (unsigned int d = 0; d < 3; ++d)
        jacobian.col(d) = positions[of_cell[d + 1]] - positions[of_cell[0]];
    set_point(jacobian, n_points == 8 ? 1. / 8. : 1. / 6.,
              geometry.data()->values + (batch * n_points + q) * n_entries * n_lanes + lane);
  }
}

CellBatches BlockOfCells::batches() const
{
  return {static_cast<std::size_t>(n_cells()) / n_lanes, geometry.data()->values, nodes.data(), 0.4, 0.7};
}

double BlockOfCells::n_cells() const
{
  return static_cast<double>(nodes.size() / (shape == Shape::simplices ? 4 : 8));
}

double BlockOfCells::bytes_per_cell() const
{
  const double of_node = sizeof(double) * 4. * 3.;
  return (sizeof(Line) * geometry.size() + sizeof(unsigned int) * nodes.size() + of_node * positions.size()) /
         n_cells();
}
} // namespace signorini
