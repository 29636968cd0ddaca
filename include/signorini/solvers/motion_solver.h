// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/physics/ledger.h"
#include "signorini/physics/momentum.h"
#include "signorini/physics/state.h"

#include <algorithm>

namespace signorini
{
/// What moves bodies with mass and keeps the ledgers of their energy and momentum.
template <int dim>
class MotionSolver
{
public:
  virtual ~MotionSolver() = default;

  /// Brings the energies and momenta of the ledgers up to the present state.
  virtual void take_stock(const State &state) = 0;

  const EnergyLedger &energy() const { return energy_ledger; }
  const MomentumLedger &momentum() const { return momentum_ledger; }

  /// The ledgers, for boost's archives.
  template <typename Archive>
  void serialize(Archive &archive, unsigned int /*version*/)
  {
    archive &energy_ledger &momentum_ledger;
  }

protected:
  /// Makes the present values of the ledgers the initial ones.
  void open_ledgers()
  {
    energy_ledger.initial = energy_ledger.stored();
    momentum_ledger.initial_linear = momentum_ledger.linear;
    momentum_ledger.initial_angular = momentum_ledger.angular;
  }

  /// Takes the present momenta into the ledger.
  void note_momentum(const VectorAndMoment &momentum)
  {
    momentum_ledger.linear = momentum.vector;
    momentum_ledger.angular = momentum.moment;
    momentum_ledger.linear_scale = std::max(momentum_ledger.linear_scale, momentum.vector_scale);
    momentum_ledger.angular_scale = std::max(momentum_ledger.angular_scale, momentum.moment_scale);
  }

  /// Books an impulse from outside: `factor` times this.
  void book_impulse(const VectorAndMoment &impulse, double factor = 1.)
  {
    for (unsigned int d = 0; d < 3; ++d)
    {
      momentum_ledger.linear_impulse[d] += factor * impulse.vector[d];
      momentum_ledger.angular_impulse[d] += factor * impulse.moment[d];
    }
  }

  EnergyLedger energy_ledger;
  MomentumLedger momentum_ledger;
};
} // namespace signorini
