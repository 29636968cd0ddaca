// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/physics/batched_force.h"

#include "signorini/physics/batch_order.h"
#include "signorini/physics/material.h"

#include <algorithm>

namespace signorini
{
namespace
{
bool has_kernels(MaterialParameters::Model model)
{
  return model == MaterialParameters::Model::linear_elastic ||
         model == MaterialParameters::Model::neo_hookean;
}
} // namespace

template <int dim>
BatchedForce<dim>::BatchedForce(const std::vector<MaterialParameters> &materials,
                                const Discretization<dim> &the_discretization,
                                const VectorKernels<dim> &the_kernels)
    : discretization(&the_discretization), kernels(&the_kernels), bodies(materials.size())
{
  for (unsigned int body = 0; body < materials.size(); ++body)
    bodies[body] = discretization->degree == 1 && has_kernels(materials[body].model);
  const CellTable<dim> &cells = discretization->cells;
  for (unsigned int cell = 0; cell < cells.n_cells; ++cell)
    if (has_body(cells.bodies[cell]))
      group_of(materials[cells.bodies[cell]], cells.n_nodes(cell) == dim + 1).cells.push_back(cell);
  if (groups.empty())
    return;
  const auto &partitioner = *discretization->node_positions.get_partitioner();
  n_nodes = (partitioner.locally_owned_size() + partitioner.n_ghost_indices()) / dim;
  for (Group &group : groups)
    fill(group);
  nodal_displacement.resize((n_nodes + 1) * n_of_row, 0.);
  nodal_force.resize((n_nodes + 1) * n_of_row, 0.);
}

template <int dim>
typename BatchedForce<dim>::Group &BatchedForce<dim>::group_of(const MaterialParameters &material,
                                                               bool is_simplex)
{
  const double E = material.youngs_modulus, nu = material.poissons_ratio;
  const double shear_modulus = E / (2. * (1. + nu)), bulk_modulus = E / (3. * (1. - 2. * nu));
  const auto known = std::find_if(groups.begin(), groups.end(),
                                  [&](const Group &group)
                                  {
                                    return group.model == material.model && group.is_simplex == is_simplex &&
                                           group.shear_modulus == shear_modulus &&
                                           group.bulk_modulus == bulk_modulus;
                                  });
  if (known != groups.end())
    return *known;
  groups.push_back({material.model, is_simplex, shear_modulus, bulk_modulus, {}, {}, {}});
  return groups.back();
}

template <int dim>
void BatchedForce<dim>::fill(Group &group) const
{
  const CellTable<dim> &table = discretization->cells;
  const unsigned int n_cell_nodes = table.n_nodes(group.cells[0]), n_points = table.n_points(group.cells[0]);
  const std::size_t n_lanes = kernels->n_lanes, n_batches = (group.cells.size() + n_lanes - 1) / n_lanes;
  std::vector<unsigned int> cell_nodes;
  cell_nodes.reserve(group.cells.size() * n_cell_nodes);
  for (const unsigned int cell : group.cells)
    for (unsigned int a = 0; a < n_cell_nodes; ++a)
    {
      // deal.II numbers the components of a node one after the other, and whole nodes are owned.
      const unsigned int *dofs = table.cell_dofs(cell) + a * dim;
      Assert(dofs[0] % dim == 0 && dofs[dim - 1] == dofs[0] + dim - 1, dealii::ExcInternalError());
      cell_nodes.push_back(dofs[0] / dim);
    }
  const std::vector<unsigned int> order = make_batch_order(cell_nodes, n_cell_nodes, kernels->n_lanes);

  group.geometry.resize_fast(n_batches * n_points * (dim * dim + 1) * n_lanes);
  group.nodes.assign(n_batches * n_cell_nodes * n_lanes, n_nodes);
  const std::vector<unsigned int> unordered = group.cells;
  for (std::size_t place = 0; place < n_batches * n_lanes; ++place)
  {
    const unsigned int index = order[std::min(place, order.size() - 1)]; // lanes to spare repeat the last
    set_geometry(group, place, unordered[index]);
    if (place >= order.size())
      continue;
    group.cells[place] = unordered[index];
    for (unsigned int a = 0; a < n_cell_nodes; ++a)
      group.nodes[(place / n_lanes * n_cell_nodes + a) * n_lanes + place % n_lanes] =
          cell_nodes[index * n_cell_nodes + a];
  }
}

template <int dim>
void BatchedForce<dim>::set_geometry(Group &group, std::size_t place, unsigned int cell) const
{
  const CellTable<dim> &table = discretization->cells;
  const unsigned int n_points = table.n_points(cell);
  const std::size_t n_lanes = kernels->n_lanes;
  for (unsigned int q = 0; q < n_points; ++q)
  {
    double *point =
        &group.geometry[(place / n_lanes * n_points + q) * (dim * dim + 1) * n_lanes] + place % n_lanes;
    for (unsigned int i = 0; i < dim * dim; ++i)
      point[i * n_lanes] = table.cell_inverse_jacobians(cell)[q * dim * dim + i];
    point[dim * dim * n_lanes] = table.cell_weights(cell)[q];
  }
}

template <int dim>
CellBatches BatchedForce<dim>::batches_of(const Group &group) const
{
  const std::size_t n_lanes = kernels->n_lanes;
  return {(group.cells.size() + n_lanes - 1) / n_lanes, group.geometry.data(), group.nodes.data(),
          group.shear_modulus, group.bulk_modulus};
}

template <int dim>
const typename VectorKernels<dim>::OfShape &BatchedForce<dim>::kernels_of(const Group &group) const
{
  return group.is_simplex ? kernels->simplex : kernels->hypercube;
}

template <int dim>
const typename VectorKernels<dim>::OfShape::OfLaw &BatchedForce<dim>::law_kernels_of(const Group &group) const
{
  const auto &of_shape = kernels_of(group);
  return group.model == MaterialParameters::Model::linear_elastic ? of_shape.linear_elastic
                                                                  : of_shape.neo_hookean;
}

template <int dim>
void BatchedForce<dim>::set_nodal_displacement(const Vector &displacement) const
{
  const double *values = displacement.begin();
  double *rows = nodal_displacement.data();
  for (unsigned int node = 0; node < n_nodes; ++node)
    for (unsigned int d = 0; d < dim; ++d)
      rows[node * n_of_row + d] = values[node * dim + d];
}

template <int dim>
void BatchedForce<dim>::add_force(const Vector &displacement, Vector &force) const
{
  if (groups.empty())
    return;
  set_nodal_displacement(displacement);
  for (const Group &group : groups)
    law_kernels_of(group).add_force(batches_of(group), nodal_displacement.data(), nodal_force.data());
  double *values = force.begin(), *rows = nodal_force.data();
  for (unsigned int node = 0; node < n_nodes; ++node)
    for (unsigned int d = 0; d < dim; ++d)
    {
      values[node * dim + d] += rows[node * n_of_row + d];
      rows[node * n_of_row + d] = 0.;
    }
}

template <int dim>
double BatchedForce<dim>::energy(const Vector &displacement) const
{
  if (groups.empty())
    return 0.;
  set_nodal_displacement(displacement);
  constexpr std::size_t n_parts = VectorKernels<dim>::n_energy_parts;
  const std::size_t n_lanes = kernels->n_lanes;
  dealii::AlignedVector<double> parts;
  double sum = 0.;
  for (const Group &group : groups)
  {
    const CellBatches batches = batches_of(group);
    parts.resize_fast(batches.n_batches * n_parts * n_lanes);
    law_kernels_of(group).compute_energy_parts(batches, nodal_displacement.data(), parts.data());
    const LinearElastic<dim> linear{group.shear_modulus, group.bulk_modulus};
    const NeoHookean<dim> neo_hookean{group.shear_modulus, group.bulk_modulus};
    const bool is_linear = group.model == MaterialParameters::Model::linear_elastic;
    for (std::size_t place = 0; place < group.cells.size(); ++place)
    {
      const double *cell = &parts[place / n_lanes * n_parts * n_lanes + place % n_lanes];
      const double strain = cell[n_lanes], volume = cell[2 * n_lanes];
      sum +=
          cell[0] + volume * (is_linear ? linear.volume(strain).energy : neo_hookean.volume(strain).energy);
    }
  }
  return sum;
}

template <int dim>
void BatchedForce<dim>::compute_stretches(const Vector &displacement, std::vector<Stretch> &stretches) const
{
  if (groups.empty())
    return;
  set_nodal_displacement(displacement);
  constexpr std::size_t n_entries = std::tuple_size_v<Stretch>;
  const std::size_t n_lanes = kernels->n_lanes;
  dealii::AlignedVector<double> of_batches;
  for (const Group &group : groups)
  {
    const CellBatches batches = batches_of(group);
    of_batches.resize_fast(batches.n_batches * n_entries * n_lanes);
    kernels_of(group).compute_stretches(batches, nodal_displacement.data(), of_batches.data());
    for (std::size_t place = 0; place < group.cells.size(); ++place)
      for (std::size_t i = 0; i < n_entries; ++i)
        stretches[group.cells[place]][i] =
            of_batches[(place / n_lanes * n_entries + i) * n_lanes + place % n_lanes];
  }
}

template class BatchedForce<2>;
template class BatchedForce<3>;
} // namespace signorini
