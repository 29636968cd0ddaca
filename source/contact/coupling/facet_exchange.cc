// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/coupling/facet_exchange.h"

#include <deal.II/base/mpi.h>

#include <map>

namespace signorini
{
namespace
{
template <int dim>
using Queries = std::vector<contact::FacetQuery<dim>>;

template <int dim>
void append(const contact::BoundingBox<dim> &box, std::vector<double> &packed)
{
  packed.insert(packed.end(), box.min().begin(), box.min().end());
  packed.insert(packed.end(), box.max().begin(), box.max().end());
}

template <int dim>
contact::BoundingBox<dim> take_box(const double *values)
{
  return {SpatialVector<dim>(Eigen::Map<const SpatialVector<dim>>(values)),
          SpatialVector<dim>(Eigen::Map<const SpatialVector<dim>>(values + dim))};
}

/// One of each rank; empty where it has no facets.
template <int dim>
std::vector<contact::BoundingBox<dim>> gather_boxes(const std::vector<contact::BoundingBox<dim>> &own_boxes,
                                                    const MPI_Comm &communicator)
{
  contact::BoundingBox<dim> own;
  for (const contact::BoundingBox<dim> &box : own_boxes)
    own.extend(box);
  std::vector<double> packed;
  append<dim>(own, packed);
  std::vector<double> all(packed.size() * dealii::Utilities::MPI::n_mpi_processes(communicator));
  MPI_Allgather(packed.data(), 2 * dim, MPI_DOUBLE, all.data(), 2 * dim, MPI_DOUBLE, communicator);
  std::vector<contact::BoundingBox<dim>> boxes;
  for (std::size_t i = 0; i < all.size(); i += 2 * dim)
    boxes.push_back(take_box<dim>(&all[i]));
  return boxes;
}

template <int dim>
std::vector<double> pack(const Queries<dim> &queries, const contact::BoundingBox<dim> &region)
{
  std::vector<double> packed;
  for (const contact::FacetQuery<dim> &query : queries)
    if (query.box.intersects(region))
    {
      packed.push_back(query.body);
      append<dim>(query.box, packed);
    }
  return packed;
}

template <int dim>
Queries<dim> unpack(const std::vector<double> &packed)
{
  Queries<dim> queries;
  for (std::size_t i = 0; i < packed.size(); i += 1 + 2 * dim)
    queries.push_back({take_box<dim>(&packed[i + 1]), static_cast<unsigned int>(packed[i])});
  return queries;
}
} // namespace

template <int dim>
void hold_facets(const Queries<dim> &queries, const std::vector<contact::BoundingBox<dim>> &own_boxes,
                 const std::function<bool(unsigned int, unsigned int)> &is_allowed_pair,
                 const MPI_Comm &communicator, SurfaceMap<dim> &map)
{
  const std::vector<contact::BoundingBox<dim>> regions = gather_boxes<dim>(own_boxes, communicator);
  contact::BoundingBox<dim> asked;
  for (const contact::FacetQuery<dim> &query : queries)
    asked.extend(query.box);
  std::map<unsigned int, std::vector<double>> questions;
  for (unsigned int rank = 0; rank < regions.size(); ++rank)
    if (rank != dealii::Utilities::MPI::this_mpi_process(communicator) && asked.intersects(regions[rank]))
      if (std::vector<double> packed = pack<dim>(queries, regions[rank]); !packed.empty())
        questions[rank] = std::move(packed);
  std::map<unsigned int, std::vector<unsigned int>> given;
  for (const auto &[rank, packed] : dealii::Utilities::MPI::some_to_some(communicator, questions))
    given[rank] = contact::find_facets<dim>(map.surface(), own_boxes, unpack<dim>(packed), is_allowed_pair);
  map.exchange(given);
}

template <int dim>
std::vector<contact::BoundingBox<dim>> make_own_boxes(const SurfaceMap<dim> &map,
                                                      const std::vector<SpatialVector<dim>> &positions)
{
  std::vector<contact::BoundingBox<dim>> boxes;
  for (unsigned int f = 0; f < map.n_own_facets(); ++f)
    boxes.push_back(contact::make_facet_box(map.surface().facets[f], positions));
  return boxes;
}

template void hold_facets(const Queries<2> &, const std::vector<contact::BoundingBox<2>> &,
                          const std::function<bool(unsigned int, unsigned int)> &, const MPI_Comm &,
                          SurfaceMap<2> &);
template void hold_facets(const Queries<3> &, const std::vector<contact::BoundingBox<3>> &,
                          const std::function<bool(unsigned int, unsigned int)> &, const MPI_Comm &,
                          SurfaceMap<3> &);
template std::vector<contact::BoundingBox<2>> make_own_boxes(const SurfaceMap<2> &,
                                                             const std::vector<SpatialVector<2>> &);
template std::vector<contact::BoundingBox<3>> make_own_boxes(const SurfaceMap<3> &,
                                                             const std::vector<SpatialVector<3>> &);
} // namespace signorini
