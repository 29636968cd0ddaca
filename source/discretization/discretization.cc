// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/discretization/discretization.h"

#include "signorini/base/collective_error.h"
#include "signorini/base/exceptions.h"
#include "signorini/base/to_eigen.h"
#include "signorini/discretization/scene_mesh.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/distributed/solution_transfer.h>
#include <deal.II/dofs/dof_renumbering.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>

namespace signorini
{
template <int dim>
Discretization<dim>::Discretization(const Parameters &parameters, const MPI_Comm &communicator)
    : mesh(make_scene_mesh<dim>(parameters.bodies, communicator)),
      element(dealii::FE_Q<dim>(parameters.degree), dim), mapping(parameters.degree), dof_handler(*mesh),
      mpi_communicator(communicator)
{
  set_up();
}

template <int dim>
void Discretization<dim>::set_up()
{
  number_dofs();
  close_mapping();
  fill_cell_table();
  throw_together(mpi_communicator, [this]() { check_cells(); });
  collect_owned_nodes();
}

template <int dim>
void Discretization<dim>::adapt(const std::vector<Vector *> &values)
{
  mesh->prepare_coarsening_and_refinement();
  change_mesh(values, [this]() { mesh->execute_coarsening_and_refinement(); });
}

template <int dim>
double Discretization<dim>::imbalance(const std::vector<unsigned int> &weights) const
{
  const double own = std::accumulate(weights.begin(), weights.end(), 0.);
  const dealii::Utilities::MPI::MinMaxAvg loads = dealii::Utilities::MPI::min_max_avg(own, mpi_communicator);
  return loads.max / loads.avg;
}

template <int dim>
bool Discretization<dim>::balance(const std::vector<unsigned int> &weights,
                                  const std::vector<Vector *> &values)
{
  constexpr double tolerated_imbalance = 1.1;
  if (imbalance(weights) <= tolerated_imbalance)
    return false;
  std::vector<unsigned int> weight_of_cell(mesh->n_active_cells(), 0);
  unsigned int own_cell = 0;
  for (const auto &cell : mesh->active_cell_iterators())
    if (cell->is_locally_owned())
      weight_of_cell[cell->active_cell_index()] = weights[own_cell++];
  const boost::signals2::scoped_connection connection = mesh->signals.weight.connect(
      [&](const auto &cell, const auto &) { return weight_of_cell[cell->active_cell_index()]; });
  change_mesh(values, [this]() { mesh->repartition(); });
  return true;
}

template <int dim>
void Discretization<dim>::change_mesh(const std::vector<Vector *> &values,
                                      const std::function<void()> &change)
{
  std::vector<Vector> old_values;
  for (const Vector *vector : values)
    old_values.push_back(*vector);
  // Copies have no ghost values, nor has what std::vector moves to another place.
  std::vector<const Vector *> old_pointers;
  for (Vector &vector : old_values)
  {
    vector.update_ghost_values();
    old_pointers.push_back(&vector);
  }
  dealii::parallel::distributed::SolutionTransfer<dim, Vector> transfer(dof_handler);
  transfer.prepare_for_coarsening_and_refinement(old_pointers);
  change();

  hanging_dofs.clear();
  cells = CellTable<dim>();
  owned_nodes.clear();
  unused_dofs.clear();
  set_up();
  for (Vector *vector : values)
    *vector = make_vector();
  std::vector<Vector *> new_values = values;
  transfer.interpolate(new_values);
  for (Vector *vector : values)
    distribute(*vector);
}

template <int dim>
void Discretization<dim>::number_dofs()
{
  dof_handler.distribute_dofs(element);
  owned_dofs = dof_handler.locally_owned_dofs();
  dealii::DoFTools::extract_locally_relevant_dofs(dof_handler, relevant_dofs);

  hanging_constraints.reinit(relevant_dofs);
  dealii::DoFTools::make_hanging_node_constraints(dof_handler, hanging_constraints);
  hanging_constraints.close();

  dealii::IndexSet with_masters = relevant_dofs;
  for (const auto &line : hanging_constraints.get_lines())
    for (const auto &entry : line.entries)
      with_masters.add_index(entry.first);
  relevant_dofs = with_masters;
  partitioner =
      std::make_shared<dealii::Utilities::MPI::Partitioner>(owned_dofs, relevant_dofs, mpi_communicator);

  for (const auto &line : hanging_constraints.get_lines())
  {
    HangingDof hanging{partitioner->global_to_local(line.index), {}};
    for (const auto &entry : line.entries)
      hanging.masters.emplace_back(partitioner->global_to_local(entry.first), entry.second);
    hanging_dofs.push_back(std::move(hanging));
  }
}

template <int dim>
void Discretization<dim>::close_mapping()
{
  // The mesh puts every node of a curved boundary onto the curve. A hanging one has to stay between its
  // masters instead, as its displacement does: else the surface gapes and turning a body would strain it.
  const dealii::MappingQ<dim> on_the_curve(element.degree);
  std::map<dealii::types::global_dof_index, dealii::Point<dim>> points;
  dealii::DoFTools::map_dofs_to_support_points(on_the_curve, dof_handler, points);
  Vector positions = make_vector();
  std::vector<dealii::types::global_dof_index> cell_dofs(element.n_dofs_per_cell());
  for (const auto &cell : dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      cell->get_dof_indices(cell_dofs);
      for (unsigned int i = 0; i < cell_dofs.size(); ++i)
        if (owned_dofs.is_element(cell_dofs[i]))
          positions(cell_dofs[i]) = points.at(cell_dofs[i])[element.system_to_component_index(i).first];
    }
  distribute(positions);
  mapping.initialize(on_the_curve, dof_handler, positions, false);
}

template <int dim>
void Discretization<dim>::fill_cell_table()
{
  const dealii::QGauss<dim> quadrature(element.degree + 1);
  const dealii::QGaussLobatto<dim> nodal_quadrature(element.degree + 1);
  dealii::FEValues<dim> values(mapping, element, quadrature,
                               dealii::update_gradients | dealii::update_JxW_values);
  dealii::FEValues<dim> nodal_values(mapping, element, nodal_quadrature,
                                     dealii::update_values | dealii::update_JxW_values);
  const unsigned int n_dofs = element.n_dofs_per_cell();
  cells.n_nodes = n_dofs / dim;
  cells.n_points = quadrature.size();

  std::vector<dealii::types::global_dof_index> cell_dofs(n_dofs);
  for (const auto &cell : dof_handler.active_cell_iterators())
  {
    if (!cell->is_locally_owned())
      continue;
    const unsigned int first_dof = cells.dofs.size(), first_gradient = cells.gradients.size(),
                       first_node = cells.nodal_measures.size();
    cells.dofs.resize(first_dof + n_dofs);
    cells.gradients.resize(first_gradient + cells.n_points * cells.n_nodes * dim);
    cells.nodal_measures.resize(first_node + cells.n_nodes, 0.);
    values.reinit(cell);
    nodal_values.reinit(cell);
    cell->get_dof_indices(cell_dofs);
    for (unsigned int i = 0; i < n_dofs; ++i)
    {
      const auto [component, node] = element.system_to_component_index(i);
      cells.dofs[first_dof + node * dim + component] = partitioner->global_to_local(cell_dofs[i]);
      if (component > 0)
        continue;
      for (unsigned int q = 0; q < cells.n_points; ++q)
        for (unsigned int d = 0; d < dim; ++d)
          cells.gradients[first_gradient + (q * cells.n_nodes + node) * dim + d] = values.shape_grad(i, q)[d];
      for (unsigned int q = 0; q < nodal_quadrature.size(); ++q)
        cells.nodal_measures[first_node + node] += nodal_values.shape_value(i, q) * nodal_values.JxW(q);
    }
    for (unsigned int q = 0; q < cells.n_points; ++q)
      cells.weights.push_back(values.JxW(q));
    // In distorted hexahedra the nodal rule misses the volume: scaled, bodies weigh what they should.
    const double volume = std::accumulate(cells.weights.end() - cells.n_points, cells.weights.end(), 0.);
    const auto measures = cells.nodal_measures.begin() + first_node;
    const double nodal_volume = std::accumulate(measures, cells.nodal_measures.end(), 0.);
    std::transform(measures, cells.nodal_measures.end(), measures,
                   [&](double measure) { return measure * volume / nodal_volume; });
    cells.bodies.push_back(cell->material_id());
    ++cells.n_cells;
  }
}

template <int dim>
void Discretization<dim>::check_cells() const
{
  const auto is_positive = [](double value) { return value > 0.; };
  unsigned int own_cell = 0;
  for (const auto &cell : dof_handler.active_cell_iterators())
  {
    if (!cell->is_locally_owned())
      continue;
    const double *weights = cells.cell_weights(own_cell),
                 *measures = &cells.nodal_measures[own_cell * cells.n_nodes];
    ++own_cell;
    if (std::all_of(weights, weights + cells.n_points, is_positive) &&
        std::all_of(measures, measures + cells.n_nodes, is_positive))
      continue;
    const dealii::Point<dim> centre = cell->center();
    throw InputError(Complaint("the mesh has a cell that is partly inside out")
                         .at(fmt::format("({:.6g})", fmt::join(to_eigen<dim>(centre), ", ")))
                         .found(fmt::format("a cell {:.3g} m across of body number {}", cell->diameter(),
                                            cell->material_id() + 1))
                         .advise("refine that body, or give it another shape"));
  }
}

template <int dim>
void Discretization<dim>::collect_owned_nodes()
{
  std::map<dealii::types::global_dof_index, dealii::Point<dim>> positions;
  dealii::DoFTools::map_dofs_to_support_points(mapping, dof_handler, positions);
  std::vector<bool> is_known(partitioner->locally_owned_size(), false);
  for (unsigned int cell = 0; cell < cells.n_cells; ++cell)
    for (unsigned int node = 0; node < cells.n_nodes; ++node)
    {
      const unsigned int *dofs = cells.cell_dofs(cell) + node * dim;
      if (dofs[0] >= is_known.size() || is_known[dofs[0]])
        continue;
      is_known[dofs[0]] = true;
      OwnedNode<dim> owned{{}, positions.at(partitioner->local_to_global(dofs[0])), cells.bodies[cell]};
      std::copy(dofs, dofs + dim, owned.dofs.begin());
      owned_nodes.push_back(owned);
    }
  std::vector<bool> is_used(partitioner->locally_owned_size(), false);
  for (const unsigned int dof : cells.dofs)
    if (dof < is_used.size())
      is_used[dof] = true;
  for (unsigned int dof = 0; dof < is_used.size(); ++dof)
    if (!is_used[dof])
      unused_dofs.push_back(partitioner->local_to_global(dof));
}

template <int dim>
dealii::types::global_dof_index Discretization<dim>::n_dofs() const
{
  return dof_handler.n_dofs() -
         dealii::Utilities::MPI::sum(static_cast<dealii::types::global_dof_index>(unused_dofs.size()),
                                     mpi_communicator);
}

template <int dim>
Vector Discretization<dim>::make_vector() const
{
  return Vector(partitioner);
}

template <int dim>
void Discretization<dim>::distribute(Vector &values) const
{
  values.update_ghost_values();
  if (dealii::Utilities::MPI::max(hanging_dofs.size(), mpi_communicator) == 0)
    return;
  for (const HangingDof &hanging : hanging_dofs)
  {
    double value = 0.;
    for (const auto &[master, weight] : hanging.masters)
      value += weight * values.local_element(master);
    values.local_element(hanging.dof) = value;
  }
  values.update_ghost_values();
}

template <int dim>
void Discretization<dim>::collect(Vector &forces) const
{
  for (const HangingDof &hanging : hanging_dofs)
  {
    for (const auto &[master, weight] : hanging.masters)
      forces.local_element(master) += weight * forces.local_element(hanging.dof);
    forces.local_element(hanging.dof) = 0.;
  }
  forces.compress(dealii::VectorOperation::add);
}

template class Discretization<2>;
template class Discretization<3>;
} // namespace signorini
