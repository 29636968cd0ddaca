// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/potential/coulomb_law.h"

#include "facet_samples.h"

#include <gtest/gtest.h>

namespace signorini::contact
{
namespace
{
using testing::Dice;

template <typename Dimension>
class CoulombLawTest : public ::testing::Test
{
};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(CoulombLawTest, Dimensions);

TYPED_TEST(CoulombLawTest, SticksInTheConeAndSlidesOnIt)
{
  constexpr int dim = TypeParam::value;
  Dice dice(1);
  const CoulombLaw law{.4, 50.};
  for (unsigned int trial = 0; trial < 100; ++trial)
  {
    const double pressure = dice.number(0., 10.);
    const SpatialVector<dim> slip = dice.point<dim>(-.2, .2);
    const SpatialVector<dim> elastic = law.find_elastic_slip(slip, pressure);
    const double traction = 50. * slip.norm(), most = .4 * pressure;
    if (traction <= most)
      EXPECT_EQ(elastic, slip);
    else
      EXPECT_LT((elastic - slip * (most / traction)).norm(), 1e-15);
    EXPECT_GE(elastic.dot(slip - elastic), 0.);
  }
  EXPECT_EQ((law.find_elastic_slip(SpatialVector<dim>::Ones().eval(), 0.)).norm(), 0.);
  EXPECT_EQ((law.find_elastic_slip(SpatialVector<dim>::Zero().eval(), 0.)).norm(), 0.);
}

TYPED_TEST(CoulombLawTest, DerivativesAreThoseOfDifferences)
{
  constexpr int dim = TypeParam::value;
  constexpr double step = 1e-6;
  Dice dice(2);
  const CoulombLaw law{.4, 50.};
  bool has_stuck = false, has_slid = false;
  for (unsigned int trial = 0; trial < 100; ++trial)
  {
    const double pressure = dice.number(1., 10.);
    const SpatialVector<dim> slip = dice.point<dim>(-.1, .1);
    if (std::abs(slip.norm() - law.limit(pressure)) < 1e-3)
      continue; // the kink
    (slip.norm() < law.limit(pressure) ? has_stuck : has_slid) = true;
    const SlipDerivatives<dim> derivatives = law.differentiate<dim>(slip, pressure);
    for (unsigned int d = 0; d < dim; ++d)
    {
      const SpatialVector<dim> way = step * SpatialVector<dim>::Unit(d);
      const SpatialVector<dim> slope = (law.find_elastic_slip(SpatialVector<dim>(slip + way), pressure) -
                                        law.find_elastic_slip(SpatialVector<dim>(slip - way), pressure)) /
                                       (2. * step);
      EXPECT_LT((slope - derivatives.by_trial.col(d)).norm(), 1e-6);
    }
    const SpatialVector<dim> slope =
        (law.find_elastic_slip(slip, pressure + step) - law.find_elastic_slip(slip, pressure - step)) /
        (2. * step);
    EXPECT_LT((slope - derivatives.by_pressure).norm(), 1e-8);
  }
  EXPECT_TRUE(has_stuck && has_slid);
}
} // namespace
} // namespace signorini::contact
