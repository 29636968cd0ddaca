// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/discretization/discretization.h"

#include "signorini/base/collective_error.h"
#include "signorini/base/exceptions.h"
#include "signorini/base/to_eigen.h"
#include "signorini/discretization/scene_mesh.h"
#include "signorini/discretization/simplex_field.h"

#include <deal.II/distributed/solution_transfer.h>
#include <deal.II/fe/fe_values.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>

namespace signorini
{
namespace
{
template <int dim>
std::unique_ptr<HexahedralPart<dim>> make_hexahedra(const Parameters &parameters,
                                                    const MPI_Comm &communicator)
{
  auto mesh = make_scene_mesh<dim>(parameters.bodies, communicator);
  return mesh ? std::make_unique<HexahedralPart<dim>>(std::move(mesh), parameters.degree) : nullptr;
}

template <int dim>
std::unique_ptr<TetrahedralPart<dim>> make_tetrahedra(const Parameters &parameters,
                                                      const MPI_Comm &communicator)
{
  const auto meshes = place_simplex_meshes<dim>(parameters.bodies, parameters.degree, communicator);
  return meshes.empty() ? nullptr
                        : std::make_unique<TetrahedralPart<dim>>(meshes, parameters.degree, communicator);
}
} // namespace

template <int dim>
Discretization<dim>::Discretization(const Parameters &parameters, const MPI_Comm &communicator)
    : degree(parameters.degree), hexahedra(make_hexahedra<dim>(parameters, communicator)),
      tetrahedra(make_tetrahedra<dim>(parameters, communicator)), mpi_communicator(communicator)
{
  if (hexahedra)
    parts.push_back(hexahedra.get());
  if (tetrahedra)
    parts.push_back(tetrahedra.get());
  set_up();
}

template <int dim>
void Discretization<dim>::set_up()
{
  number_dofs();
  place_nodes();
  fill_cell_table();
  throw_together(mpi_communicator, [this]() { check_cells(); });
  collect_owned_nodes();
}

template <int dim>
void Discretization<dim>::adapt(const std::vector<Vector *> &values, PointValues &point_values)
{
  hexahedra->mesh.prepare_coarsening_and_refinement();
  change_mesh(values, point_values, [this]() { hexahedra->mesh.execute_coarsening_and_refinement(); });
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
                                  const std::vector<Vector *> &values, PointValues &point_values)
{
  constexpr double tolerated_imbalance = 1.1;
  const unsigned int n_hexahedra = tetrahedra ? tetrahedra->first_cell : cells.n_cells;
  if (!hexahedra || imbalance({weights.begin(), weights.begin() + n_hexahedra}) <= tolerated_imbalance)
    return false;
  auto &mesh = hexahedra->mesh;
  std::vector<unsigned int> weight_of_cell(mesh.n_active_cells(), 0);
  unsigned int own_cell = 0;
  for (const auto &cell : hexahedra->own_cells())
    weight_of_cell[cell->active_cell_index()] = weights[own_cell++];
  const boost::signals2::scoped_connection connection = mesh.signals.weight.connect(
      [&](const auto &cell, const auto &) { return weight_of_cell[cell->active_cell_index()]; });
  change_mesh(values, point_values, [&mesh]() { mesh.repartition(); });
  return true;
}

template <int dim>
void Discretization<dim>::change_mesh(const std::vector<Vector *> &values, PointValues &point_values,
                                      const std::function<void()> &change)
{
  if (point_values.n_components == 0)
    return change_mesh(values, change);
  // Tetrahedra stay as they are, behind the hexahedra.
  std::vector<double> &numbers = point_values.values;
  const auto end_of_hexahedra =
      numbers.begin() +
      static_cast<std::ptrdiff_t>(cells.first_point(tetrahedra ? tetrahedra->first_cell : cells.n_cells) *
                                  point_values.n_components);
  const std::vector<double> on_tetrahedra(end_of_hexahedra, numbers.end());
  numbers.erase(end_of_hexahedra, numbers.end());
  PointTransfer<dim> transfer(*hexahedra, point_values.n_components, numbers);
  change_mesh(values, change);
  numbers = transfer.interpolate();
  numbers.insert(numbers.end(), on_tetrahedra.begin(), on_tetrahedra.end());
}

template <int dim>
void Discretization<dim>::change_mesh(const std::vector<Vector *> &values,
                                      const std::function<void()> &change)
{
  const std::vector<Vector> on_tetrahedra = tetrahedra ? extract(*tetrahedra, values) : std::vector<Vector>();
  std::vector<Vector> on_hexahedra = extract(*hexahedra, values);
  std::vector<const Vector *> old_pointers;
  for (const Vector &vector : on_hexahedra)
    old_pointers.push_back(&vector);
  dealii::parallel::distributed::SolutionTransfer<dim, Vector> transfer(hexahedra->dof_handler);
  transfer.prepare_for_coarsening_and_refinement(old_pointers);
  change();
  set_up_anew(values);

  std::vector<Vector> transferred = extract(*hexahedra, values);
  std::vector<Vector *> new_pointers;
  for (Vector &vector : transferred)
    new_pointers.push_back(&vector);
  transfer.interpolate(new_pointers);
  for (unsigned int i = 0; i < values.size(); ++i)
  {
    hexahedra->insert(transferred[i], *values[i]);
    if (tetrahedra)
      tetrahedra->insert(on_tetrahedra[i], *values[i]);
    distribute(*values[i]);
  }
}

template <int dim>
std::vector<Vector> Discretization<dim>::extract(const MeshPart<dim> &part,
                                                 const std::vector<Vector *> &values)
{
  std::vector<Vector> of_part;
  of_part.reserve(values.size()); // a vector that is moved loses its ghost values
  for (const Vector *vector : values)
    of_part.push_back(part.extract(*vector));
  for (Vector &vector : of_part)
    vector.update_ghost_values();
  return of_part;
}

template <int dim>
void Discretization<dim>::set_up_anew(const std::vector<Vector *> &values)
{
  hanging_dofs.clear();
  cells = CellTable<dim>();
  owned_nodes.clear();
  unused_dofs.clear();
  set_up();
  for (Vector *vector : values)
    *vector = make_vector();
}

template <int dim>
void Discretization<dim>::replace_tetrahedra(const std::vector<PlacedSimplexMesh> &meshes,
                                             const std::vector<Vector *> &values)
{
  const SimplexField<dim> on_tetrahedra(*this, {values.begin(), values.end()});
  const std::vector<Vector> on_hexahedra = hexahedra ? extract(*hexahedra, values) : std::vector<Vector>();
  tetrahedra = std::make_unique<TetrahedralPart<dim>>(meshes, degree, mpi_communicator);
  parts.back() = tetrahedra.get();
  set_up_anew(values);
  for (unsigned int i = 0; i < on_hexahedra.size(); ++i)
    hexahedra->insert(on_hexahedra[i], *values[i]);
  std::vector<bool> is_of_tetrahedra(partitioner->locally_owned_size(), false);
  for (unsigned int cell = tetrahedra->first_cell; cell < cells.n_cells; ++cell)
    for (unsigned int i = 0; i < cells.n_cell_dofs(cell); ++i)
      if (cells.cell_dofs(cell)[i] < is_of_tetrahedra.size())
        is_of_tetrahedra[cells.cell_dofs(cell)[i]] = true;
  for (const OwnedNode<dim> &node : owned_nodes)
    if (is_of_tetrahedra[node.dofs[0]])
    {
      const std::vector<SpatialVector<dim>> at_node = on_tetrahedra.evaluate(node.body, node.position);
      for (unsigned int i = 0; i < values.size(); ++i)
        for (unsigned int d = 0; d < dim; ++d)
          values[i]->local_element(node.dofs[d]) = at_node[i][d];
    }
  for (Vector *vector : values)
    distribute(*vector);
}

template <int dim>
void Discretization<dim>::place_nodes()
{
  // The mesh puts every node of a curved boundary onto the curve. A hanging one has to stay between its
  // masters instead, as its displacement does: else the surface gapes and turning a body would strain it.
  node_positions = make_vector();
  std::vector<dealii::types::global_dof_index> dofs;
  for_each_own_cell(
      [&](MeshPart<dim> &part, const auto &cell, unsigned int)
      {
        const std::vector<dealii::Point<dim>> points = part.place_nodes(cell);
        dofs.resize(part.element.n_dofs_per_cell());
        part.get_dof_indices(cell, dofs);
        for (unsigned int i = 0; i < dofs.size(); ++i)
          if (owned_dofs.is_element(dofs[i]))
          {
            const auto [component, node] = part.element.system_to_component_index(i);
            node_positions(dofs[i]) = points[node][component];
          }
      });
  distribute(node_positions);
  for (MeshPart<dim> *part : parts)
    part->place(node_positions);
}

template <int dim>
void Discretization<dim>::fill_cell_table()
{
  for (MeshPart<dim> *part : parts)
  {
    part->first_cell = cells.n_cells;
    add_cells(*part);
  }
}

template <int dim>
void Discretization<dim>::add_cells(MeshPart<dim> &part)
{
  const dealii::Quadrature<dim> rule = part.cell_rule(), lumping_rule = part.lumping_rule();
  dealii::FEValues<dim> values(part.mapping(), part.element, rule,
                               dealii::update_values | dealii::update_inverse_jacobians |
                                   dealii::update_JxW_values);
  dealii::FEValues<dim> lumping(part.mapping(), part.element, lumping_rule,
                                dealii::update_values | dealii::update_JxW_values);
  const unsigned int n_dofs = part.element.n_dofs_per_cell(), n_nodes = n_dofs / dim;
  std::vector<double> reference_gradients;
  for (const dealii::Point<dim> &point : rule.get_points())
    for (unsigned int node = 0; node < n_nodes; ++node)
      for (unsigned int d = 0; d < dim; ++d)
        reference_gradients.push_back(part.element.base_element(0).shape_grad(node, point)[d]);
  cells.begin_kind(n_nodes, rule.size(), std::move(reference_gradients), part.own_cells().size());
  std::vector<dealii::types::global_dof_index> cell_dofs(n_dofs);
  for (const auto &cell : part.own_cells())
  {
    values.reinit(cell);
    lumping.reinit(cell);
    part.get_dof_indices(cell, cell_dofs);
    double volume = 0., lumped_volume = 0.;
    for (unsigned int q = 0; q < rule.size(); ++q)
    {
      cells.weights.push_back(values.JxW(q));
      volume += values.JxW(q);
    }
    for (unsigned int q = 0; q < rule.size(); ++q)
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int j = 0; j < dim; ++j)
          cells.inverse_jacobians.push_back(values.inverse_jacobian(q)[d][j]);
    for (unsigned int node = 0; node < n_nodes; ++node)
    {
      for (unsigned int d = 0; d < dim; ++d)
        cells.dofs.push_back(
            partitioner->global_to_local(cell_dofs[part.element.component_to_system_index(d, node)]));
      const unsigned int i = part.element.component_to_system_index(0, node);
      double share = 0., integral = 0.;
      for (unsigned int q = 0; q < lumping_rule.size(); ++q)
        share += lumping.shape_value(i, q) * lumping.shape_value(i, q) * lumping.JxW(q);
      for (unsigned int q = 0; q < rule.size(); ++q)
        integral += values.shape_value(i, q) * values.JxW(q);
      cells.nodal_measures.push_back(share);
      cells.shape_integrals.push_back(integral);
      lumped_volume += share;
    }
    std::for_each(cells.nodal_measures.end() - n_nodes, cells.nodal_measures.end(),
                  [&](double &measure) { measure *= volume / lumped_volume; });
    cells.bodies.push_back(cell->material_id());
    ++cells.n_cells;
  }
}

