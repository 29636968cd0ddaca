// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/physics/ledger.h"
#include "signorini/physics/state.h"

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

protected:
  /// Makes the present values of the ledgers the initial ones.
  void open_ledgers()
  {
    energy_ledger.initial = energy_ledger.stored();
    momentum_ledger.initial_linear = momentum_ledger.linear;
    momentum_ledger.initial_angular = momentum_ledger.angular;
  }

  EnergyLedger energy_ledger;
  MomentumLedger momentum_ledger;
};
} // namespace signorini
