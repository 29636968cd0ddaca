// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/adaptivity/stress_recovery.h"

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

/// All products of powers of the coordinates: each below `degree`, for simplices also their sum.
template <int dim>
Eigen::VectorXd monomials(const dealii::Point<dim> &x, unsigned int degree, bool is_simplex)
{
  unsigned int n = 1;
  for (int d = 0; d < dim; ++d)
    n *= degree;
  std::vector<double> values;
  for (unsigned int i = 0; i < n; ++i)
  {
    double value = 1.;
    unsigned int rest = i, sum = 0;
    for (int d = 0; d < dim; ++d, rest /= degree)
    {
      value *= std::pow(x[d], rest % degree);
      sum += rest % degree;
    }
    if (!is_simplex || sum < degree)
      values.push_back(value);
  }
  return Eigen::Map<const Eigen::VectorXd>(values.data(), values.size());
}
} // namespace

template <int dim>
StressRecovery<dim>::StressRecovery(const Discretization<dim> &the_discretization)
    : discretization(&the_discretization)
{
  recovered = {{discretization->make_vector(), discretization->make_vector()}};
  for (const MeshPart<dim> *part : discretization->parts)
    fits.push_back(fit_cells(*part));
}

template <int dim>
typename StressRecovery<dim>::CellFit StressRecovery<dim>::fit_cells(const MeshPart<dim> &part)
{
  const dealii::FiniteElement<dim> &element = part.element.base_element(0);
  const bool is_simplex = part.element.reference_cell().is_simplex();
  const dealii::Quadrature<dim> points = part.cell_rule();
  const std::vector<dealii::Point<dim>> &nodes = element.get_unit_support_points();
  const auto n_terms = monomials(nodes[0], element.degree, is_simplex).size();
  Eigen::MatrixXd at_points(points.size(), n_terms), at_nodes(nodes.size(), n_terms);
  Eigen::VectorXd weights(points.size());
  for (unsigned int q = 0; q < points.size(); ++q)
  {
    at_points.row(q) = monomials(points.point(q), element.degree, is_simplex);
    weights[q] = points.weight(q);
  }
  for (unsigned int a = 0; a < nodes.size(); ++a)
    at_nodes.row(a) = monomials(nodes[a], element.degree, is_simplex);
  const Eigen::MatrixXd moments = at_points.transpose() * weights.asDiagonal();
  const Eigen::MatrixXd coefficients = (moments * at_points).inverse() * moments;
  CellFit fit{part.first_cell, at_nodes * coefficients, {}, {}, {}};
  sample_cells(part, coefficients, fit);
  return fit;
}

/// The square of the difference is of twice the element's degree. On hexahedra the quadrature points
/// integrate that; those of simplices do not, but determine the stress, which is the fitted polynomial there.
template <int dim>
void StressRecovery<dim>::sample_cells(const MeshPart<dim> &part, const Eigen::MatrixXd &coefficients,
                                       CellFit &fit)
{
  const dealii::FiniteElement<dim> &element = part.element.base_element(0);
  const bool is_simplex = part.element.reference_cell().is_simplex();
  const dealii::Quadrature<dim> samples = is_simplex ? part.gauss_rule(element.degree + 1) : part.cell_rule();
  const unsigned int n_points = fit.fit.cols();
  fit.shape_values.resize(samples.size(), element.n_dofs_per_cell());
  fit.point_values.setIdentity(samples.size(), n_points);
  fit.volume_shares.setIdentity(samples.size(), n_points);
  const std::vector<double> &weights = samples.get_weights();
  const double volume = std::accumulate(weights.begin(), weights.end(), 0.);
  for (unsigned int s = 0; s < samples.size(); ++s)
  {
    for (unsigned int a = 0; a < element.n_dofs_per_cell(); ++a)
      fit.shape_values(s, a) = element.shape_value(a, samples.point(s));
    if (!is_simplex)
      continue;
    fit.point_values.row(s) =
        monomials(samples.point(s), element.degree, is_simplex).transpose() * coefficients;
    fit.volume_shares.row(s).setConstant(weights[s] / volume);
  }
}

template <int dim>
const typename StressRecovery<dim>::CellFit &StressRecovery<dim>::fit_of(unsigned int cell) const
{
  return fits.size() > 1 && cell >= fits[1].first_cell ? fits[1] : fits[0];
}

template <int dim>
void StressRecovery<dim>::recover(const InternalForce<dim> &elasticity)
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
    const unsigned int n_points = cells.n_points(cell);
    const double volume = std::accumulate(weights, weights + n_points, 0.);
    const unsigned int *dofs = cells.cell_dofs(cell);
    const Eigen::MatrixXd &fit = fit_of(cell).fit;
    const std::vector<Eigen::Matrix3d> point_stresses = elasticity.point_stresses(cell);
    for (unsigned int a = 0; a < cells.n_nodes(cell); ++a)
    {
      Eigen::Matrix3d stress = Eigen::Matrix3d::Zero();
      for (unsigned int q = 0; q < n_points; ++q)
        stress += fit(a, q) * point_stresses[q];
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
  std::vector<Eigen::Matrix3d> stresses(cells.n_nodes(cell), Eigen::Matrix3d::Zero());
  for (unsigned int a = 0; a < stresses.size(); ++a)
    for (unsigned int d = 0; d < dim; ++d)
      for (unsigned int half = 0; half < 2; ++half)
      {
        const auto [i, j] = component<dim>(half * dim + d);
        stresses[a](i, j) = stresses[a](j, i) = recovered[half].local_element(dofs[a * dim + d]);
      }
  return stresses;
}

template <int dim>
std::vector<typename StressRecovery<dim>::Sample>
StressRecovery<dim>::differences(unsigned int cell, const std::vector<Eigen::Matrix3d> &nodal,
                                 const std::vector<Eigen::Matrix3d> &point_stresses) const
{
  const CellFit &fit = fit_of(cell);
  const double *volumes = discretization->cells.cell_weights(cell);
  std::vector<Sample> samples(fit.shape_values.rows(), {Eigen::Matrix3d::Zero(), 0.});
  for (unsigned int s = 0; s < samples.size(); ++s)
  {
    for (unsigned int a = 0; a < nodal.size(); ++a)
      samples[s].stress += fit.shape_values(s, a) * nodal[a];
    for (unsigned int q = 0; q < fit.point_values.cols(); ++q)
    {
      samples[s].stress -= fit.point_values(s, q) * point_stresses[q];
      samples[s].volume += fit.volume_shares(s, q) * volumes[q];
    }
  }
  return samples;
}

template class StressRecovery<2>;
template class StressRecovery<3>;
} // namespace signorini
