// SPDX-License-Identifier: LGPL-2.1-or-later
// The hexahedra of an adapted mesh made again from their ids.
#include "signorini/base/exceptions.h"
#include "signorini/discretization/discretization.h"

#include <deal.II/grid/cell_id.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>

namespace signorini
{
namespace
{
using Ids = std::vector<dealii::CellId::binary_type>;
using IdSet = std::set<dealii::CellId>;

dealii::CellId ancestor_of(const dealii::CellId &id, std::size_t level)
{
  const auto way = id.get_child_indices();
  return {id.get_coarse_cell_id(), std::vector<std::uint8_t>(way.begin(), way.begin() + level)};
}

/// All cells that have been refined where the active ones are these.
IdSet find_refined(const std::vector<Ids> &ids_of_ranks)
{
  IdSet refined;
  for (const Ids &ids : ids_of_ranks)
    for (const dealii::CellId id : ids)
      for (std::size_t level = 0; level < id.get_child_indices().size(); ++level)
        refined.insert(ancestor_of(id, level));
  return refined;
}

/// One cell of each complete family that is on several ranks.
IdSet find_divided(const std::vector<Ids> &ids_of_ranks, unsigned int n_children)
{
  struct Family
  {
    unsigned int n_cells = 0;
    std::set<std::size_t> ranks;
  };
  std::map<dealii::CellId, Family> families;
  IdSet divided;
  for (std::size_t rank = 0; rank < ids_of_ranks.size(); ++rank)
    for (const dealii::CellId id : ids_of_ranks[rank])
      if (const std::size_t level = id.get_child_indices().size(); level > 0)
      {
        Family &family = families[ancestor_of(id, level - 1)];
        family.ranks.insert(rank);
        if (++family.n_cells == n_children && family.ranks.size() > 1)
          divided.insert(id);
      }
  return divided;
}

/// Refines and coarsens until all of these cells and no others are refined, but for those that keep
/// neighbours within one level.
template <typename Mesh>
void change(const IdSet &refined, const MPI_Comm &communicator, Mesh &mesh)
{
  constexpr unsigned int most_rounds = 100;
  for (unsigned int round = 0; round < most_rounds; ++round)
  {
    for (const auto &cell : mesh.active_cell_iterators())
      if (cell->is_locally_owned() && refined.count(cell->id()) > 0)
        cell->set_refine_flag();
      else if (cell->is_locally_owned() && cell->level() > 0 && refined.count(cell->parent()->id()) == 0)
        cell->set_coarsen_flag();
    mesh.prepare_coarsening_and_refinement();
    bool is_any = false;
    for (const auto &cell : mesh.active_cell_iterators())
      is_any |= cell->is_locally_owned() && (cell->refine_flag_set() || cell->coarsen_flag_set());
    if (dealii::Utilities::MPI::max(static_cast<int>(is_any), communicator) == 0)
      return;
    mesh.execute_coarsening_and_refinement();
  }
}

/// Moves the cells, each of them once refined at most, to the ranks that are to have them.
template <typename Mesh>
void share_out(const std::vector<Ids> &ids_of_ranks, unsigned int n_children, Mesh &mesh)
{
  // p4est cuts where its sum of weights passes the share of a rank: the sums of all ranks have to be equal.
  std::size_t largest = 1;
  for (const Ids &ids : ids_of_ranks)
    largest = std::max(largest, ids.size());
  std::map<dealii::CellId, unsigned int> weights;
  for (const Ids &ids : ids_of_ranks)
    for (std::size_t i = 0; i < ids.size(); ++i)
      weights[dealii::CellId(ids[i])] = i == 0 ? largest - ids.size() + 1 : 1;
  const boost::signals2::scoped_connection connection = mesh.signals.weight.connect(
      [&](const auto &cell, const auto &)
      {
        if (const auto weight = weights.find(cell->id()); weight != weights.end())
          return n_children * weight->second;
        const auto weight = cell->level() > 0 ? weights.find(cell->parent()->id()) : weights.end();
        return weight != weights.end() ? weight->second : 1u; // of another coarse mesh, seen later
      });
  mesh.repartition();
}
} // namespace

template <int dim>
std::vector<dealii::CellId::binary_type> Discretization<dim>::hexahedron_ids() const
{
  Ids ids;
  if (hexahedra)
    for (const auto &cell : hexahedra->own_cells())
      ids.push_back(cell->id().template to_binary<dim>());
  return ids;
}

template <int dim>
void Discretization<dim>::restore(const std::vector<dealii::CellId::binary_type> &ids)
{
  const auto is_different = [&]()
  { return dealii::Utilities::MPI::max(static_cast<int>(hexahedron_ids() != ids), mpi_communicator) == 1; };
  if (!is_different())
    return;
  constexpr unsigned int n_children = dealii::GeometryInfo<dim>::max_children_per_cell;
  const std::vector<Ids> ids_of_ranks = dealii::Utilities::MPI::all_gather(mpi_communicator, ids);
  const IdSet refined = find_refined(ids_of_ranks);
  auto &mesh = hexahedra->mesh;
  change(refined, mpi_communicator, mesh);
  // p4est divides no complete family, though one can become complete after it was divided: for the moment
  // that it is shared out it must not be complete.
  IdSet refined_for_now = find_divided(ids_of_ranks, n_children);
  refined_for_now.insert(refined.begin(), refined.end());
  change(refined_for_now, mpi_communicator, mesh);
  share_out(ids_of_ranks, n_children, mesh);
  change(refined, mpi_communicator, mesh);
  set_up_anew({});
  if (is_different())
    throw FileError(
        Complaint("the adapted mesh could not be made again and shared out among the ranks as it was")
            .advise("run again from the start"));
}

template std::vector<dealii::CellId::binary_type> Discretization<2>::hexahedron_ids() const;
template std::vector<dealii::CellId::binary_type> Discretization<3>::hexahedron_ids() const;
template void Discretization<2>::restore(const std::vector<dealii::CellId::binary_type> &);
template void Discretization<3>::restore(const std::vector<dealii::CellId::binary_type> &);
} // namespace signorini
