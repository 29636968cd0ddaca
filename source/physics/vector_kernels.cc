// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/physics/vector_kernels.h"

#include <vector>

namespace signorini
{
// Made by vector_kernels_lanes.cc.
namespace baseline
{
template <int dim>
const VectorKernels<dim> &vector_kernels();
}
namespace avx2
{
template <int dim>
const VectorKernels<dim> &vector_kernels();
}
namespace avx512
{
template <int dim>
const VectorKernels<dim> &vector_kernels();
}

namespace
{
template <int dim>
std::vector<const VectorKernels<dim> *> find_runnable()
{
  std::vector<const VectorKernels<dim> *> runnable;
#ifdef __x86_64__
  __builtin_cpu_init();
  const bool has_avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (has_avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512dq"))
    runnable.push_back(&avx512::vector_kernels<dim>());
  if (has_avx2)
    runnable.push_back(&avx2::vector_kernels<dim>());
#endif
  runnable.push_back(&baseline::vector_kernels<dim>());
  return runnable;
}
} // namespace

template <int dim>
const VectorKernels<dim> *const *all_vector_kernels(unsigned int &n)
{
  static const std::vector<const VectorKernels<dim> *> all = find_runnable<dim>();
  n = static_cast<unsigned int>(all.size());
  return all.data();
}

template <int dim>
const VectorKernels<dim> &best_vector_kernels()
{
  unsigned int n = 0;
  return *all_vector_kernels<dim>(n)[0];
}

template const VectorKernels<2> *const *all_vector_kernels<2>(unsigned int &);
template const VectorKernels<3> *const *all_vector_kernels<3>(unsigned int &);
template const VectorKernels<2> &best_vector_kernels<2>();
template const VectorKernels<3> &best_vector_kernels<3>();
} // namespace signorini
