// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/physics/ledger.h"

#include <gtest/gtest.h>

using namespace signorini;

namespace
{
TEST(EnergyLedger, ImbalanceCountsEveryEntryOnceWithItsSign)
{
  EnergyLedger ledger;
  EXPECT_EQ(ledger.imbalance(), 0.);
  ledger.kinetic = 1.;
  ledger.elastic = 2.;
  ledger.contact = 4.;
  ledger.dissipated = 8.;
  EXPECT_DOUBLE_EQ(ledger.imbalance(), 15.);
  ledger.work_of_loads = 16.;
  ledger.work_of_supports = 32.;
  ledger.contact_renewals = 64.;
  ledger.initial = 128.;
  ledger.adaptation = 256.;
  EXPECT_DOUBLE_EQ(ledger.imbalance(), 15. - 16. - 32. - 64. - 128. - 256.);
}

TEST(EnergyLedger, AdaptationsAreSummedAndTheLargestJumpIsKept)
{
  EnergyLedger ledger;
  ledger.kinetic = 6.;
  ledger.elastic = 2.;
  ledger.book_adaptation(11.);
  ledger.book_adaptation(7.);
  EXPECT_DOUBLE_EQ(ledger.adaptation, -2.);
  EXPECT_DOUBLE_EQ(ledger.max_adaptation, 3.);
}

TEST(EnergyLedger, ResidualIsRelativeToTheLargestSumSeen)
{
  EnergyLedger ledger;
  EXPECT_EQ(ledger.residual(), 0.);
  ledger.kinetic = 6.;
  ledger.contact = 2.;
  ledger.initial = 8.;
  ledger.note_scale();
  EXPECT_DOUBLE_EQ(ledger.largest, 8.);
  ledger.kinetic = 1.;
  ledger.note_scale();
  EXPECT_DOUBLE_EQ(ledger.largest, 8.) << "the scale must not shrink";
  EXPECT_DOUBLE_EQ(ledger.residual(), -5. / 8.);
  ledger.work_of_loads = -12.;
  ledger.work_of_supports = 4.;
  ledger.note_scale();
  EXPECT_DOUBLE_EQ(ledger.largest, 16.) << "works of opposite sign must not cancel";
}

TEST(MomentumLedger, DriftIsWhatImpulsesDoNotExplain)
{
  MomentumLedger ledger;
  EXPECT_EQ(ledger.linear_drift(), 0.);
  ledger.initial_linear = {1., 2., 3.};
  ledger.linear_impulse = {10., 20., 30.};
  ledger.linear = {11., 25., 37.};
  ledger.linear_scale = 50.;
  EXPECT_DOUBLE_EQ(ledger.linear_drift(), 5. / 50.);
  ledger.initial_angular = {0., 0., 7.};
  ledger.angular_impulse = {0., 0., -2.};
  ledger.angular = {0., 0., 5.};
  ledger.angular_scale = 10.;
  EXPECT_DOUBLE_EQ(ledger.angular_drift(), 0.);
  ledger.angular[0] = 1.;
  EXPECT_DOUBLE_EQ(ledger.angular_drift(), .1);
}
} // namespace
