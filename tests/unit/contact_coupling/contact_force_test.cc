// SPDX-License-Identifier: LGPL-2.1-or-later
#include "contact_bodies.h"

#include "signorini/physics/momentum.h"

using namespace signorini;
using namespace signorini::test;
using contact::Integration;

namespace
{
template <typename T>
class ContactForces : public testing::Test
{
};
TYPED_TEST_SUITE(ContactForces, AllCases);

TYPED_TEST(ContactForces, ForceIsEnergyGradient)
{
  constexpr int dim = TypeParam::dim;
  for (const Integration integration : {Integration::face_quadrature, Integration::face_segments})
  {
    BuiltScene<dim> built(make_overlapping_bodies<dim>(), TypeParam::degree);
    ASSERT_FALSE(built.discretization.hanging_dofs.empty());
    const auto contact = built.add_contact(make_settings(integration));
    const Vector u = built.random_vector(.01);
    built.state.displacement = u;
    contact->renew(built.state);
    ASSERT_GT(built.energy_of(*contact, u), 0.);
    expect_force_is_energy_gradient(built, *contact, u, 1e-6, 1e-6);
  }
}

TYPED_TEST(ContactForces, TangentIsForceGradient)
{
  constexpr int dim = TypeParam::dim;
  for (const Integration integration : {Integration::face_quadrature, Integration::face_segments})
  {
    BuiltScene<dim> built(make_overlapping_bodies<dim>(), TypeParam::degree);
    const auto contact = built.add_contact(make_settings(integration));
    const Vector u = built.random_vector(.01);
    built.state.displacement = u;
    contact->renew(built.state);
    expect_tangent_is_force_gradient(built, *contact, u, 1e-7, 1e-5);
  }
}

TYPED_TEST(ContactForces, ObstacleForceAndTangentAreDerivatives)
{
  constexpr int dim = TypeParam::dim;
  BodyParameters body = make_graded_cube();
  BuiltScene<dim> built({body}, TypeParam::degree,
                        [](Parameters &p)
                        {
                          ObstacleParameters sphere = make_floor<dim>(-1.9);
                          sphere.shape = ObstacleParameters::Shape::sphere;
                          sphere.radius = 2.;
                          p.obstacles = {sphere};
                        });
  const auto contact = built.add_contact(make_settings(Integration::face_quadrature));
  const Vector u = built.random_vector(.01);
  built.state.displacement = u;
  contact->renew(built.state);
  ASSERT_GT(built.energy_of(*contact, u), 0.);
  EXPECT_TRUE(contact->is_external);
  expect_force_is_energy_gradient(built, *contact, u);
  expect_tangent_is_force_gradient(built, *contact, u, 1e-7, 1e-5);
}

TYPED_TEST(ContactForces, ForcesOfBodiesBalance)
{
  constexpr int dim = TypeParam::dim;
  for (const Integration integration : {Integration::face_quadrature, Integration::face_segments})
  {
    BuiltScene<dim> built(make_overlapping_bodies<dim>(), TypeParam::degree);
    contact::PotentialSettings settings = make_settings(integration);
    settings.damping_ratio = .3;
    const auto contact = built.add_contact(settings);
    const Vector u = built.random_vector(.01);
    built.state.displacement = u;
    contact->renew(built.state);
    Vector force = built.force_of(*contact, u), damping = built.discretization.make_vector();
    const Vector velocity = built.random_vector(1., 7);
    const double power = contact->add_damping_force(velocity, damping);
    built.discretization.collect(damping);
    EXPECT_GT(power, 0.);
    EXPECT_NEAR(damping * velocity, -power, 1e-12 * power);
    for (const Vector *nodal : {&force, &damping})
    {
      const VectorAndMoment sums = sum_over_nodes(built.discretization, u, *nodal);
      ASSERT_GT(sums.vector_scale, 0.);
      for (unsigned int d = 0; d < 3; ++d)
      {
        EXPECT_LT(std::abs(sums.vector[d]), 1e-13 * sums.vector_scale);
        EXPECT_LT(std::abs(sums.moment[d]), 1e-12 * sums.moment_scale);
      }
    }
    const auto measures = contact->measure();
    EXPECT_LT((measures.resultants[0] + measures.resultants[1]).norm(),
              1e-13 * measures.resultants[0].norm());
  }
}

TYPED_TEST(ContactForces, PairForceIsTheSumOverItsBody)
{
  constexpr int dim = TypeParam::dim;
  BuiltScene<dim> built(make_overlapping_bodies<dim>(), TypeParam::degree);
  contact::PotentialSettings settings = make_settings(Integration::face_quadrature);
  settings.damping_ratio = .3;
  const auto contact = built.add_contact(settings);
  built.state.displacement = built.random_vector(.01);
  contact->renew(built.state);
  Vector force = built.force_of(*contact, built.state.displacement);
  for (const bool is_damped : {false, true})
  {
    if (is_damped)
    {
      built.state.velocity = built.random_vector(1., 7);
      Vector damping = built.discretization.make_vector();
      contact->add_damping_force(built.state.velocity, damping);
      built.discretization.collect(damping);
      ASSERT_GT(damping.l2_norm(), 1e-3 * force.l2_norm());
      force += damping;
    }
    SpatialVector<dim> sum = SpatialVector<dim>::Zero();
    for (const OwnedNode<dim> &node : built.discretization.owned_nodes)
      for (unsigned int d = 0; d < dim && node.body == 0; ++d)
        sum[d] += force.local_element(node.dofs[d]);
    const contact::PairForces<dim> pairs = contact->pair_forces(built.state);
    EXPECT_TRUE(pairs.obstacles.empty());
    ASSERT_EQ(pairs.bodies.size(), 1u);
    EXPECT_LT((pairs.bodies.at({0, 1}) - sum).norm(), 1e-12 * sum.norm());
  }
}

TYPED_TEST(ContactForces, OverlappingBlocksCarryStiffnessTimesDepth)
{
  // Two cells of one size, one exactly over the other: W = ½ k_A d² A with k_A = α/(h_c/E_c + h_t/E_t).
  constexpr int dim = TypeParam::dim;
  BodyParameters lower = make_box("lower", {1., 1., 1.}, {1, 1, 1}), upper = lower;
  upper.material.youngs_modulus = 4000.;
  upper.placement.shift[dim - 1] = 1. - .01;
  BuiltScene<dim> built({lower, upper}, TypeParam::degree);
  const auto contact = built.add_contact(make_settings(Integration::face_segments));
  contact->renew(built.state);
  const double stiffness = 10. / (1. / 1000. + 1. / 4000.);
  EXPECT_NEAR(built.energy_of(*contact, built.discretization.make_vector()), .5 * stiffness * 1e-4, 1e-12);
  EXPECT_NEAR(contact->measure().resultants[1][dim - 1], stiffness * .01, 1e-10);
}

/// Two blocks of one size, pressed together; the middle of the lower one's upper face is dented.
template <int dim>
std::vector<std::optional<double>> press_on_dent(BuiltScene<dim> &built, Integration integration)
{
  const auto contact = built.add_contact(make_settings(integration));
  built.state.displacement = built.interpolate(
      [](const SpatialVector<dim> &x)
      {
        SpatialVector<dim> u = SpatialVector<dim>::Zero();
        if (x[dim - 1] == 1. && (x.template head<dim - 1>().array() - .5).abs().maxCoeff() < .3)
          u[dim - 1] = -.02;
        return u;
      });
  contact->renew(built.state);
  contact->update(built.state);
  return contact->nodal_pressures();
}

TYPED_TEST(ContactForces, ANodeInAHoleHasNoPressureAndOneAwayFromContactHasNone)
{
  constexpr int dim = TypeParam::dim;
  for (const Integration integration : {Integration::face_quadrature, Integration::face_segments})
  {
    BodyParameters lower = make_box("lower", {1., 1., 1.}, {4, 4, 4}), upper = lower;
    upper.placement.shift[dim - 1] = 1. - .01;
    BuiltScene<dim> built({lower, upper}, TypeParam::degree);
    const std::vector<std::optional<double>> pressures = press_on_dent(built, integration);
    const ContactSurface<dim> &surface = built.map.surface();
    unsigned int n_in_hole = 0, n_pressed = 0, n_away = 0;
    for (unsigned int node = 0; node < surface.n_nodes(); ++node)
    {
      const SpatialVector<dim> x = surface.reference_positions[node] + surface.origin;
      const bool is_lower = node < surface.n_nodes() / 2;
      const double from_middle = (x.template head<dim - 1>().array() - .5).abs().maxCoeff();
      if (std::abs(x[dim - 1] - (is_lower ? 1. : .99)) > .2)
      {
        EXPECT_FALSE(pressures[node]);
        ++n_away;
      }
      else if (from_middle > .49 && is_lower == (x[dim - 1] > .995))
      {
        ASSERT_TRUE(pressures[node]);
        EXPECT_GT(*pressures[node], 0.);
        ++n_pressed;
      }
      else if (from_middle < .01)
      {
        ASSERT_TRUE(pressures[node]);
        EXPECT_EQ(*pressures[node], 0.);
        ++n_in_hole;
      }
    }
    EXPECT_EQ(n_in_hole, 2u);
    EXPECT_GT(n_pressed, 0u);
    EXPECT_GT(n_away, 0u);
  }
}

TYPED_TEST(ContactForces, NothingActsAtADistance)
{
  constexpr int dim = TypeParam::dim;
  BuiltScene<dim> built(make_overlapping_bodies<dim>(-.01), TypeParam::degree);
  const auto contact = built.add_contact(make_settings(Integration::face_quadrature));
  contact->renew(built.state);
  EXPECT_EQ(built.energy_of(*contact, built.discretization.make_vector()), 0.);
  EXPECT_EQ(built.force_of(*contact, built.discretization.make_vector()).l2_norm(), 0.);
}
} // namespace
