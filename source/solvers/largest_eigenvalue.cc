// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/solvers/largest_eigenvalue.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace signorini
{
double find_largest_eigenvalue(const Eigen::MatrixXd &symmetric)
{
  constexpr double round_off = 1e-15;
  constexpr unsigned int max_n_steps = 100;
  const Eigen::Index n = symmetric.rows();
  const Eigen::Tridiagonalization<Eigen::MatrixXd> tridiagonal(symmetric);
  const Eigen::VectorXd diagonal = tridiagonal.diagonal(), beside = tridiagonal.subDiagonal();
  double bound = diagonal[0], scale = 0.; // by the discs of Gershgorin
  for (Eigen::Index i = 0; i < n; ++i)
  {
    const double radius = (i > 0 ? std::abs(beside[i - 1]) : 0.) + (i + 1 < n ? std::abs(beside[i]) : 0.);
    bound = std::max(bound, diagonal[i] + radius);
    scale = std::max(scale, std::abs(diagonal[i]) + radius);
  }
  double x = bound + 1e-3 * scale;
  for (unsigned int step = 0; step < max_n_steps && scale > 0.; ++step)
  {
    // The quotients q_i of the leading minors of A − xI, and their derivatives over q_i.
    double q = 1., first = 0., second = 0., sum = 0., sum_of_squares = 0.;
    for (Eigen::Index i = 0; i < n; ++i)
    {
      const double part = i > 0 ? beside[i - 1] * beside[i - 1] / q : 0.;
      q = diagonal[i] - x - part;
      if (!(q < 0.))
        return x; // to round-off
      second = part * (second - 2. * first * first) / q;
      first = (part * first - 1.) / q;
      sum += first;
      sum_of_squares += first * first - second;
    }
    const double size = static_cast<double>(n);
    const double down =
        size / (sum + std::sqrt(std::max(0., (size - 1.) * (size * sum_of_squares - sum * sum))));
    x -= down;
    if (down <= round_off * scale)
      break;
  }
  return x;
}
} // namespace signorini
