// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/physics/ledger.h"

#include <algorithm>
#include <cmath>

namespace signorini
{
namespace
{
double relative_difference(const std::array<double, 3> &now, const std::array<double, 3> &before,
                           const std::array<double, 3> &impulse, double scale)
{
  double squared = 0.;
  for (unsigned int d = 0; d < 3; ++d)
    squared += std::pow(now[d] - before[d] - impulse[d], 2);
  return scale > 0. ? std::sqrt(squared) / scale : 0.;
}
} // namespace

double EnergyLedger::imbalance() const
{
  return stored() + dissipated + dissipated_by_viscosity + plastic_work + rubbed_off + contact_loss -
         work_of_loads - work_of_supports - work_of_obstacles - contact_renewals - adaptation - initial;
}

void EnergyLedger::book_adaptation(double before)
{
  const double jump = stored() - before;
  adaptation += jump;
  max_adaptation = std::max(max_adaptation, std::abs(jump));
}

double EnergyLedger::residual() const
{
  return largest > 0. ? imbalance() / largest : 0.;
}

void EnergyLedger::note_scale()
{
  largest = std::max(largest, std::max(stored(), std::abs(work_of_loads) + std::abs(work_of_supports) +
                                                     std::abs(work_of_obstacles)));
}

double MomentumLedger::linear_drift() const
{
  return relative_difference(linear, initial_linear, linear_impulse, linear_scale);
}

double MomentumLedger::angular_drift() const
{
  return relative_difference(angular, initial_angular, angular_impulse, angular_scale);
}
} // namespace signorini
