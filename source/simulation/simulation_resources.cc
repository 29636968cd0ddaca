// SPDX-License-Identifier: LGPL-2.1-or-later
// What a Simulation takes of memory and of the ways between ranks.
#include "signorini/simulation/simulation.h"

#include "signorini/base/heap.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <algorithm>

namespace signorini
{
template <int dim>
double Simulation<dim>::memory_mb() const
{
  dealii::Utilities::System::MemoryStats memory;
  dealii::Utilities::System::get_memory_stats(memory);
  return dealii::Utilities::MPI::sum(static_cast<double>(memory.VmHWM), communicator) / 1024.;
}

template <int dim>
void Simulation<dim>::measure_distribution()
{
  const auto most = [this](auto number) { return dealii::Utilities::MPI::max(number, communicator); };
  const Traffic own = count_traffic() - traffic_of_setup;
  results.traffic = {most(own.n_messages), most(own.n_bytes), most(own.n_collectives),
                     most(own.n_collective_bytes)};
  if (!surface_map)
    return;
  results.n_facets = surface_map->n_all_facets();
  for (const auto &term : forces.surface_contacts)
    results.n_facets_held =
        std::max(results.n_facets_held, most(static_cast<unsigned int>(term->surface().facets.size())));
}

template <int dim>
void Simulation<dim>::weigh_parts()
{
  if (heap_in_use() == 0)
    return;
  std::size_t before = heap_in_use();
  const auto weigh = [&]()
  {
    const std::size_t after = heap_in_use(), freed = before - std::min(before, after);
    before = after;
    return dealii::Utilities::MPI::sum(static_cast<double>(freed), communicator);
  };
  typename Results<dim>::Memory memory;
  quasi_static_solver.reset();
  explicit_solver.reset();
  implicit_solver.reset();
  correction.reset();
  estimator.reset();
  memory.solver = weigh();
  forces.contacts.clear();
  forces.volume_contacts.clear();
  forces.surface_contacts.clear();
  forces.damped_contacts.clear();
  forces.moving_contacts.clear();
  forces.frictions.clear();
  surface_map.reset();
  volume_map.reset();
  memory.contact = weigh();
  memory.mesh = dealii::Utilities::MPI::sum(
      static_cast<double>(before - std::min(before, heap_before_set_up)), communicator);
  results.memory = memory;
}

template void Simulation<2>::weigh_parts();
template void Simulation<3>::weigh_parts();
template double Simulation<2>::memory_mb() const;
template double Simulation<3>::memory_mb() const;
template void Simulation<2>::measure_distribution();
template void Simulation<3>::measure_distribution();
} // namespace signorini
