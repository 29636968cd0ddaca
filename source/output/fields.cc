// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/output/fields.h"

#include "signorini/base/collective_error.h"
#include "signorini/base/exceptions.h"

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/numerics/data_out.h>

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
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

/// Bounds the memory that writing takes, some 3 kB a cell.
constexpr unsigned int max_cells_of_piece = 25000;

using Interpretation = dealii::DataComponentInterpretation::DataComponentInterpretation;

dealii::DataOutBase::VtkFlags fast_compression()
{
  dealii::DataOutBase::VtkFlags flags;
  flags.compression_level = dealii::DataOutBase::VtkFlags::ZlibCompressionLevel::best_speed;
  return flags;
}

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

/// Of this rank.
template <int dim>
unsigned int n_pieces(const MeshPart<dim> &part)
{
  const std::size_t n_cells = part.own_cells().size();
  return static_cast<unsigned int>((n_cells + max_cells_of_piece - 1) / max_cells_of_piece);
}

/// The number of all ranks' pieces, and of those of the ranks before this one (collective).
template <int dim>
std::pair<unsigned int, unsigned int> count_pieces(const Discretization<dim> &discretization)
{
  unsigned int n_own = 0;
  for (const MeshPart<dim> *part : discretization.parts)
    n_own += n_pieces(*part);
  const MPI_Comm communicator = discretization.communicator();
  unsigned int n_before = 0; // which MPI leaves alone on the first rank
  MPI_Exscan(&n_own, &n_before, 1, MPI_UNSIGNED, MPI_SUM, communicator);
  return {dealii::Utilities::MPI::sum(n_own, communicator), n_before};
}

/// Throws FileError.
void write_file(const std::string &path, const std::function<void(std::ostream &)> &write_to)
{
  std::ofstream file(path);
  try
  {
    write_to(file);
  }
  catch (const dealii::ExceptionBase &)
  {
    file.setstate(std::ios::failbit);
  }
  if (!file.flush())
    throw FileError("cannot write '" + path + "': is the disk full?");
}

/// Writes this rank's pieces of a part to `path`.I.vtu, I from `first_piece` on. Throws FileError.
template <int dim>
void write_pieces(const MeshPart<dim> &part, const std::string &path, unsigned int first_piece,
                  dealii::DataOut<dim> &output)
{
  std::vector<unsigned int> piece_of_cell(part.triangulation().n_active_cells(), n_pieces(part));
  for (unsigned int i = 0; i < part.own_cells().size(); ++i)
    piece_of_cell[part.own_cells()[i]->active_cell_index()] = i / max_cells_of_piece;
  for (unsigned int piece = 0; piece < n_pieces(part); ++piece)
  {
    output.set_cell_selection(
        [&piece_of_cell, piece](const typename dealii::Triangulation<dim>::cell_iterator &cell)
        { return cell->is_active() && piece_of_cell[cell->active_cell_index()] == piece; });
    output.build_patches(part.mapping(), part.element.degree);
    write_file(fmt::format("{}.{}.vtu", path, first_piece + piece),
               [&output](std::ostream &file) { output.write_vtu(file); });
  }
}

/// Writes the list of pieces to `path`.pvtu. Throws FileError.
template <int dim>
void write_list_of_pieces(const std::string &path, unsigned int n_pieces, const dealii::DataOut<dim> &output)
{
  std::vector<std::string> names(n_pieces);
  for (unsigned int piece = 0; piece < n_pieces; ++piece)
    names[piece] = fmt::format("{}.{}.vtu", std::filesystem::path(path).filename().string(), piece);
  write_file(path + ".pvtu", [&](std::ostream &file) { output.write_pvtu_record(file, names); });
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
  const std::vector<Eigen::Matrix3d> stresses = forces.elasticity->stresses();
  std::optional<std::vector<double>> plastic_strains;
  if (forces.elasticity->has_plasticity())
    plastic_strains = forces.elasticity->plastic_strains();
  const NodalContact nodal = map ? project_contact(forces) : NodalContact();
  const std::string name = fmt::format("solution_{:04}", records.size()), path = directory + "/" + name;
  const MPI_Comm communicator = discretization->communicator();
  const bool is_first_rank = dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
  auto [n_pieces_of_all, piece] = count_pieces(*discretization);
  for (unsigned int p = 0; p < discretization->parts.size(); ++p)
  {
    const MeshPart<dim> &part = *discretization->parts[p];
    dealii::DataOut<dim> output;
    output.set_flags(fast_compression());
    const auto add_vectors = [&](const Vector &values, const char *name_of_values)
    {
      output.add_data_vector(part.dof_handler, values, std::vector<std::string>(dim, name_of_values),
                             std::vector(dim, Interpretation::component_is_part_of_vector));
    };
    const Vector displacement = part.extract(state.displacement);
    add_vectors(displacement, "displacement");
    Vector velocity;
    if (state.velocity.size() > 0)
    {
      velocity = part.extract(state.velocity);
      add_vectors(velocity, "velocity");
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
    for (const auto &[name_of_values, values] : cell_data)
      output.add_data_vector(values, name_of_values, dealii::DataOut<dim>::type_cell_data);
    throw_together(communicator,
                   [&, first_piece = piece, n_all = n_pieces_of_all]
                   {
                     write_pieces(part, path, first_piece, output);
                     if (is_first_rank && p == 0)
                       write_list_of_pieces(path, n_all, output);
                   });
    piece += n_pieces(part);
  }
  records.emplace_back(state.time, name + ".pvtu");
  throw_together(communicator,
                 [&]
                 {
                   if (is_first_rank)
                     write_file(directory + "/solution.pvd", [this](std::ostream &file)
                                { dealii::DataOutBase::write_pvd_record(file, records); });
                 });
}

template class Fields<2>;
template class Fields<3>;
} // namespace signorini
