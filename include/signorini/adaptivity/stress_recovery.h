// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/discretization/discretization.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace signorini
{
/// A continuous stress from that of the elements, which jumps from cell to cell: in every cell a polynomial
/// of one degree less than the displacement is fitted to the stress at the quadrature points, where it is
/// most accurate; its values at the nodes are averaged over the cells there, weighted with their volumes, and
/// interpolated like the displacement (O. C. Zienkiewicz, J. Z. Zhu, 1987).
template <int dim>
class StressRecovery
{
public:
  /// `discretization` must outlive this object.
  explicit StressRecovery(const Discretization<dim> &discretization);

  /// From stresses at the own cells' quadrature points, [cell][point] [Pa] (collective).
  void recover(const std::vector<Eigen::Matrix3d> &point_stresses);

  /// Recovered stresses at the nodes of an own cell, [node] [Pa].
  std::vector<Eigen::Matrix3d> nodal_stresses(unsigned int cell) const;

  /// The interpolation of nodal values at a quadrature point of an own cell.
  Eigen::Matrix3d interpolate(unsigned int cell, const std::vector<Eigen::Matrix3d> &nodal,
                              unsigned int point) const;

private:
  /// What all cells of one kind have in common.
  struct CellFit
  {
    unsigned int first_cell;
    Eigen::MatrixXd fit;          ///< [node][point]: values at the nodes of the fitted polynomial
    Eigen::MatrixXd shape_values; ///< [node][point]
  };

  static CellFit fit_cells(const MeshPart<dim> &part);
  const CellFit &fit_of(unsigned int cell) const;

  const Discretization<dim> *discretization;
  std::vector<CellFit> fits;       ///< one a part of the mesh
  std::array<Vector, 2> recovered; ///< the stress's independent components, dim each a node [Pa]
};
} // namespace signorini
