// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/adaptivity/stress_recovery.h"

#include <deal.II/base/quadrature_lib.h>

#include <Eigen/LU>

#include <numeric>

namespace signorini
{
namespace
{
using Index = std::pair<int, int>;

/// The independent components of the stress, two times dim of them.
template <int dim>
Index component(unsigned int i)
{
  static const std::array<Index, 4> in_plane{{{0, 0}, {1, 1}, {2, 2}, {0, 1}}};
  static const std::array<Index, 6> in_space{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};
  return dim == 2 ? in_plane[i] : in_space[i];
}

/// All products of powers below `degree` of the coordinates.
template <int dim>
Eigen::VectorXd monomials(const dealii::Point<dim> &x, unsigned int degree)
{
  unsigned int n = 1;
  for (int d = 0; d < dim; ++d)
    n *= degree;
  Eigen::VectorXd values(n);
  for (unsigned int i = 0; i < n; ++i)
  {
    values[i] = 1.;
    unsigned int rest = i;
    for (int d = 0; d < dim; ++d, rest /= degree)
      values[i] *= std::pow(x[d], rest % degree);
  }
  return values;
}
} // namespace

template <int dim>
StressRecovery<dim>::StressRecovery(const Discretization<dim> &the_discretization)
    : discretization(&the_discretization)
{
  recovered = {{discretization->make_vector(), discretization->make_vector()}};
  fit_cells();
  tabulate_shape_functions();
}

template <int dim>
void StressRecovery<dim>::fit_cells()
{
  const unsigned int degree = discretization->element.degree;
  const dealii::QGauss<dim> points(degree + 1);
  const std::vector<dealii::Point<dim>> &nodes =
      discretization->element.base_element(0).get_unit_support_points();
  const unsigned int n_terms = monomials(nodes[0], degree).size();
  Eigen::MatrixXd at_points(points.size(), n_terms), at_nodes(nodes.size(), n_terms);
  Eigen::VectorXd weights(points.size());
  for (unsigned int q = 0; q < points.size(); ++q)
  {
    at_points.row(q) = monomials(points.point(q), degree);
    weights[q] = points.weight(q);
  }
  for (unsigned int a = 0; a < nodes.size(); ++a)
    at_nodes.row(a) = monomials(nodes[a], degree);
  const Eigen::MatrixXd moments = at_points.transpose() * weights.asDiagonal();
  fit = at_nodes * (moments * at_points).inverse() * moments;
}

template <int dim>
void StressRecovery<dim>::tabulate_shape_functions()
{
  const auto &element = discretization->element.base_element(0);
  const dealii::QGauss<dim> points(element.degree + 1);
  shape_values.resize(element.n_dofs_per_cell(), points.size());
  for (unsigned int a = 0; a < element.n_dofs_per_cell(); ++a)
    for (unsigned int q = 0; q < points.size(); ++q)
      shape_values(a, q) = element.shape_value(a, points.point(q));
}

template <int dim>
void StressRecovery<dim>::recover(const std::vector<Eigen::Matrix3d> &point_stresses)
{
  const CellTable<dim> &cells = discretization->cells;
  Vector volumes = discretization->make_vector();
  for (Vector &values : recovered)
  {
    values.zero_out_ghost_values(); // else they would not take contributions
    values = 0.;
  }
  for (unsigned int cell = 0; cell < cells.n_cells; ++cell)
  {
    const double *weights = cells.cell_weights(cell);
    const double volume = std::accumulate(weights, weights + cells.n_points, 0.);
    const unsigned int *dofs = cells.cell_dofs(cell);
    for (unsigned int a = 0; a < cells.n_nodes; ++a)
    {
      Eigen::Matrix3d stress = Eigen::Matrix3d::Zero();
      for (unsigned int q = 0; q < cells.n_points; ++q)
        stress += fit(a, q) * point_stresses[cell * cells.n_points + q];
      for (unsigned int d = 0; d < dim; ++d)
      {
        volumes.local_element(dofs[a * dim + d]) += volume;
        for (unsigned int half = 0; half < 2; ++half)
        {
          const auto [i, j] = component<dim>(half * dim + d);
          recovered[half].local_element(dofs[a * dim + d]) += volume * stress(i, j);
        }
      }
    }
  }
  volumes.compress(dealii::VectorOperation::add);
  for (Vector &values : recovered)
  {
    values.compress(dealii::VectorOperation::add);
    for (unsigned int i = 0; i < values.locally_owned_size(); ++i)
      if (volumes.local_element(i) > 0.)
        values.local_element(i) /= volumes.local_element(i);
    discretization->distribute(values);
  }
}

template <int dim>
std::vector<Eigen::Matrix3d> StressRecovery<dim>::nodal_stresses(unsigned int cell) const
{
  const CellTable<dim> &cells = discretization->cells;
  const unsigned int *dofs = cells.cell_dofs(cell);
  std::vector<Eigen::Matrix3d> stresses(cells.n_nodes, Eigen::Matrix3d::Zero());
  for (unsigned int a = 0; a < cells.n_nodes; ++a)
    for (unsigned int d = 0; d < dim; ++d)
      for (unsigned int half = 0; half < 2; ++half)
      {
        const auto [i, j] = component<dim>(half * dim + d);
        stresses[a](i, j) = stresses[a](j, i) = recovered[half].local_element(dofs[a * dim + d]);
      }
  return stresses;
}

template <int dim>
Eigen::Matrix3d StressRecovery<dim>::interpolate(const std::vector<Eigen::Matrix3d> &nodal,
                                                 unsigned int point) const
{
  Eigen::Matrix3d stress = Eigen::Matrix3d::Zero();
  for (unsigned int a = 0; a < nodal.size(); ++a)
    stress += shape_values(a, point) * nodal[a];
  return stress;
}

template class StressRecovery<2>;
template class StressRecovery<3>;
} // namespace signorini
