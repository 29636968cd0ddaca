// SPDX-License-Identifier: LGPL-2.1-or-later
#include "machine_limits.h"

#include "peak.h"

#include "signorini/physics/vector_kernels.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace signorini
{
namespace
{
template <typename Action>
double seconds_of(const Action &action)
{
  const auto start = std::chrono::steady_clock::now();
  action();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Best of all repeats of each thread, added up; they work at the same time.
template <typename MeasureRate>
double add_up_best(unsigned int n_threads, const MeasureRate &measure_rate)
{
  std::vector<double> best(n_threads, 0.);
  std::vector<std::thread> threads;
  for (unsigned int t = 0; t < n_threads; ++t)
    threads.emplace_back([&, t]() { best[t] = measure_rate(); });
  double sum = 0.;
  for (unsigned int t = 0; t < n_threads; ++t)
  {
    threads[t].join();
    sum += best[t];
  }
  return sum;
}

double measure_triad()
{
  constexpr std::size_t n = 10'000'000;
  std::vector<double> a(n, 0.), b(n, 1.), c(n, 2.);
  double best = 0.;
  for (int repeat = 0; repeat < 12; ++repeat)
  {
    const double time = seconds_of(
        [&]()
        {
          double *to = a.data();
          const double *one = b.data(), *other = c.data();
          for (std::size_t i = 0; i < n; ++i)
            to[i] = one[i] + 3. * other[i];
          benchmark::ClobberMemory();
        });
    best = std::max(best, 24. * n / time);
  }
  return best;
}

RunPeak best_run_peak()
{
#ifdef __x86_64__
  const std::string best = best_vector_kernels<3>().instruction_set;
  if (best == "avx512")
    return avx512::run_peak;
  if (best == "avx2")
    return avx2::run_peak;
#endif
  return baseline::run_peak;
}

double measure_peak()
{
  const RunPeak run = best_run_peak();
  double best = 0., sink = 0.;
  for (int repeat = 0; repeat < 12; ++repeat)
  {
    double n_operations = 0.;
    const double time = seconds_of([&]() { n_operations = run(2'000'000, sink); });
    best = std::max(best, n_operations / time);
  }
  benchmark::DoNotOptimize(sink);
  return best;
}
} // namespace

const MachineLimits &measure_limits(unsigned int n_threads)
{
  static std::mutex mutex;
  static std::map<unsigned int, MachineLimits> known;
  const std::lock_guard<std::mutex> lock(mutex);
  const auto found = known.find(n_threads);
  if (found != known.end())
    return found->second;
  return known[n_threads] = {add_up_best(n_threads, measure_triad), add_up_best(n_threads, measure_peak)};
}
} // namespace signorini
