// SPDX-License-Identifier: LGPL-2.1-or-later
// What a Simulation takes of memory and of the ways between ranks.
#include "signorini/simulation/simulation.h"

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

template double Simulation<2>::memory_mb() const;
template double Simulation<3>::memory_mb() const;
template void Simulation<2>::measure_distribution();
template void Simulation<3>::measure_distribution();
} // namespace signorini
