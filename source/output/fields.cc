// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/output/fields.h"

#include "signorini/base/exceptions.h"

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/numerics/data_out.h>

#include <cmath>
#include <fstream>
#include <optional>
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

/// A part's data for output, whose patches can be taken out.
template <int dim>
class PartOutput : public dealii::DataOut<dim>
{
public:
  using dealii::DataOut<dim>::get_patches;
  using dealii::DataOut<dim>::get_dataset_names;
  using dealii::DataOut<dim>::get_nonscalar_data_ranges;
};

/// The patches of all parts of the mesh, which must have the same data.
template <int dim>
class MergedOutput : public dealii::DataOutInterface<dim>
{
public:
  void add(const PartOutput<dim> &output)
  {
    patches.insert(patches.end(), output.get_patches().begin(), output.get_patches().end());
    names = output.get_dataset_names();
    ranges = output.get_nonscalar_data_ranges();
  }

private:
  using Patch = dealii::DataOutBase::Patch<dim, dim>;
  using Range = std::tuple<unsigned int, unsigned int, std::string,
                           dealii::DataComponentInterpretation::DataComponentInterpretation>;

  const std::vector<Patch> &get_patches() const override { return patches; }
  std::vector<std::string> get_dataset_names() const override { return names; }
  std::vector<Range> get_nonscalar_data_ranges() const override { return ranges; }

  std::vector<Patch> patches;
  std::vector<std::string> names;
  std::vector<Range> ranges;
};

using CellData = std::vector<std::pair<std::string, dealii::Vector<float>>>;