template <int dim>
void Discretization<dim>::check_cells() const
{
  const auto is_positive = [](double value) { return value > 0.; };
  for_each_own_cell(
      [&](const MeshPart<dim> &, const auto &cell, unsigned int own_cell)
      {
        const double *weights = cells.cell_weights(own_cell), *measures = cells.cell_nodal_measures(own_cell);
        if (std::all_of(weights, weights + cells.n_points(own_cell), is_positive) &&
            std::all_of(measures, measures + cells.n_nodes(own_cell), is_positive))
          return;
        const dealii::Point<dim> centre = cell->center();
        throw InputError(Complaint("the mesh has a cell that is partly inside out")
                             .at(fmt::format("({:.6g})", fmt::join(to_eigen<dim>(centre), ", ")))
                             .found(fmt::format("a cell {:.3g} m across of body number {}", cell->diameter(),
                                                cell->material_id() + 1))
                             .advise("refine that body, or give it another shape"));
      });
}

template <int dim>
void Discretization<dim>::collect_owned_nodes()
{
  std::vector<bool> is_known(partitioner->locally_owned_size(), false);
  for (unsigned int cell = 0; cell < cells.n_cells; ++cell)
    for (unsigned int node = 0; node < cells.n_nodes(cell); ++node)
    {
      const unsigned int *dofs = cells.cell_dofs(cell) + node * dim;
      if (dofs[0] >= is_known.size() || is_known[dofs[0]])
        continue;
      is_known[dofs[0]] = true;
      OwnedNode<dim> owned{{}, {}, cells.bodies[cell]};
      std::copy(dofs, dofs + dim, owned.dofs.begin());
      for (unsigned int d = 0; d < dim; ++d)
        owned.position[d] = node_positions.local_element(dofs[d]);
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
  return owned_dofs.size() -
         dealii::Utilities::MPI::sum(static_cast<dealii::types::global_dof_index>(unused_dofs.size()),
                                     mpi_communicator);
}

template <int dim>
dealii::types::global_cell_index Discretization<dim>::n_cells() const
{
  dealii::types::global_cell_index n = 0;
  for (const MeshPart<dim> *part : parts)
    n += part->triangulation().n_global_active_cells();
  return n;
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
