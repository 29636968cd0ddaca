// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/friction/facet_turn.h"

#include "facet_samples.h"

#include <gtest/gtest.h>

namespace signorini::contact
{
namespace
{
using testing::Dice;

template <typename Dimension>
class FacetTurnTest : public ::testing::Test
{
};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(FacetTurnTest, Dimensions);

template <int dim>
FacetNodes<dim> moved_facet(FacetNodes<dim> nodes, const SpatialTensor<dim> &rotation,
                            const SpatialVector<dim> &shift)
{
  for (unsigned int a = 0; a < nodes.n_nodes(); ++a)
    nodes.position[a] = rotation * nodes.position[a] + shift;
  return nodes;
}

TYPED_TEST(FacetTurnTest, RigidMotionGivesItsOwnRotation)
{
  constexpr int dim = TypeParam::value;
  Dice dice(1);
  for (const FacetElement<dim> &element : testing::all_elements<dim>())
    for (unsigned int trial = 0; trial < 20; ++trial)
    {
      const FacetNodes<dim> nodes = testing::make_warped_facet(element, .1, dice);
      const LocalPoint<dim> xi = testing::make_local_point(element, .1, dice);
      const SpatialTensor<dim> rotation = dice.rotation<dim>();
      const FacetBasis<dim> before(nodes, xi),
          now(moved_facet<dim>(nodes, rotation, dice.point<dim>(-2., 2.)), xi);
      EXPECT_LT((find_turn(before, now) - rotation).norm(), 1e-12);
    }
}

/// A rotation that leaves a symmetric stretch and takes normal to normal.
TYPED_TEST(FacetTurnTest, DeformedFacetsTurnByARotation)
{
  constexpr int dim = TypeParam::value;
  Dice dice(5);
  for (const FacetElement<dim> &element : testing::all_elements<dim>())
    for (unsigned int trial = 0; trial < 20; ++trial)
    {
      const LocalPoint<dim> xi = testing::make_local_point(element, .1, dice);
      const FacetBasis<dim> before(testing::make_warped_facet(element, .1, dice), xi),
          now(testing::make_warped_facet(element, .1, dice), xi);
      const SpatialTensor<dim> turn = find_turn(before, now);
      EXPECT_LT((turn.transpose() * turn - SpatialTensor<dim>::Identity()).norm(), 1e-12);
      EXPECT_LT((turn * before.normal - now.normal).norm(), 1e-12);
      SpatialTensor<dim> stretch = SpatialTensor<dim>::Zero();
      for (unsigned int i = 0; i < dim - 1; ++i)
        stretch += turn.transpose() * now.tangent[i] * before.dual[i].transpose();
      EXPECT_LT((stretch - stretch.transpose()).norm(), 1e-12);
    }
}

TYPED_TEST(FacetTurnTest, CoupleHasItsMomentAndNoResultant)
{
  constexpr int dim = TypeParam::value;
  Dice dice(2);
  for (const FacetElement<dim> &element : testing::all_elements<dim>())
    for (unsigned int trial = 0; trial < 20; ++trial)
    {
      const FacetNodes<dim> nodes = testing::make_warped_facet(element, .1, dice);
      const FacetBasis<dim> basis(nodes, testing::make_local_point(element, .1, dice));
      const SpatialVector<dim> arm = dice.point<dim>(-1., 1.), force = dice.point<dim>(-1., 1.);
      const SpatialTensor<dim> couple = force * arm.transpose() - arm * force.transpose();
      SpatialVector<dim> sum = SpatialVector<dim>::Zero();
      SpatialTensor<dim> moment = SpatialTensor<dim>::Zero();
      for (unsigned int b = 0; b < nodes.n_nodes(); ++b)
      {
        const SpatialVector<dim> of_node = couple_force(basis, b, couple);
        sum += of_node;
        moment += of_node * nodes.position[b].transpose() - nodes.position[b] * of_node.transpose();
      }
      EXPECT_LT(sum.norm(), 1e-12);
      EXPECT_LT((moment - couple).norm(), 1e-12);
    }
}

/// The power of the couple's forces is that of the force on the arm as the facet turns it.
TYPED_TEST(FacetTurnTest, CoupleIsTheTransposeOfTheTurn)
{
  constexpr int dim = TypeParam::value;
  constexpr double step = 1e-6;
  Dice dice(3);
  for (const FacetElement<dim> &element : testing::all_elements<dim>())
    for (unsigned int trial = 0; trial < 20; ++trial)
    {
      const FacetNodes<dim> nodes = testing::make_warped_facet(element, .1, dice);
      const LocalPoint<dim> xi = testing::make_local_point(element, .1, dice);
      const FacetBasis<dim> basis(nodes, xi);
      const SpatialVector<dim> arm = dice.point<dim>(-1., 1.), force = dice.point<dim>(-1., 1.);
      const SpatialTensor<dim> couple = force * arm.transpose() - arm * force.transpose();
      FacetNodes<dim> forth = nodes, back = nodes;
      double power = 0.;
      for (unsigned int b = 0; b < nodes.n_nodes(); ++b)
      {
        const SpatialVector<dim> velocity = dice.point<dim>(-1., 1.);
        forth.position[b] += step * velocity;
        back.position[b] -= step * velocity;
        power += velocity.dot(couple_force(basis, b, couple));
      }
      const SpatialTensor<dim> spin =
          (find_turn(basis, FacetBasis<dim>(forth, xi)) - find_turn(basis, FacetBasis<dim>(back, xi))) /
          (2. * step);
      EXPECT_NEAR(power, force.dot(spin * arm), 1e-7 * (1. + std::abs(power)));
    }
}

TYPED_TEST(FacetTurnTest, ShortestTurnKeepsLengthAndBothPlanes)
{
  constexpr int dim = TypeParam::value;
  Dice dice(4);
  for (unsigned int trial = 0; trial < 50; ++trial)
  {
    const SpatialVector<dim> from = dice.rotation<dim>() * SpatialVector<dim>::Unit(0),
                             to = dice.rotation<dim>() * SpatialVector<dim>::Unit(0);
    SpatialVector<dim> slip = dice.point<dim>(-1., 1.);
    slip -= from.dot(slip) * from;
    const SpatialVector<dim> turned = turn_to_plane<dim>(slip, from, to);
    EXPECT_NEAR(turned.norm(), slip.norm(), 1e-12);
    EXPECT_NEAR(turned.dot(to), 0., 1e-12);
    EXPECT_LT((turn_to_plane<dim>(turned, to, from) - slip).norm(), 1e-11);
    EXPECT_LT((turn_to_plane<dim>(slip, from, from) - slip).norm(), 1e-15);
    EXPECT_EQ(turn_to_plane<dim>(slip, from, SpatialVector<dim>(-from)).norm(), 0.);
  }
}
} // namespace
} // namespace signorini::contact
