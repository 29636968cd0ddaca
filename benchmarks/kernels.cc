// SPDX-License-Identifier: LGPL-2.1-or-later
// Rates of the elastic kernels beside what the machine can do at most, all measured in this one run: the
// bandwidth of the triad a = b + s c and the rate of fused multiplications and additions, on as many threads.
#include "block_of_cells.h"
#include "machine_limits.h"

#include <benchmark/benchmark.h>
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <limits>

namespace
{
using namespace signorini;

/// Counted by hand from vector_kernels_lanes.cc; a fused multiplication and addition is two.
struct Operations
{
  double simplex, hypercube;
};
constexpr Operations of_linear_elastic{133., 1500.}, of_neo_hookean{316., 2970.};

struct Case
{
  const char *name;
  BlockOfCells::Shape shape;
  VectorKernels<3>::AddForce kernel;
  double n_operations; ///< of a cell
};

/// Every thread has its own block, as every rank has its own cells.
void run_kernel(benchmark::State &state, const Case &what, unsigned int n_lanes)
{
  const BlockOfCells block(what.shape, n_lanes);
  double least_time = std::numeric_limits<double>::infinity();
  for (auto _ : state)
  {
    const auto start = std::chrono::steady_clock::now();
    what.kernel(block.batches(), block.displacement(), block.force());
    least_time =
        std::min(least_time, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  using benchmark::Counter;
  const double n_threads = state.threads(), rate = block.n_cells() / least_time;
  const MachineLimits &limits = measure_limits(static_cast<unsigned int>(state.threads()));
  const double attainable =
      std::min(limits.bandwidth / block.bytes_per_cell(), limits.peak / what.n_operations) / n_threads;
  // Counters of threads are added up.
  state.counters["Mcells/s"] = Counter(rate / 1e6);
  state.counters["GB/s"] = Counter(rate * block.bytes_per_cell() / 1e9);
  state.counters["of_triad"] = Counter(rate * block.bytes_per_cell() / limits.bandwidth);
  state.counters["of_peak"] = Counter(rate * what.n_operations / limits.peak);
  state.counters["of_roofline"] = Counter(rate / attainable / n_threads);
}
} // namespace

int main(int argc, char **argv)
{
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv))
    return 2;
  for (const int n_threads : {1, 2})
  {
    const MachineLimits &limits = measure_limits(static_cast<unsigned int>(n_threads));
    fmt::print("{} thread{}: triad {:.1f} GB/s, peak {:.1f} Gflop/s with {}\n", n_threads,
               n_threads == 1 ? "" : "s", limits.bandwidth / 1e9, limits.peak / 1e9,
               best_vector_kernels<3>().instruction_set);
  }
  unsigned int n_sets = 0;
  const VectorKernels<3> *const *all = all_vector_kernels<3>(n_sets);
  for (unsigned int set = 0; set < n_sets; ++set)
    for (const Case &what : {Case{"tetrahedra/linear elastic", BlockOfCells::Shape::simplices,
                                  all[set]->simplex.linear_elastic.add_force, of_linear_elastic.simplex},
                             Case{"tetrahedra/neo-Hookean", BlockOfCells::Shape::simplices,
                                  all[set]->simplex.neo_hookean.add_force, of_neo_hookean.simplex},
                             Case{"hexahedra/linear elastic", BlockOfCells::Shape::hypercubes,
                                  all[set]->hypercube.linear_elastic.add_force, of_linear_elastic.hypercube},
                             Case{"hexahedra/neo-Hookean", BlockOfCells::Shape::hypercubes,
                                  all[set]->hypercube.neo_hookean.add_force, of_neo_hookean.hypercube}})
      for (const int n_threads : {1, 2})
        if (set == 0 || n_threads == 1)
          benchmark::RegisterBenchmark(fmt::format("{}/{}", all[set]->instruction_set, what.name).c_str(),
                                       run_kernel, what, all[set]->n_lanes)
              ->Threads(n_threads)
              ->UseRealTime()
              ->Unit(benchmark::kMillisecond);
  benchmark::RunSpecifiedBenchmarks();
}
