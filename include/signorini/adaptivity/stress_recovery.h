// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/discretization/discretization.h"
#include "signorini/physics/internal_force.h"

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

  /// From the stresses at the own cells' quadrature points (collective).
  void recover(const InternalForce<dim> &elasticity);

  /// Recovered stresses at the nodes of an own cell, [node] [Pa].
  std::vector<Eigen::Matrix3d> nodal_stresses(unsigned int cell) const;

  /// A stress of a cell and the volume that it stands for [Pa, m³].
  struct Sample
  {
    Eigen::Matrix3d stress;
    double volume;
  };

  /// The interpolation of nodal values less the stress of the element, given at its quadrature points, in an
  /// own cell: samples that integrate its square.
  std::vector<Sample> differences(unsigned int cell, const std::vector<Eigen::Matrix3d> &nodal,
                                  const std::vector<Eigen::Matrix3d> &point_stresses) const;

private:
  /// What all cells of one kind have in common.
  struct CellFit
  {
    unsigned int first_cell;
    Eigen::MatrixXd fit;           ///< [node][point]: values at the nodes of the fitted polynomial
    Eigen::MatrixXd shape_values;  ///< [sample][node]
    Eigen::MatrixXd point_values;  ///< [sample][point]: values at the samples of the element's own stress
    Eigen::MatrixXd volume_shares; ///< [sample][point]: of the volume of a point
  };

  static CellFit fit_cells(const MeshPart<dim> &part);
  static void sample_cells(const MeshPart<dim> &part, const Eigen::MatrixXd &coefficients, CellFit &fit);
  const CellFit &fit_of(unsigned int cell) const;

  const Discretization<dim> *discretization;
  std::vector<CellFit> fits;       ///< one a part of the mesh
  std::array<Vector, 2> recovered; ///< the stress's independent components, dim each a node [Pa]
};
} // namespace signorini