/// A part's cell data by name, indexed by active cell as DataOut wants them.
template <int dim>
CellData make_cell_data(const MeshPart<dim> &part, const std::vector<Eigen::Matrix3d> &stresses,
                        const std::optional<std::vector<double>> &plastic_strains,
                        const ErrorEstimate &estimate)
{
  CellData data;
  for (const char *name : {"body", "error_indicator", "von_mises_stress", "stress_xx", "stress_yy",
                           "stress_zz", "stress_xy", "stress_yz", "stress_xz"})
    data.emplace_back(name, dealii::Vector<float>(part.triangulation().n_active_cells()));
  if (plastic_strains)
    data.emplace_back("equivalent_plastic_strain", data.front().second);
  unsigned int own_cell = part.first_cell;
  for (const auto &cell : part.own_cells())
  {
    const Eigen::Matrix3d &s = stresses[own_cell];
    const double error = std::sqrt(estimate.cell_discretization[own_cell] + estimate.cell_contact[own_cell]);
    const std::array<double, 9> values{{static_cast<double>(cell->material_id()), error, von_mises(s),
                                        s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(0, 2)}};
    for (unsigned int i = 0; i < values.size(); ++i)
      data[i].second[cell->active_cell_index()] = static_cast<float>(values[i]);
    if (plastic_strains)
      data.back().second[cell->active_cell_index()] = static_cast<float>((*plastic_strains)[own_cell]);
    ++own_cell;
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
  contacts.clear();
  for (const MeshPart<dim> *part : discretization->parts)
    contacts.push_back(number_contact_fields_of(*part));
}

template <int dim>
std::unique_ptr<typename Fields<dim>::ContactFields>
Fields<dim>::number_contact_fields_of(const MeshPart<dim> &part) const
{
  auto fields = std::make_unique<ContactFields>();
  fields->dof_handler.reinit(part.triangulation());
  fields->dof_handler.distribute_dofs(part.element.base_element(0));
  dealii::DoFTools::extract_locally_relevant_dofs(fields->dof_handler, fields->relevant);

  std::unordered_map<dealii::types::global_dof_index, dealii::types::global_dof_index> scalar_dofs;
  std::vector<dealii::types::global_dof_index> dofs(part.element.n_dofs_per_cell()),
      scalars(part.element.n_dofs_per_cell() / dim);
  auto scalar_cell = fields->dof_handler.begin_active();
  for (const auto &cell : part.dof_handler.active_cell_iterators())
  {
    if (cell->is_locally_owned())
    {
      part.get_dof_indices(cell, dofs);
      scalar_cell->get_dof_indices(scalars);
      for (unsigned int node = 0; node < scalars.size(); ++node)
        scalar_dofs[dofs[part.element.component_to_system_index(0, node)]] = scalars[node];
    }
    ++scalar_cell;
  }
  for (unsigned int node = 0; node < map->surface().n_nodes(); ++node)
  {
    const auto scalar = scalar_dofs.find(map->node_dofs(node)[0]);
    if (scalar != scalar_dofs.end())
      fields->held.emplace_back(node, scalar->second);
  }
  return fields;
}

template <int dim>
typename Fields<dim>::NodalContact Fields<dim>::project_contact(const SceneForces<dim> &forces) const
{
  const ContactSurface<dim> &surface = map->surface();
  std::vector<double> pressures(surface.n_nodes(), 0.), gaps(surface.n_nodes(), 0.),
      areas(surface.n_nodes(), 0.);
  for (const auto &term : forces.surface_contacts)
  {
    const std::vector<std::optional<double>> of_term = term->nodal_pressures();
    for (unsigned int node = 0; node < surface.n_nodes(); ++node)
      pressures[node] += of_term[node].value_or(0.);
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
  map->sum(areas);
  map->sum(gaps);
  std::vector<double> far_gap(surface.n_nodes(), 0.);
  for (const Facet<dim> &facet : surface.facets)
    for (unsigned int i = 0; i < facet.n_nodes(); ++i)
      far_gap[facet.nodes[i]] = std::max(far_gap[facet.nodes[i]], facet.layer_thickness);
  map->maximize(far_gap);

  for (unsigned int node = 0; node < surface.n_nodes(); ++node)
    gaps[node] = areas[node] > 0. ? gaps[node] / areas[node] : far_gap[node];
  return {pressures, gaps};
}

template <int dim>
std::pair<Vector, Vector> Fields<dim>::spread(const NodalContact &nodal, const ContactFields &fields) const
{
  // The owner of a node may have no face at it.
  const auto tell_owners = [&](const std::vector<double> &values)
  {
    constexpr double untold = std::numeric_limits<double>::lowest();
    Vector told(fields.dof_handler.locally_owned_dofs(), fields.relevant, discretization->communicator());
    for (unsigned int i = 0; i < told.locally_owned_size() + told.get_partitioner()->n_ghost_indices(); ++i)
      told.local_element(i) = untold;
    for (const auto &[node, dof] : fields.held)
      told(dof) = values[node];
    told.compress(dealii::VectorOperation::max);
    for (double &value : told)
      value = value == untold ? 0. : value;
    told.update_ghost_values();
    return told;
  };
  return {tell_owners(nodal.pressures), tell_owners(nodal.gaps)};
}

template <int dim>
void Fields<dim>::write(const State &state, const SceneForces<dim> &forces, const ErrorEstimate &estimate)
{
  MergedOutput<dim> data_out;
  dealii::DataOutBase::VtkFlags flags;
  flags.compression_level = dealii::DataOutBase::VtkFlags::ZlibCompressionLevel::best_speed;
  data_out.set_flags(flags);
  const std::vector<dealii::DataComponentInterpretation::DataComponentInterpretation> vector_data(
      dim, dealii::DataComponentInterpretation::component_is_part_of_vector);
  const auto names = [](const char *name) { return std::vector<std::string>(dim, name); };
  const std::vector<Eigen::Matrix3d> stresses = forces.elasticity->stresses();
  std::optional<std::vector<double>> plastic_strains;
  if (forces.elasticity->has_plasticity())
    plastic_strains = forces.elasticity->plastic_strains();
  const NodalContact nodal = map ? project_contact(forces) : NodalContact();
  for (unsigned int p = 0; p < discretization->parts.size(); ++p)
  {
    const MeshPart<dim> &part = *discretization->parts[p];
    PartOutput<dim> output;
    output.attach_dof_handler(part.dof_handler);
    const Vector displacement = part.extract(state.displacement);
    output.add_data_vector(part.dof_handler, displacement, names("displacement"), vector_data);
    Vector velocity;
    if (state.velocity.size() > 0)
    {
      velocity = part.extract(state.velocity);
      output.add_data_vector(part.dof_handler, velocity, names("velocity"), vector_data);
    }
    std::pair<Vector, Vector> contact_data;
    if (map)
    {
      contact_data = spread(nodal, *contacts[p]);
      const bool is_all_contact = forces.volume_contacts.empty();
      output.add_data_vector(contacts[p]->dof_handler, contact_data.first,
                             is_all_contact ? "contact_pressure" : "obstacle_pressure");
      output.add_data_vector(contacts[p]->dof_handler, contact_data.second,
                             is_all_contact ? "gap" : "obstacle_gap");
    }
    const CellData cell_data = make_cell_data(part, stresses, plastic_strains, estimate);
    for (const auto &[name, values] : cell_data)
      output.add_data_vector(values, name, dealii::DataOut<dim>::type_cell_data);
    output.build_patches(part.mapping(), part.element.degree);
    data_out.add(output);
  }

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
