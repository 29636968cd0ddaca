// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

// Only for sources that are compiled once for each instruction set: the build gives its name and the number
// of lanes, and everything here is of that name alone.

#include <cstddef>
#include <cstdint>

#define ALWAYS_INLINE inline __attribute__((always_inline))

namespace signorini
{
namespace SIGNORINI_INSTRUCTION_SET
{
namespace
{
constexpr unsigned int n_lanes = SIGNORINI_LANES;
typedef double Lanes __attribute__((vector_size(8 * SIGNORINI_LANES), may_alias));
typedef std::int64_t Bits __attribute__((vector_size(8 * SIGNORINI_LANES)));
typedef double Row __attribute__((vector_size(32), may_alias)); ///< of nodal values

template <int dim>
using Tensor = Lanes[dim][dim];

ALWAYS_INLINE const Lanes &load(const double *values, int entry)
{
  return *reinterpret_cast<const Lanes *>(values + entry * n_lanes);
}

// Reading a node's row at once and turning rows into lanes halves the work of a cell with four nodes.
template <int dim>
ALWAYS_INLINE void gather(const unsigned int *nodes, const double *nodal, Lanes (&values)[dim])
{
  Row rows[n_lanes];
  for (unsigned int l = 0; l < n_lanes; ++l)
    rows[l] = *reinterpret_cast<const Row *>(nodal + 4 * static_cast<std::size_t>(nodes[l]));
#if SIGNORINI_LANES == 8
  Lanes both[4]; // rows l and l + 4
  for (int l = 0; l < 4; ++l)
    both[l] = __builtin_shufflevector(rows[l], rows[l + 4], 0, 1, 2, 3, 4, 5, 6, 7);
  const Lanes xz01 = __builtin_shufflevector(both[0], both[1], 0, 8, 2, 10, 4, 12, 6, 14),
              xz23 = __builtin_shufflevector(both[2], both[3], 0, 8, 2, 10, 4, 12, 6, 14),
              y01 = __builtin_shufflevector(both[0], both[1], 1, 9, 3, 11, 5, 13, 7, 15),
              y23 = __builtin_shufflevector(both[2], both[3], 1, 9, 3, 11, 5, 13, 7, 15);
  values[0] = __builtin_shufflevector(xz01, xz23, 0, 1, 8, 9, 4, 5, 12, 13);
  values[1] = __builtin_shufflevector(y01, y23, 0, 1, 8, 9, 4, 5, 12, 13);
  if constexpr (dim == 3)
    values[2] = __builtin_shufflevector(xz01, xz23, 2, 3, 10, 11, 6, 7, 14, 15);
#elif SIGNORINI_LANES == 4
  const Lanes xz01 = __builtin_shufflevector(rows[0], rows[1], 0, 4, 2, 6),
              xz23 = __builtin_shufflevector(rows[2], rows[3], 0, 4, 2, 6),
              y01 = __builtin_shufflevector(rows[0], rows[1], 1, 5, 3, 7),
              y23 = __builtin_shufflevector(rows[2], rows[3], 1, 5, 3, 7);
  values[0] = __builtin_shufflevector(xz01, xz23, 0, 1, 4, 5);
  values[1] = __builtin_shufflevector(y01, y23, 0, 1, 4, 5);
  if constexpr (dim == 3)
    values[2] = __builtin_shufflevector(xz01, xz23, 2, 3, 6, 7);
#else
  for (int i = 0; i < dim; ++i)
    values[i] = Lanes{rows[0][i], rows[1][i]};
#endif
}

// Lane after lane, for two of them may have the same node.
template <int dim>
ALWAYS_INLINE void scatter(const unsigned int *nodes, const Lanes (&values)[dim], double *nodal)
{
  const Lanes x = values[0], y = values[1], z = dim == 3 ? values[dim - 1] : Lanes{};
  Row rows[n_lanes];
#if SIGNORINI_LANES == 8
  const Lanes none = {}, xy02 = __builtin_shufflevector(x, y, 0, 8, 2, 10, 4, 12, 6, 14),
              xy13 = __builtin_shufflevector(x, y, 1, 9, 3, 11, 5, 13, 7, 15),
              z02 = __builtin_shufflevector(z, none, 0, 8, 2, 10, 4, 12, 6, 14),
              z13 = __builtin_shufflevector(z, none, 1, 9, 3, 11, 5, 13, 7, 15);
  const Lanes both[4] = {__builtin_shufflevector(xy02, z02, 0, 1, 8, 9, 4, 5, 12, 13),
                         __builtin_shufflevector(xy13, z13, 0, 1, 8, 9, 4, 5, 12, 13),
                         __builtin_shufflevector(xy02, z02, 2, 3, 10, 11, 6, 7, 14, 15),
                         __builtin_shufflevector(xy13, z13, 2, 3, 10, 11, 6, 7, 14, 15)};
  for (int l = 0; l < 4; ++l)
  {
    rows[l] = __builtin_shufflevector(both[l], both[l], 0, 1, 2, 3);
    rows[l + 4] = __builtin_shufflevector(both[l], both[l], 4, 5, 6, 7);
  }
#else
  for (unsigned int l = 0; l < n_lanes; ++l)
    rows[l] = Row{x[l], y[l], z[l], 0.};
#endif
  for (unsigned int l = 0; l < n_lanes; ++l)
    *reinterpret_cast<Row *>(nodal + 4 * static_cast<std::size_t>(nodes[l])) += rows[l];
}

/// x^(-1/3) to 3.5 %, for x > 0: exponent and leading bits divided by -3 as an integer.
ALWAYS_INLINE Lanes guess_inverse_cube_root(Lanes x)
{
  constexpr std::int64_t bits_of_two_to_52 = 0x4330000000000000; // plus n: the number 2^52 + n
  constexpr double two_to_52 = 4503599627370496., start = 1430187664.;
  const Lanes upper_half = reinterpret_cast<Lanes>((reinterpret_cast<Bits>(x) >> 32) | bits_of_two_to_52);
  const Lanes guess = start - (upper_half - two_to_52) * (1. / 3.);
  return reinterpret_cast<Lanes>(reinterpret_cast<Bits>(guess + two_to_52) << 32);
}

/// By what an approximation y of x^(-1/3) is to be multiplied, less 1, where r = 1 − x y³; this takes the
/// error to its fourth power.
ALWAYS_INLINE Lanes correction_of_inverse_cube_root(Lanes r)
{
  return r * (1. / 3. + r * (2. / 9. + r * (14. / 81.)));
}

/// Not a number unless x > 0.
ALWAYS_INLINE Lanes only_if_positive(Lanes x, Lanes value)
{
  const Lanes zero = {};
  return x > 0. ? value : zero / zero;
}

/// x^(-1/3); not a number unless x > 0.
ALWAYS_INLINE Lanes inverse_cube_root(Lanes x)
{
  Lanes y = guess_inverse_cube_root(x);
  for (int iteration = 0; iteration < 2; ++iteration)
    y += y * correction_of_inverse_cube_root(1. - (x * y) * (y * y));
  return only_if_positive(x, y);
}

/// (1 + e)^(-1/3) − 1 to full relative accuracy; not a number unless e > -1.
ALWAYS_INLINE Lanes inverse_cube_root_less_one(Lanes e)
{
  Lanes less_one = guess_inverse_cube_root(1. + e) - 1.;
  for (int iteration = 0; iteration < 3; ++iteration)
  {
    const Lanes cube_less_one = less_one * (3. + less_one * (3. + less_one));
    const Lanes r = -(e + cube_less_one + e * cube_less_one);
    less_one += (1. + less_one) * correction_of_inverse_cube_root(r);
  }
  return only_if_positive(1. + e, less_one);
}
} // namespace
} // namespace SIGNORINI_INSTRUCTION_SET
} // namespace signorini
