// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/physics/internal_force.h"

#include <deal.II/base/mpi.h>

#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <type_traits>

namespace signorini
{
template <int dim>
InternalForce<dim>::InternalForce(const std::vector<MaterialParameters> &materials,
                                  const Discretization<dim> &the_discretization)
    : ForceTerm("elasticity", Kind::elastic, false), discretization(&the_discretization),
      batched(materials, the_discretization)
{
  for (const MaterialParameters &material : materials)
  {
    const double E = material.youngs_modulus, nu = material.poissons_ratio;
    const double shear_modulus = E / (2. * (1. + nu)), bulk_modulus = E / (3. * (1. - 2. * nu));
    const unsigned int degree = discretization->degree;
    moduli.push_back(bulk_modulus + 4. / 3. * shear_modulus);
    if (material.model == MaterialParameters::Model::linear_elastic)
      kernels.emplace_back(CellKernel<dim, LinearElastic<dim>>({shear_modulus, bulk_modulus}, degree));
    else if (material.model == MaterialParameters::Model::neo_hookean)
      kernels.emplace_back(CellKernel<dim, NeoHookean<dim>>({shear_modulus, bulk_modulus}, degree));
    else
      kernels.emplace_back(PlasticKernel(
          {shear_modulus, bulk_modulus, material.yield_stress, material.hardening_modulus}, degree));
  }
  if (std::any_of(kernels.begin(), kernels.end(),
                  [](const Kernel &kernel) { return std::holds_alternative<PlasticKernel>(kernel); }))
    make_plastic_states();
  for (unsigned int cell = 0; cell < discretization->cells.n_cells; ++cell)
    if (!batched.has_body(discretization->cells.bodies[cell]))
      single_cells.push_back(cell);
}

template <int dim>
void InternalForce<dim>::make_plastic_states()
{
  const CellTable<dim> &cells = discretization->cells;
  first_plastic_states.push_back(0);
  for (unsigned int cell = 0; cell < cells.n_cells; ++cell)
    first_plastic_states.push_back(
        first_plastic_states.back() +
        (std::holds_alternative<PlasticKernel>(kernels[cells.bodies[cell]]) ? cells.n_points(cell) : 0));
  plastic_states.resize(first_plastic_states.back());
}

template <int dim>
void InternalForce<dim>::update(const State &state)
{
  displacement = &state.displacement;
  if (step_start == nullptr)
    return;
  middle = state.displacement;
  middle += *step_start;
  middle *= 0.5;
  middle.update_ghost_values();
  displacement = &middle;
}

template <int dim>
template <typename Action>
void InternalForce<dim>::for_each_cell(const Action &action) const
{
  std::vector<double> u;
  for (unsigned int cell = 0; cell < discretization->cells.n_cells; ++cell)
    with_cell(cell, u, action);
}

template <int dim>
template <typename Action>
void InternalForce<dim>::with_cell(unsigned int cell, std::vector<double> &u, const Action &action) const
{
  const CellTable<dim> &cells = discretization->cells;
  const unsigned int *dofs = cells.cell_dofs(cell);
  u.resize(cells.n_cell_dofs(cell));
  for (unsigned int i = 0; i < u.size(); ++i)
    u[i] = displacement->local_element(dofs[i]);
  CellGeometry geometry = geometry_of(cells, cell);
  std::visit(
      [&](auto &kernel)
      {
        if constexpr (std::is_same_v<decltype(kernel), PlasticKernel &>)
          geometry.states = &plastic_states[first_plastic_states[cell]];
        action(kernel, cell, geometry, u.data());
      },
      kernels[cells.bodies[cell]]);
}

template <int dim>
double InternalForce<dim>::energy() const
{
  double sum = batched.energy(*displacement);
  std::vector<double> u;
  for (const unsigned int cell : single_cells)
    with_cell(cell, u,
              [&](auto &kernel, unsigned int, const CellGeometry &geometry, const double *values)
              { sum += kernel.energy(geometry, values); });
  return (step_start != nullptr ? 2. : 1.) * dealii::Utilities::MPI::sum(sum, discretization->communicator());
}

template <int dim>
void InternalForce<dim>::add_force(Vector &force) const
{
  batched.add_force(*displacement, force);
  const CellTable<dim> &cells = discretization->cells;
  std::vector<double> u, cell_force;
  for (const unsigned int cell : single_cells)
    with_cell(cell, u,
              [&](auto &kernel, unsigned int, const CellGeometry &geometry, const double *values)
              {
                cell_force.assign(cells.n_cell_dofs(cell), 0.);
                kernel.add_force(geometry, values, cell_force.data());
                const unsigned int *dofs = cells.cell_dofs(cell);
                for (unsigned int i = 0; i < cell_force.size(); ++i)
                  force.local_element(dofs[i]) += cell_force[i];
              });
}

template <int dim>
void InternalForce<dim>::for_each_tangent(
    const std::vector<unsigned int> &cells,
    const std::function<void(unsigned int, const std::vector<double> &)> &visit) const
{
  std::vector<double> u, tangent;
  for (const unsigned int cell : cells)
    with_cell(cell, u,
              [&](auto &kernel, unsigned int, const CellGeometry &geometry, const double *values)
              {
                const unsigned int n = discretization->cells.n_cell_dofs(cell);
                tangent.resize(n * n);
                kernel.compute_tangent(geometry, values, tangent.data());
                visit(cell, tangent);
              });
}

template <int dim>
void InternalForce<dim>::add_tangent(TangentSystem &system) const
{
  const CellTable<dim> &cells = discretization->cells;
  const auto &partitioner = *displacement->get_partitioner();
  dealii::FullMatrix<double> matrix;
  dealii::Vector<double> zero;
  std::vector<dealii::types::global_dof_index> dofs;
  std::vector<unsigned int> all_cells(cells.n_cells);
  std::iota(all_cells.begin(), all_cells.end(), 0u);
  for_each_tangent(all_cells,
                   [&](unsigned int cell, const std::vector<double> &tangent)
                   {
                     const unsigned int n = cells.n_cell_dofs(cell);
                     matrix.reinit(n, n);
                     zero.reinit(n);
                     dofs.resize(n);
                     matrix.fill(tangent.data());
                     if (step_start != nullptr)
                       matrix *= 0.5;
                     for (unsigned int i = 0; i < n; ++i)
                       dofs[i] = partitioner.local_to_global(cells.cell_dofs(cell)[i]);
                     system.constraints->distribute_local_to_global(matrix, zero, dofs, system.matrix,
                                                                    system.right_hand_side);
                   });
}

template <int dim>
void InternalForce<dim>::add_magnitudes(Vector &magnitudes) const
{
  const CellTable<dim> &cells = discretization->cells;
  const double *reference_gradients = nullptr; // that `reference_slopes` are of
  std::vector<double> reference_slopes, lengths, of_node;
  for_each_cell(
      [&](auto &, unsigned int cell, const CellGeometry &geometry, const double *u)
      {
        using Gradient = Eigen::Map<const SpatialVector<dim>>;
        using Jacobian = Eigen::Map<const Eigen::Matrix<double, dim, dim>>;
        const unsigned int n_nodes = geometry.n_nodes, *dofs = cells.cell_dofs(cell);
        if (std::exchange(reference_gradients, geometry.reference_gradients) != geometry.reference_gradients)
        {
          reference_slopes.clear();
          for (unsigned int i = 0; i < geometry.n_points * n_nodes; ++i)
            reference_slopes.push_back(Gradient(reference_gradients + i * dim).norm());
        }
        lengths.clear();
        for (unsigned int a = 0; a < n_nodes; ++a)
          lengths.push_back(Gradient(u + a * dim).norm());
        of_node.assign(n_nodes, 0.);
        for (unsigned int q = 0; q < geometry.n_points; ++q)
        {
          const double *slopes = &reference_slopes[q * n_nodes];
          const double squared = Jacobian(geometry.inverse_jacobians + q * dim * dim).squaredNorm() / dim;
          const double strain = std::inner_product(slopes, slopes + n_nodes, lengths.begin(), 0.);
          const double force = geometry.weights[q] * moduli[cells.bodies[cell]] * squared * strain;
          for (unsigned int a = 0; a < n_nodes; ++a)
            of_node[a] += force * slopes[a];
        }
        for (unsigned int i = 0; i < cells.n_cell_dofs(cell); ++i)
          magnitudes.local_element(dofs[i]) += of_node[i / dim];
      });
}

template <int dim>
std::vector<Eigen::Matrix3d> InternalForce<dim>::point_stresses(unsigned int cell) const
{
  std::vector<Eigen::Matrix3d> at_points(discretization->cells.n_points(cell));
  std::vector<double> u;
  with_cell(cell, u,
            [&](auto &kernel, unsigned int, const CellGeometry &geometry, const double *values)
            { kernel.compute_stresses(geometry, values, at_points.data()); });
  return at_points;
}

template <int dim>
bool InternalForce<dim>::is_nonlinear() const
{
  return std::any_of(kernels.begin(), kernels.end(),
                     [](const Kernel &kernel)
                     { return !std::holds_alternative<CellKernel<dim, LinearElastic<dim>>>(kernel); });
}

template <int dim>
bool InternalForce<dim>::has_plasticity() const
{
  return !first_plastic_states.empty();
}

template <int dim>
double InternalForce<dim>::commit()
{
  if (!has_plasticity())
    return 0.;
  double work = 0.;
  for_each_cell(
      [&](auto &kernel, unsigned int cell, const CellGeometry &geometry, const double *u)
      {
        if constexpr (std::is_same_v<decltype(kernel), PlasticKernel &>)
          for (unsigned int q = 0; q < geometry.n_points; ++q)
          {
            const PlasticStep step =
                kernel.law_at(geometry, q).yield(displacement_gradient<dim>(geometry, q, u));
            plastic_states[first_plastic_states[cell] + q] = step.state;
            work += geometry.weights[q] * step.work;
          }
      });
  return dealii::Utilities::MPI::sum(work, discretization->communicator());
}

template <int dim>
PointValues InternalForce<dim>::memory() const
{
  PointValues memory;
  if (!has_plasticity())
    return memory;
  const CellTable<dim> &cells = discretization->cells;
  memory.n_components = n_remembered;
  memory.values.resize(n_remembered * cells.n_points(), 0.);
  for_each_cell(
      [&](auto &kernel, unsigned int cell, const CellGeometry &geometry, const double *u)
      {
        if constexpr (std::is_same_v<decltype(kernel), PlasticKernel &>)
          for (unsigned int q = 0; q < geometry.n_points; ++q)
          {
            const auto of_point =
                kernel.law_at(geometry, q).memory(displacement_gradient<dim>(geometry, q, u));
            std::copy(of_point.begin(), of_point.end(),
                      &memory.values[n_remembered * (cells.first_point(cell) + q)]);
          }
      });
  return memory;
}

template <int dim>
void InternalForce<dim>::remember(const PointValues &memory)
{
  if (!has_plasticity())
    return;
  const CellTable<dim> &cells = discretization->cells;
  for_each_cell(
      [&](auto &kernel, unsigned int cell, const CellGeometry &geometry, const double *u)
      {
        if constexpr (std::is_same_v<decltype(kernel), PlasticKernel &>)
          for (unsigned int q = 0; q < geometry.n_points; ++q)
          {
            typename J2Plastic<dim>::Memory of_point;
            std::copy_n(&memory.values[n_remembered * (cells.first_point(cell) + q)], n_remembered,
                        of_point.begin());
            plastic_states[first_plastic_states[cell] + q] =
                J2Plastic<dim>::recall(displacement_gradient<dim>(geometry, q, u), of_point);
          }
      });
}

template <int dim>
std::vector<double> InternalForce<dim>::plastic_strains() const
{
  const CellTable<dim> &cells = discretization->cells;
  std::vector<double> means(cells.n_cells, 0.);
  if (!has_plasticity())
    return means;
  for (unsigned int cell = 0; cell < cells.n_cells; ++cell)
  {
    const CellGeometry geometry = geometry_of(cells, cell);
    const std::size_t first = first_plastic_states[cell], end = first_plastic_states[cell + 1];
    for (std::size_t i = first; i < end; ++i)
      means[cell] += geometry.weights[i - first] * plastic_states[i].equivalent_strain;
    means[cell] /= std::accumulate(geometry.weights, geometry.weights + geometry.n_points, 0.);
  }
  return means;
}

template <int dim>
std::vector<double> InternalForce<dim>::turns_taken_for_strain() const
{
  std::vector<double> largest(kernels.size(), 0.);
  for_each_cell(
      [&](auto &kernel, unsigned int cell, const CellGeometry &geometry, const double *u)
      {
        if constexpr (std::is_same_v<decltype(kernel), CellKernel<dim, LinearElastic<dim>> &>)
        {
          SpatialTensor<dim> gradient = SpatialTensor<dim>::Zero(); // of the deformation, times the volume
          for (unsigned int q = 0; q < geometry.n_points; ++q)
            gradient += geometry.weights[q] *
                        (SpatialTensor<dim>::Identity() + displacement_gradient<dim>(geometry, q, u));
          const Eigen::JacobiSVD<SpatialTensor<dim>> parts(gradient,
                                                           Eigen::ComputeFullU | Eigen::ComputeFullV);
          const double cosine = .5 * ((parts.matrixU() * parts.matrixV().transpose()).trace() - (dim - 2));
          double &of_body = largest[discretization->cells.bodies[cell]];
          of_body = std::max(of_body, std::acos(std::clamp(cosine, -1., 1.)));
        }
      });
  return largest;
}

template <int dim>
std::vector<typename BatchedForce<dim>::Stretch> InternalForce<dim>::stretches() const
{
  std::vector<typename BatchedForce<dim>::Stretch> all(discretization->cells.n_cells);
  batched.compute_stretches(*displacement, all);
  std::vector<double> u;
  for (const unsigned int cell : single_cells)
    with_cell(cell, u,
              [&](auto &kernel, unsigned int, const CellGeometry &geometry, const double *values)
              {
                const SpatialTensor<dim> stretch = kernel.mean_stretch(geometry, values);
                unsigned int entry = dim;
                for (unsigned int i = 0; i < dim; ++i)
                {
                  all[cell][i] = stretch(i, i);
                  for (unsigned int j = i + 1; j < dim; ++j)
                    all[cell][entry++] = stretch(i, j);
                }
              });
  return all;
}

template <int dim>
std::vector<Eigen::Matrix3d> InternalForce<dim>::stresses() const
{
  const CellTable<dim> &cells = discretization->cells;
  std::vector<Eigen::Matrix3d> means(cells.n_cells, Eigen::Matrix3d::Zero());
  for (unsigned int cell = 0; cell < cells.n_cells; ++cell)
  {
    const std::vector<Eigen::Matrix3d> at_points = point_stresses(cell);
    const double *weights = cells.cell_weights(cell);
    const unsigned int n_points = cells.n_points(cell);
    for (unsigned int q = 0; q < n_points; ++q)
      means[cell] += weights[q] * at_points[q];
    means[cell] /= std::accumulate(weights, weights + n_points, 0.);
  }
  return means;
}

template class InternalForce<2>;
template class InternalForce<3>;
} // namespace signorini
