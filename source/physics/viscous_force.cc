// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/physics/viscous_force.h"

#include "signorini/base/spatial_vector.h"
#include "signorini/physics/cell_kernel.h"

namespace signorini
{
template <int dim>
ViscousForce<dim>::ViscousForce(const std::vector<MaterialParameters> &materials,
                                const Discretization<dim> &the_discretization)
    : discretization(&the_discretization)
{
  for (const MaterialParameters &material : materials)
    laws.push_back({material.viscosity, material.model != MaterialParameters::Model::linear_elastic});
}

template <int dim>
void ViscousForce<dim>::add_cell_force(unsigned int cell, const double *displacement, const double *velocity,
                                       double *force) const
{
  const CellTable<dim> &cells = discretization->cells;
  const Law &law = laws[cells.bodies[cell]];
  const CellGeometry geometry = geometry_of(cells, cell);
  for (unsigned int q = 0; q < geometry.n_points; ++q)
  {
    SpatialTensor<dim> F = SpatialTensor<dim>::Identity();
    if (law.has_finite_strain)
      F += displacement_gradient<dim>(geometry, q, displacement);
    const SpatialTensor<dim> product = F.transpose() * displacement_gradient<dim>(geometry, q, velocity);
    const SpatialTensor<dim> rate = 0.5 * (product + product.transpose()),
                             deviator = rate - rate.trace() / 3. * SpatialTensor<dim>::Identity();
    const Eigen::Matrix<double, dim, dim, Eigen::RowMajor> stress =
        2. * law.viscosity * geometry.weights[q] * F * deviator;
    add_point_force<dim>(geometry, q, stress.data(), force);
  }
}

template <int dim>
void ViscousForce<dim>::add_force(const State &state, const Vector &velocity, Vector &force) const
{
  const CellTable<dim> &cells = discretization->cells;
  std::vector<double> u, v, cell_force;
  for (unsigned int cell = 0; cell < cells.n_cells; ++cell)
  {
    if (!is_viscous(cell))
      continue;
    const unsigned int n = cells.n_cell_dofs(cell), *dofs = cells.cell_dofs(cell);
    u.resize(n);
    v.resize(n);
    for (unsigned int i = 0; i < n; ++i)
    {
      u[i] = state.displacement.local_element(dofs[i]);
      v[i] = velocity.local_element(dofs[i]);
    }
    cell_force.assign(n, 0.);
    add_cell_force(cell, u.data(), v.data(), cell_force.data());
    for (unsigned int i = 0; i < n; ++i)
      force.local_element(dofs[i]) += cell_force[i];
  }
}

template <int dim>
void ViscousForce<dim>::for_each_damping(
    const std::vector<unsigned int> &cells, const State &state,
    const std::function<void(unsigned int, const std::vector<double> &)> &visit) const
{
  const CellTable<dim> &table = discretization->cells;
  std::vector<double> u, v, damping;
  for (const unsigned int cell : cells)
  {
    if (!is_viscous(cell))
      continue;
    const unsigned int n = table.n_cell_dofs(cell), *dofs = table.cell_dofs(cell);
    u.resize(n);
    for (unsigned int i = 0; i < n; ++i)
      u[i] = state.displacement.local_element(dofs[i]);
    // The force is linear in the velocity by a symmetric matrix: its rows are forces at unit velocities.
    damping.assign(n * n, 0.);
    for (unsigned int i = 0; i < n; ++i)
    {
      v.assign(n, 0.);
      v[i] = -1.;
      add_cell_force(cell, u.data(), v.data(), &damping[i * n]);
    }
    visit(cell, damping);
  }
}

template class ViscousForce<2>;
template class ViscousForce<3>;
} // namespace signorini
