// SPDX-License-Identifier: LGPL-2.1-or-later
// What a Simulation saves on its way, and how it goes on from there.
#include "signorini/base/exceptions.h"
#include "signorini/output/archive.h"
#include "signorini/parameters/checkpoint_parameters.h"
#include "signorini/simulation/simulation.h"

#include <fmt/core.h>

#include <sstream>

namespace signorini
{
template <int dim>
template <typename Archive>
void Simulation<dim>::archive_run(Archive &archive)
{
  std::vector<double> densities;
  for (const MaterialParameters &material : scene.materials)
    densities.push_back(material.density);
  std::vector<dealii::CellId::binary_type> ids = discretization->hexahedron_ids();
  std::size_t n_owned_dofs = discretization->owned_dofs.n_elements();
  archive &results &densities &ids &n_owned_dofs;
  if (Archive::is_loading::value)
  {
    for (unsigned int body = 0; body < scene.n_bodies(); ++body)
      scene.materials[body].density = densities[body];
    build_as_saved(ids, n_owned_dofs);
  }
  Vector node_positions = discretization->node_positions;
  archive &node_positions;
  if (Archive::is_loading::value)
    check_same_nodes(node_positions);
  archive &state.time &state.displacement;
  if (is_in_motion())
    archive &state.velocity;
  archive &*forces.elasticity;
  for (const auto &contact : forces.surface_contacts)
    archive &*contact;
  for (const auto &friction : forces.frictions)
    archive &*friction;
  if (quasi_static_solver)
    archive &*quasi_static_solver;
  if (explicit_solver)
    archive &*explicit_solver;
  if (implicit_solver)
    archive &*implicit_solver;
  archive &largest_energy &step_length &longest_step &next_adaptation_step &next_adaptation_time;
  archive &has_warned_of_depth &has_warned_of_unseen &time_of_fields;
  constexpr int none = -1;
  int cycle = refinement_cycle ? static_cast<int>(*refinement_cycle) : none;
  archive &cycle;
  if (Archive::is_loading::value && cycle != none)
    refinement_cycle = cycle;
  if (refinement_cycle)
  {
    if (Archive::is_loading::value)
      step_start.state.displacement = discretization->make_vector();
    archive &step_start.state.time &step_start.state.displacement &step_start.memory &step_start.plastic_work;
  }
  archive &*fields &statistics_size &run_time;
}

template <int dim>
void Simulation<dim>::build_as_saved(const std::vector<dealii::CellId::binary_type> &hexahedron_ids,
                                     std::size_t n_owned_dofs)
{
  discretization->restore(hexahedron_ids);
  const bool is_other = discretization->owned_dofs.n_elements() != n_owned_dofs;
  if (dealii::Utilities::MPI::max(static_cast<int>(is_other), communicator) == 1)
    throw FileError(
        Complaint("the mesh is not that of the checkpoint")
            .found(fmt::format("{} degrees of freedom on a rank", discretization->owned_dofs.n_elements()))
            .expected(std::to_string(n_owned_dofs))
            .advise("take the mesh files that the run began with, or run again from the start"));
  build_on_mesh();
  state.displacement = discretization->make_vector();
  if (is_in_motion())
    state.velocity = discretization->make_vector();
  if (std::holds_alternative<QuasiStaticParameters>(parameters.solver))
    make_quasi_static_solver();
  else if (std::holds_alternative<ImplicitParameters>(parameters.solver))
    make_implicit_solver();
  else
    make_explicit_solver();
}

template <int dim>
void Simulation<dim>::check_same_nodes(const Vector &saved) const
{
  Vector difference = saved;
  difference -= discretization->node_positions;
  const double largest = difference.linfty_norm(), size = saved.linfty_norm();
  if (largest > 1e-10 * size)
    throw FileError(Complaint("the mesh is not that of the checkpoint")
                        .found(fmt::format("a node {:.3g} m aside", largest))
                        .advise("take the mesh files that the run began with, or run again from the start"));
}

template <int dim>
void Simulation<dim>::save()
{
  if (!parameters.checkpoint)
    return;
  const auto section = run_time.enter("checkpoint");
  if (statistics)
    statistics_size = statistics->size();
  std::ostringstream stream;
  {
    boost::archive::binary_oarchive archive(stream);
    const std::map<std::string, std::string> entries = scene_entries(*text);
    archive &entries;
    archive_run(archive);
  }
  checkpoint.write(stream.str());
  run_time_of_checkpoint = run_time.total();
  time_of_checkpoint = state.time;
}

template <int dim>
void Simulation<dim>::save_when_due()
{
  if (!parameters.checkpoint)
    return;
  const bool is_due = run_time.total() - run_time_of_checkpoint >= parameters.checkpoint->interval;
  if (dealii::Utilities::MPI::broadcast(communicator, is_due, 0))
    save();
}

template <int dim>
void Simulation<dim>::resume()
{
  const Checkpoint::Found found = checkpoint.read();
  std::istringstream stream(found.content);
  try
  {
    boost::archive::binary_iarchive archive(stream);
    std::map<std::string, std::string> entries;
    archive &entries;
    check_unchanged(*text, entries);
    progress.open_log(parameters.output.directory, Progress::EarlierLog::continued);
    archive_run(archive);
  }
  catch (const boost::archive::archive_exception &)
  {
    throw FileError(Complaint("the checkpoint was written by another build of the program")
                        .at(found.slot)
                        .advise("take that one, or run again from the start, without --resume"));
  }
  const double end = std::visit([](const auto &solver) { return solver.end_time; }, parameters.solver);
  if (state.time > end)
    throw InputError(Complaint("the end time lies before the checkpoint")
                         .found(fmt::format("{:.6g} s", end))
                         .expected(fmt::format("at least {:.6g} s, where {} goes on", state.time, found.slot))
                         .advise("raise 'End time', or run from the start, without --resume"));
  is_resumed = true;
  forces.elasticity->update(state);
  for (const auto &load : forces.loads)
    load->update(state);
  next_row = next_output(state.time, parameters.output.n_statistics, end);
  next_field = next_output(time_of_fields, parameters.output.n_fields, end);
  run_time_of_checkpoint = run_time.total();
  time_of_checkpoint = state.time;
  for (const std::string &fault : found.faults)
    warn(fmt::format("the last checkpoint is not used: {}", fault));
  progress.say(
      fmt::format("Resumed from {} at t = {:.6g}, after {} steps", found.slot, state.time, results.n_steps));
}

template class Simulation<2>;
template class Simulation<3>;
} // namespace signorini
