// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/solvers/bulk_bound.h"

#include "signorini/solvers/largest_eigenvalue.h"

#include <deal.II/base/mpi.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace signorini
{
namespace
{
/// Squared Frobenius norm of the difference of two symmetric tensors.
template <std::size_t n>
double distance_squared(const std::array<double, n> &one, const std::array<double, n> &other)
{
  constexpr std::size_t dim = n == 3 ? 2 : 3;
  double sum = 0.;
  for (std::size_t i = 0; i < n; ++i)
    sum += (i < dim ? 1. : 2.) * (one[i] - other[i]) * (one[i] - other[i]);
  return sum;
}
} // namespace

template <int dim>
BulkBound<dim>::BulkBound(const InternalForce<dim> &the_elasticity,
                          const std::vector<std::shared_ptr<ViscousForce<dim>>> &the_viscosities,
                          const std::vector<MaterialParameters> &the_materials,
                          const Discretization<dim> &the_discretization)
    : elasticity(&the_elasticity), viscosities(&the_viscosities), materials(&the_materials),
      discretization(&the_discretization)
{
}

template <int dim>
double BulkBound<dim>::largest_eigenvalue(unsigned int cell, const std::vector<double> &matrix) const
{
  const CellTable<dim> &cells = discretization->cells;
  const unsigned int n = cells.n_cell_dofs(cell);
  Eigen::VectorXd root_mass(n);
  for (unsigned int i = 0; i < n; ++i)
    root_mass[i] =
        std::sqrt((*materials)[cells.bodies[cell]].density * cells.cell_nodal_measures(cell)[i / dim]);
  Eigen::MatrixXd scaled = Eigen::Map<const Eigen::MatrixXd>(matrix.data(), n, n);
  scaled = root_mass.cwiseInverse().asDiagonal() * scaled * root_mass.cwiseInverse().asDiagonal();
  return find_largest_eigenvalue(scaled);
}

template <int dim>
void BulkBound<dim>::update_cells(const std::vector<unsigned int> &cells, const State &state)
{
  elasticity->for_each_tangent(cells, [&](unsigned int cell, const std::vector<double> &tangent)
                               { frequencies_squared[cell] = largest_eigenvalue(cell, tangent); });
  for (const auto &viscosity : *viscosities)
    viscosity->for_each_damping(cells, state,
                                [&](unsigned int cell, const std::vector<double> &damping)
                                { damping_rates[cell] = largest_eigenvalue(cell, damping); });
  const auto largest_of_all = [&](const std::vector<double> &values)
  {
    const auto largest = std::max_element(values.begin(), values.end());
    return dealii::Utilities::MPI::max(largest == values.end() ? 0. : *largest,
                                       discretization->communicator());
  };
  largest_frequency_squared = largest_of_all(frequencies_squared);
  if (!viscosities->empty())
    largest_damping_rate = largest_of_all(damping_rates);
}

template <int dim>
void BulkBound<dim>::update(const State &state)
{
  std::vector<unsigned int> all(discretization->cells.n_cells);
  std::iota(all.begin(), all.end(), 0u);
  frequencies_squared.assign(all.size(), 0.);
  damping_rates.assign(viscosities->empty() ? 0 : all.size(), 0.);
  if (elasticity->is_nonlinear())
    stretches = elasticity->stretches();
  update_cells(all, state);
}

template <int dim>
void BulkBound<dim>::update_strained(const State &state)
{
  constexpr double largest_change = 0.02;
  if (!elasticity->is_nonlinear())
    return;
  const std::vector<Stretch> now = elasticity->stretches();
  std::vector<unsigned int> strained;
  for (unsigned int cell = 0; cell < now.size(); ++cell)
    if (distance_squared(now[cell], stretches[cell]) > largest_change * largest_change)
    {
      stretches[cell] = now[cell];
      strained.push_back(cell);
    }
  if (dealii::Utilities::MPI::logical_or(!strained.empty(), discretization->communicator()))
    update_cells(strained, state);
}

template class BulkBound<2>;
template class BulkBound<3>;
} // namespace signorini
