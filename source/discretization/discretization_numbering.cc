// SPDX-License-Identifier: LGPL-2.1-or-later
// The degrees of freedom of all parts in one numbering.
#include "signorini/discretization/discretization.h"

#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_tools.h>

#include <algorithm>

namespace signorini
{
template <int dim>
void Discretization<dim>::number_dofs()
{
  for (MeshPart<dim> *part : parts)
    part->number_dofs();
  set_numbering();
  dealii::types::global_dof_index n_all_dofs = 0;
  for (const MeshPart<dim> *part : parts)
    n_all_dofs += part->dof_handler.n_dofs();
  owned_dofs = dealii::IndexSet(n_all_dofs);
  relevant_dofs = dealii::IndexSet(n_all_dofs);
  const auto add_all = [](const MeshPart<dim> &part, const dealii::IndexSet &of_part, dealii::IndexSet &all)
  {
    std::vector<dealii::types::global_dof_index> dofs;
    for (const dealii::types::global_dof_index dof : of_part)
      dofs.push_back(part.to_global(dof));
    std::sort(dofs.begin(), dofs.end());
    all.add_indices(dofs.begin(), dofs.end());
  };
  for (const MeshPart<dim> *part : parts)
  {
    add_all(*part, part->dof_handler.locally_owned_dofs(), owned_dofs);
    add_all(*part, part->relevant_dofs, relevant_dofs);
  }
  owned_dofs.compress();
  number_hanging_dofs();
}

template <int dim>
void Discretization<dim>::set_numbering()
{
  // The degrees of freedom of a rank follow each other, part by part.
  std::vector<dealii::types::global_dof_index> n_of_parts;
  for (const MeshPart<dim> *part : parts)
    n_of_parts.push_back(part->dof_handler.n_locally_owned_dofs());
  const auto n_of_ranks = dealii::Utilities::MPI::all_gather(mpi_communicator, n_of_parts);
  std::vector<std::vector<dealii::types::global_dof_index>> own_starts(parts.size()), starts(parts.size());
  std::vector<dealii::types::global_dof_index> own_start(parts.size(), 0);
  dealii::types::global_dof_index start = 0;
  for (const auto &n_of_rank : n_of_ranks)
    for (unsigned int part = 0; part < parts.size(); ++part)
    {
      own_starts[part].push_back(own_start[part]);
      starts[part].push_back(start);
      own_start[part] += n_of_rank[part];
      start += n_of_rank[part];
    }
  for (unsigned int part = 0; part < parts.size(); ++part)
    parts[part]->set_numbering(own_starts[part], starts[part]);
}

template <int dim>
void Discretization<dim>::number_hanging_dofs()
{
  dealii::AffineConstraints<double> own_constraints;
  if (hexahedra)
  {
    own_constraints.reinit(hexahedra->relevant_dofs);
    dealii::DoFTools::make_hanging_node_constraints(hexahedra->dof_handler, own_constraints);
    own_constraints.close();
    for (const auto &line : own_constraints.get_lines())
      for (const auto &entry : line.entries)
        relevant_dofs.add_index(hexahedra->to_global(entry.first));
  }
  relevant_dofs.compress();
  partitioner =
      std::make_shared<dealii::Utilities::MPI::Partitioner>(owned_dofs, relevant_dofs, mpi_communicator);

  hanging_constraints.reinit(relevant_dofs);
  for (const auto &line : own_constraints.get_lines())
  {
    const auto dof = hexahedra->to_global(line.index);
    HangingDof hanging{partitioner->global_to_local(dof), {}};
    hanging_constraints.add_line(dof);
    for (const auto &[own_master, weight] : line.entries)
    {
      const auto master = hexahedra->to_global(own_master);
      hanging_constraints.add_entry(dof, master, weight);
      hanging.masters.emplace_back(partitioner->global_to_local(master), weight);
    }
    hanging_dofs.push_back(std::move(hanging));
  }
  hanging_constraints.close();
}

template <int dim>
void Discretization<dim>::add_couplings(const dealii::AffineConstraints<double> &constraints,
                                        dealii::TrilinosWrappers::SparsityPattern &pattern) const
{
  std::vector<dealii::types::global_dof_index> dofs;
  for (unsigned int cell = 0; cell < cells.n_cells; ++cell)
  {
    dofs.clear();
    for (unsigned int i = 0; i < cells.n_cell_dofs(cell); ++i)
      dofs.push_back(partitioner->local_to_global(cells.cell_dofs(cell)[i]));
    constraints.add_entries_local_to_global(dofs, pattern, false);
  }
}

template void Discretization<2>::number_dofs();
template void Discretization<3>::number_dofs();
template void Discretization<2>::add_couplings(const dealii::AffineConstraints<double> &,
                                               dealii::TrilinosWrappers::SparsityPattern &) const;
template void Discretization<3>::add_couplings(const dealii::AffineConstraints<double> &,
                                               dealii::TrilinosWrappers::SparsityPattern &) const;
} // namespace signorini
