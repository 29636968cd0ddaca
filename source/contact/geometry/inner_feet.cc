// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/geometry/inner_feet.h"

#include <algorithm>
#include <cmath>

// The compiler makes find_inner_feet() for several vector units, with all that is inlined into it, and takes
// the best that the machine has.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define SIGNORINI_FOR_VECTOR_UNITS                                                                           \
  __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#define SIGNORINI_INLINE inline __attribute__((always_inline))
#else
#define SIGNORINI_FOR_VECTOR_UNITS
#define SIGNORINI_INLINE inline
#endif

namespace signorini::contact
{
namespace
{
constexpr int size = InnerFeetBatch::size;
constexpr double never = 1e300;
using Numbers = InnerFeetBatch::Numbers;

/// r(s) = y − x = c_0 + c_1 s_0 + c_2 s_1 + c_3 s_0 s_1
struct Patches
{
  Numbers c[4][3];
};

/// ½|r|² = Σ q_ij s_0^i s_1^j and, of it, how fast Newton's method converges; see bound_contraction().
struct Polynomials
{
  Numbers q10, q01, q11, q20, q02, q21, q12, q22, contraction;
};

SIGNORINI_INLINE void make_patches(const InnerFeetBatch &batch, Patches &patches)
{
  for (int d = 0; d < 3; ++d)
    for (int i = 0; i < size; ++i)
    {
      const double low = batch.node[0][d][i] + batch.node[1][d][i] - 2. * batch.point[d][i],
                   high = batch.node[2][d][i] + batch.node[3][d][i] - 2. * batch.point[d][i],
                   low_slope = batch.node[1][d][i] - batch.node[0][d][i],
                   high_slope = batch.node[3][d][i] - batch.node[2][d][i];
      patches.c[0][d][i] = .25 * (low + high);
      patches.c[1][d][i] = .25 * (low_slope + high_slope);
      patches.c[2][d][i] = .25 * (high - low);
      patches.c[3][d][i] = .25 * (high_slope - low_slope);
    }
}

SIGNORINI_INLINE void make_polynomials(const Patches &patches, Polynomials &q)
{
  for (int i = 0; i < size; ++i)
  {
    const auto product = [&](int a, int b)
    {
      return patches.c[a][0][i] * patches.c[b][0][i] + patches.c[a][1][i] * patches.c[b][1][i] +
             patches.c[a][2][i] * patches.c[b][2][i];
    };
    q.q10[i] = product(0, 1);
    q.q01[i] = product(0, 2);
    q.q11[i] = product(0, 3) + product(1, 2);
    q.q20[i] = .5 * product(1, 1);
    q.q02[i] = .5 * product(2, 2);
    q.q21[i] = product(1, 3);
    q.q12[i] = product(2, 3);
    q.q22[i] = .5 * product(3, 3);
    const double drift_00 = 2. * (std::abs(q.q21[i]) + q.q22[i]),
                 drift_11 = 2. * (std::abs(q.q12[i]) + q.q22[i]),
                 drift_01 = 2. * (std::abs(q.q21[i]) + std::abs(q.q12[i])) + 4. * q.q22[i],
                 low_00 = 2. * q.q20[i] - drift_00, low_11 = 2. * q.q02[i] - drift_11,
                 high_01 = std::abs(q.q11[i]) + drift_01, low = low_00 * low_11 - high_01 * high_01;
    const bool is_convex = (low_00 > 0.) & (low_11 > 0.) & (low > 0.);
    const double sum =
        drift_00 * low_11 + drift_11 * low_00 + 2. * drift_01 * std::sqrt(std::abs(low_00 * low_11));
    q.contraction[i] = is_convex ? 4. * sum / low : never;
  }
}

/// Newton's method from the middles; tells the square of each last step.
SIGNORINI_INLINE void minimise(const Polynomials &q, InnerFeetBatch &batch, Numbers &last_step)
{
  constexpr int max_n_steps = 4;
  for (int i = 0; i < size; ++i)
    batch.s[0][i] = batch.s[1][i] = 0.;
  for (int step = 0; step < max_n_steps; ++step)
  {
    Numbers errors;
    for (int i = 0; i < size; ++i)
    {
      const double s0 = batch.s[0][i], s1 = batch.s[1][i];
      const double g0 = q.q10[i] + 2. * q.q20[i] * s0 +
                        s1 * (q.q11[i] + 2. * q.q21[i] * s0 + s1 * (q.q12[i] + 2. * q.q22[i] * s0)),
                   g1 = q.q01[i] + 2. * q.q02[i] * s1 +
                        s0 * (q.q11[i] + 2. * q.q12[i] * s1 + s0 * (q.q21[i] + 2. * q.q22[i] * s1)),
                   h00 = 2. * (q.q20[i] + s1 * (q.q21[i] + s1 * q.q22[i])),
                   h11 = 2. * (q.q02[i] + s0 * (q.q12[i] + s0 * q.q22[i])),
                   h01 = q.q11[i] + 2. * (q.q21[i] * s0 + q.q12[i] * s1) + 4. * q.q22[i] * s0 * s1;
      const double scale = -1. / (h00 * h11 - h01 * h01), p0 = scale * (h11 * g0 - h01 * g1),
                   p1 = scale * (h00 * g1 - h01 * g0);
      // What is there stays, so that no point depends on the others of the batch.
      const bool is_there = (step > 0) & (q.contraction[i] * last_step[i] < 1e-18);
      batch.s[0][i] = is_there ? s0 : s0 + p0;
      batch.s[1][i] = is_there ? s1 : s1 + p1;
      last_step[i] = is_there ? last_step[i] : p0 * p0 + p1 * p1;
      errors[i] = q.contraction[i] < never ? q.contraction[i] * last_step[i] : 0.;
    }
    if (!std::any_of(errors, errors + size, [](double error) { return error >= 1e-18; }))
      break;
  }
}

SIGNORINI_INLINE void judge(const Patches &patches, const Polynomials &q, const Numbers &last_step,
                            InnerFeetBatch &batch)
{
  constexpr double margin = 1e-6;
  for (int i = 0; i < size; ++i)
  {
    const double s0 = batch.s[0][i], s1 = batch.s[1][i];
    double r[3], t0[3], t1[3];
    for (int d = 0; d < 3; ++d)
    {
      t0[d] = patches.c[1][d][i] + s1 * patches.c[3][d][i];
      t1[d] = patches.c[2][d][i] + s0 * patches.c[3][d][i];
      r[d] = patches.c[0][d][i] + s1 * patches.c[2][d][i] + s0 * t0[d];
    }
    const double n0 = t0[1] * t1[2] - t0[2] * t1[1], n1 = t0[2] * t1[0] - t0[0] * t1[2],
                 n2 = t0[0] * t1[1] - t0[1] * t1[0], scale = 1. / std::sqrt(n0 * n0 + n1 * n1 + n2 * n2);
    batch.normal[0][i] = scale * n0;
    batch.normal[1][i] = scale * n1;
    batch.normal[2][i] = scale * n2;
    batch.depth[i] = scale * (r[0] * n0 + r[1] * n1 + r[2] * n2);
    const bool is_inner = (q.contraction[i] * last_step[i] < 1e-18) & (std::abs(s0) < 1. - margin) &
                          (std::abs(s1) < 1. - margin) & (s0 + s1 < batch.rim[i] - margin);
    batch.is_inner[i] = is_inner ? 1. : 0.;
  }
}
} // namespace

SIGNORINI_FOR_VECTOR_UNITS
void find_inner_feet(InnerFeetBatch &batch)
{
  Patches patches;
  make_patches(batch, patches);
  Polynomials polynomials;
  make_polynomials(patches, polynomials);
  Numbers last_step;
  minimise(polynomials, batch, last_step);
  judge(patches, polynomials, last_step, batch);
}
} // namespace signorini::contact
