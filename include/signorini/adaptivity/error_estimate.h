// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace signorini
{
/// Squares of estimated errors in the energy norm, in two parts [J; J/m in 2-D].
struct ErrorEstimate
{
  std::vector<double> cell_discretization; ///< [own cell]
  std::vector<double> cell_contact;        ///< [own cell] of its facets and overlaps
  std::vector<bool> is_contact_unseen;     ///< [own cell] it may be in contact but is too large to tell
  bool is_any_contact_unseen = false;      ///< in any cell of any rank
  double discretization = 0.;              ///< of all cells of all ranks
  double contact = 0.;
  double energy = 0.; ///< twice the elastic energy: the square of the solution's own norm

  /// Of a state without load: what is left is round-off.
  void forget_errors()
  {
    std::fill(cell_discretization.begin(), cell_discretization.end(), 0.);
    std::fill(cell_contact.begin(), cell_contact.end(), 0.);
    discretization = contact = 0.;
  }

  double total() const { return discretization + contact; }

  /// √(squared / (energy + discretization)): an error over the norm of the solution.
  double relative(double squared) const
  {
    const double scale = energy + discretization;
    return scale > 0. ? std::sqrt(squared / scale) : 0.;
  }
};
} // namespace signorini
