// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/output/fields.h"

#include "signorini/base/exceptions.h"

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/numerics/data_out.h>

#include <cmath>
#include <fstream>
#include <unordered_map>

namespace signorini
{
namespace
{
double von_mises(const Eigen::Matrix3d &stress)
{
  const Eigen::Matrix3d deviator = stress - stress.trace() / 3. * Eigen::Matrix3d::Identity();
  return std::sqrt(1.5) * deviator.norm();
}

/// Cell data by name, indexed by active cell as DataOut wants them.
template <int dim>
std::vector<std::pair<std::string, dealii::Vector<float>>>
make_cell_data(const Discretization<dim> &discretization, const InternalForce<dim> &elasticity,
               const ErrorEstimate &estimate)
{
  std::vector<std::pair<std::string, dealii::Vector<float>>> data;
  for (const char *name : {"body", "error_indicator", "von_mises_stress", "stress_xx", "stress_yy",
                           "stress_zz", "stress_xy", "stress_yz", "stress_xz"})
    data.emplace_back(name, dealii::Vector<float>(discretization.mesh->n_active_cells()));
  const std::vector<Eigen::Matrix3d> stresses = elasticity.stresses();
  unsigned int own_cell = 0;
  for (const auto &cell : discretization.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      const Eigen::Matrix3d &s = stresses[own_cell];
      const double error =
          std::sqrt(estimate.cell_discretization[own_cell] + estimate.cell_contact[own_cell]);
      ++own_cell;
      const std::array<double, 9> values{{static_cast<double>(cell->material_id()), error, von_mises(s),
                                          s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(0, 2)}};
      for (unsigned int i = 0; i < values.size(); ++i)
        data[i].second[cell->active_cell_index()] = static_cast<float>(values[i]);
    }
  return data;
}
} // namespace

template <int dim>
Fields<dim>::Fields(std::string output_directory) : directory(std::move(output_directory))
{
}

template <int dim>
void Fields<dim>::set_mesh(const Discretization<dim> &the_discretization, const SurfaceMap<dim> *surface_map)
{
  discretization = &the_discretization;
  map = surface_map;
  if (map)
    number_contact_fields();
}

template <int dim>
void Fields<dim>::number_contact_fields()
{
  contact.reset(new ContactFields{dealii::FE_Q<dim>(discretization->element.degree), {}, {}, {}});
  contact->dof_handler.reinit(*discretization->mesh);
  contact->dof_handler.distribute_dofs(contact->element);
  dealii::DoFTools::extract_locally_relevant_dofs(contact->dof_handler, contact->relevant);

  std::unordered_map<dealii::types::global_dof_index, dealii::types::global_dof_index> scalar_dofs;
  std::vector<dealii::types::global_dof_index> dofs(discretization->element.n_dofs_per_cell()),
      scalars(contact->element.n_dofs_per_cell());
  auto scalar_cell = contact->dof_handler.begin_active();
  for (const auto &cell : discretization->dof_handler.active_cell_iterators())
  {
    if (cell->is_locally_owned())
    {
      cell->get_dof_indices(dofs);
      scalar_cell->get_dof_indices(scalars);
      for (unsigned int node = 0; node < scalars.size(); ++node)
        scalar_dofs[dofs[discretization->element.component_to_system_index(0, node)]] = scalars[node];
    }
    ++scalar_cell;
  }
  const dealii::IndexSet &owned = contact->dof_handler.locally_owned_dofs();
  for (unsigned int node = 0; node < map->surface().n_nodes(); ++node)
  {
    const auto scalar = scalar_dofs.find(map->node_dofs(node)[0]);
    if (scalar != scalar_dofs.end() && owned.is_element(scalar->second))
      contact->owned.emplace_back(node, scalar->second);
  }
}

template <int dim>
std::pair<Vector, Vector> Fields<dim>::project_contact(const SceneForces<dim> &forces) const
{
  const ContactSurface<dim> &surface = map->surface();
  std::vector<double> pressures(surface.n_nodes(), 0.), gaps(surface.n_nodes(), 0.),
      areas(surface.n_nodes(), 0.);
  for (const auto &term : forces.contacts)
  {
    const std::vector<SpatialVector<dim>> nodal_forces = term->nodal_forces();
    const std::vector<double> nodal_areas = term->nodal_areas();
    for (unsigned int node = 0; node < surface.n_nodes(); ++node)
      if (nodal_areas[node] > 0.)
        pressures[node] += nodal_forces[node].norm() / nodal_areas[node];
    for (const contact::ContactSample<dim> &sample : term->samples())
    {
      const Facet<dim> &facet = surface.facets[sample.facet];
      for (unsigned int i = 0; i < facet.n_nodes(); ++i)
      {
        const double weight = sample.area * contact::evaluate_hat_function(facet, i, sample.xi);
        areas[facet.nodes[i]] += weight;
        gaps[facet.nodes[i]] += weight * std::min(-sample.depth, facet.layer_thickness);
      }
    }
  }
  for (std::vector<double> *sums : {&areas, &gaps})
    MPI_Allreduce(MPI_IN_PLACE, sums->data(), static_cast<int>(sums->size()), MPI_DOUBLE, MPI_SUM,
                  discretization->communicator());
  std::vector<double> far_gap(surface.n_nodes(), 0.);
  for (const Facet<dim> &facet : surface.facets)
    for (unsigned int i = 0; i < facet.n_nodes(); ++i)
      far_gap[facet.nodes[i]] = std::max(far_gap[facet.nodes[i]], facet.layer_thickness);

  Vector pressure(contact->dof_handler.locally_owned_dofs(), contact->relevant,
                  discretization->communicator());
  Vector gap(pressure);
  for (const auto &[node, dof] : contact->owned)
  {
    pressure[dof] = pressures[node];
    gap[dof] = areas[node] > 0. ? gaps[node] / areas[node] : far_gap[node];
  }
  pressure.update_ghost_values();
  gap.update_ghost_values();
  return {pressure, gap};
}

template <int dim>
void Fields<dim>::write(const State &state, const SceneForces<dim> &forces, const ErrorEstimate &estimate)
{
  dealii::DataOut<dim> data_out;
  dealii::DataOutBase::VtkFlags flags;
  flags.compression_level = dealii::DataOutBase::VtkFlags::ZlibCompressionLevel::best_speed;
  data_out.set_flags(flags);
  const std::vector<dealii::DataComponentInterpretation::DataComponentInterpretation> vector_data(
      dim, dealii::DataComponentInterpretation::component_is_part_of_vector);
  const auto names = [](const char *name) { return std::vector<std::string>(dim, name); };
  data_out.attach_dof_handler(discretization->dof_handler);
  data_out.add_data_vector(discretization->dof_handler, state.displacement, names("displacement"),
                           vector_data);
  if (state.velocity.size() > 0)
    data_out.add_data_vector(discretization->dof_handler, state.velocity, names("velocity"), vector_data);
  std::pair<Vector, Vector> contact_data;
  if (map)
  {
    contact_data = project_contact(forces);
    data_out.add_data_vector(contact->dof_handler, contact_data.first, "contact_pressure");
    data_out.add_data_vector(contact->dof_handler, contact_data.second, "gap");
  }
  const auto cell_data = make_cell_data(*discretization, *forces.elasticity, estimate);
  for (const auto &[name, values] : cell_data)
    data_out.add_data_vector(values, name, dealii::DataOut<dim>::type_cell_data);
  data_out.build_patches(discretization->mapping, discretization->element.degree);

  try
  {
    const std::string record = data_out.write_vtu_with_pvtu_record(
        directory + "/", "solution", records.size(), discretization->communicator(), 4);
    records.emplace_back(state.time, record);
  }
  catch (const dealii::ExceptionBase &)
  {
    throw FileError("cannot write the fields into '" + directory + "': is the disk full?");
  }
  if (dealii::Utilities::MPI::this_mpi_process(discretization->communicator()) == 0)
  {
    std::ofstream file(directory + "/solution.pvd");
    dealii::DataOutBase::write_pvd_record(file, records);
    if (!file)
      throw FileError("cannot write '" + directory + "/solution.pvd'");
  }
}

template class Fields<2>;
template class Fields<3>;
} // namespace signorini
