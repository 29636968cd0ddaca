// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/discretization/supports.h"

#include "signorini/base/collective_error.h"
#include "signorini/base/exceptions.h"
#include "signorini/discretization/scene_mesh.h"

#include <algorithm>

namespace signorini
{
namespace
{
/// Boundary ids and the supports upon them.
template <int dim>
std::multimap<dealii::types::boundary_id, unsigned int> find_supported_boundaries(const Scene<dim> &scene)
{
  std::multimap<dealii::types::boundary_id, unsigned int> supports;
  for (unsigned int s = 0; s < scene.supports.size(); ++s)
    supports.emplace(global_boundary_id(scene.supports[s].body, scene.supports[s].boundary_id), s);
  return supports;
}

template <int dim>
using Entries = std::vector<typename SupportedDofs<dim>::Entry>;

template <int dim>
Entries<dim> find_entries_of_own_cells(const Scene<dim> &scene, const Discretization<dim> &discretization)
{
  const auto supported = find_supported_boundaries(scene);
  Entries<dim> entries;
  const auto collect = [&](const MeshPart<dim> &part, const auto &cell, unsigned int)
  {
    for (const unsigned int face : cell->face_indices())
    {
      const auto [first, last] = supported.equal_range(cell->face(face)->boundary_id());
      if (!cell->face(face)->at_boundary() || first == last)
        continue;
      for (const auto &dofs : part.face_nodes(cell, face))
      {
        if (discretization.hanging_constraints.is_constrained(dofs[0]))
          continue;
        dealii::Point<dim> position;
        for (unsigned int d = 0; d < dim; ++d)
          position[d] = discretization.node_positions(dofs[d]);
        for (auto support = first; support != last; ++support)
          entries.push_back({dofs[scene.supports[support->second].component], support->second, position});
      }
    }
  };
  discretization.for_each_own_cell(collect);
  return entries;
}

template <int dim>
std::vector<double> pack(const Entries<dim> &entries)
{
  std::vector<double> packed;
  for (const auto &entry : entries)
  {
    packed.push_back(static_cast<double>(entry.dof));
    packed.push_back(entry.support);
    for (unsigned int d = 0; d < dim; ++d)
      packed.push_back(entry.position[d]);
  }
  return packed;
}

template <int dim>
Entries<dim> unpack(const std::vector<std::vector<double>> &packed_of_ranks)
{
  Entries<dim> entries;
  for (const std::vector<double> &packed : packed_of_ranks)
    for (std::size_t i = 0; i < packed.size(); i += dim + 2)
    {
      dealii::Point<dim> position;
      for (unsigned int d = 0; d < dim; ++d)
        position[d] = packed[i + 2 + d];
      entries.push_back({static_cast<dealii::types::global_dof_index>(packed[i]),
                         static_cast<unsigned int>(packed[i + 1]), position});
    }
  return entries;
}
} // namespace

template <int dim>
SupportedDofs<dim>::SupportedDofs(const Scene<dim> &the_scene, const Discretization<dim> &discretization,
                                  double end_time)
    : scene(&the_scene)
{
  Entries<dim> entries = unpack<dim>(dealii::Utilities::MPI::all_gather(
      discretization.communicator(), pack<dim>(find_entries_of_own_cells(the_scene, discretization))));
  std::sort(entries.begin(), entries.end(),
            [](const Entry &a, const Entry &b)
            { return std::pair(a.dof, a.support) < std::pair(b.dof, b.support); });
  for (const Entry &entry : entries)
  {
    if (all.empty() || all.back().dof != entry.dof)
    {
      all.push_back(entry);
      continue;
    }
    for (const double t : {0., end_time})
      if (std::abs(value(all.back(), t) - value(entry, t)) > 1e-12 * std::abs(value(entry, t)))
      {
        const Support<dim> &one = scene->supports[all.back().support],
                           &other = scene->supports[entry.support];
        throw InputError(Complaint("the supports '" + one.boundary + "' and '" + other.boundary +
                                   "' of body '" + scene->body_names[one.body] +
                                   "' contradict each other in component " + "xyz"[one.component] +
                                   " on the edge they share")
                             .at(other.description)
                             .found(other.displacement.formula() + "; the other, " + one.description +
                                    ", has " + one.displacement.formula())
                             .expected("the same displacement wherever both hold")
                             .advise("leave that component out of one of them"));
      }
  }
  const Vector layout = discretization.make_vector();
  for (unsigned int i = 0; i < all.size(); ++i)
    if (discretization.owned_dofs.is_element(all[i].dof))
    {
      owned.push_back(layout.get_partitioner()->global_to_local(all[i].dof));
      owned_entries.push_back(i);
    }
}

template <int dim>
double SupportedDofs<dim>::value(const Entry &entry, double t) const
{
  const Support<dim> &support = scene->supports[entry.support];
  return evaluate(support.displacement, support.description, entry.position, t);
}

template <int dim>
void SupportedDofs<dim>::impose(double t, Vector &displacement) const
{
  const auto impose_own = [&]()
  {
    for (unsigned int i = 0; i < owned.size(); ++i)
      displacement.local_element(owned[i]) = value(all[owned_entries[i]], t);
  };
  throw_together(displacement.get_mpi_communicator(), impose_own);
}

template <int dim>
void SupportedDofs<dim>::clear(Vector &forces) const
{
  for (const unsigned int dof : owned)
    forces.local_element(dof) = 0.;
}

template class SupportedDofs<2>;
template class SupportedDofs<3>;
} // namespace signorini
