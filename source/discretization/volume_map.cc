// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/discretization/volume_map.h"

#include <deal.II/base/mpi.h>

#include <unordered_map>

namespace signorini
{
namespace
{
/// The cells of this rank, each as its body, its number of corners and for every corner its degrees of
/// freedom and its position.
template <int dim>
std::vector<double> pack_own_cells(const Discretization<dim> &discretization)
{
  std::vector<double> packed;
  const CellTable<dim> &cells = discretization.cells;
  const auto &partitioner = *discretization.node_positions.get_partitioner();
  for (unsigned int cell = 0; cell < cells.n_cells; ++cell)
  {
    const unsigned int *dofs = cells.cell_dofs(cell);
    packed.push_back(cells.bodies[cell]);
    packed.push_back(cells.n_nodes(cell));
    for (unsigned int i = 0; i < cells.n_cell_dofs(cell); ++i)
    {
      packed.push_back(static_cast<double>(partitioner.local_to_global(dofs[i])));
      packed.push_back(discretization.node_positions.local_element(dofs[i]));
    }
  }
  return packed;
}

/// A cell of any rank, its corners as nodes of the volume.
template <int dim>
struct CornerCell
{
  Simplex<dim> properties;
  std::vector<unsigned int> corners;
};

/// Adds the simplices of all cells; their nodes are there already.
template <int dim>
void add_simplices(const std::vector<CornerCell<dim>> &cells, ContactVolume<dim> &volume)
{
  CellSplitter<dim> splitter(volume);
  for (const CornerCell<dim> &cell : cells)
    if (cell.corners.size() == dim + 1)
    {
      Simplex<dim> simplex = cell.properties;
      std::copy(cell.corners.begin(), cell.corners.end(), simplex.vertices.begin());
      volume.simplices.push_back(simplex);
    }
    else
    {
      typename CellSplitter<dim>::Cell corners;
      std::copy(cell.corners.begin(), cell.corners.end(), corners.begin());
      splitter.add(corners, cell.properties);
    }
}
} // namespace

template <int dim>
VolumeMap<dim>::VolumeMap(const Scene<dim> &scene, const Discretization<dim> &the_discretization)
    : NodeMap<dim>(the_discretization)
{
  const MPI_Comm &communicator = the_discretization.communicator();
  const unsigned int this_rank = dealii::Utilities::MPI::this_mpi_process(communicator);
  const auto packed = dealii::Utilities::MPI::all_gather(communicator, pack_own_cells(the_discretization));
  std::unordered_map<dealii::types::global_dof_index, unsigned int> node_of_dof;
  std::vector<typename NodeMap<dim>::NodeDofs> all_node_dofs;
  std::vector<CornerCell<dim>> cells;
  for (unsigned int rank = 0; rank < packed.size(); ++rank)
  {
    if (rank == this_rank)
      begin_of_own_cells = static_cast<unsigned int>(cells.size());
    for (auto value = packed[rank].begin(); value != packed[rank].end();)
    {
      CornerCell<dim> cell;
      cell.properties.cell = static_cast<unsigned int>(cells.size());
      cell.properties.owned = (rank == this_rank);
      cell.properties.body = static_cast<unsigned int>(*value++);
      cell.properties.youngs_modulus = scene.materials[cell.properties.body].youngs_modulus;
      cell.properties.density = scene.materials[cell.properties.body].density;
      cell.corners.resize(static_cast<unsigned int>(*value++));
      for (unsigned int &corner : cell.corners)
      {
        typename NodeMap<dim>::NodeDofs node_dofs;
        SpatialVector<dim> position;
        for (unsigned int d = 0; d < dim; ++d)
        {
          node_dofs[d] = static_cast<dealii::types::global_dof_index>(*value++);
          position[d] = *value++;
        }
        const auto [entry, is_new] = node_of_dof.emplace(node_dofs[0], contact_volume.n_nodes());
        corner = entry->second;
        if (is_new)
        {
          contact_volume.reference_positions.push_back(position);
          all_node_dofs.push_back(node_dofs);
        }
      }
      cells.push_back(std::move(cell));
    }
  }
  n_all_cells = static_cast<unsigned int>(cells.size());
  contact_volume.n_bodies = scene.n_bodies();
  contact_volume.origin = move_to_middle(contact_volume.reference_positions, communicator);
  add_simplices(cells, contact_volume);
  compute_heights(contact_volume);
  this->set_nodes(std::move(all_node_dofs));
}

template <int dim>
std::vector<SpatialVector<dim>> VolumeMap<dim>::positions(const Vector &displacement) const
{
  std::vector<SpatialVector<dim>> x = this->gather(displacement);
  for (unsigned int node = 0; node < x.size(); ++node)
    x[node] += contact_volume.reference_positions[node];
  return x;
}

template class VolumeMap<2>;
template class VolumeMap<3>;
} // namespace signorini
