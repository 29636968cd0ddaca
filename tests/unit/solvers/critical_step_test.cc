// SPDX-License-Identifier: LGPL-2.1-or-later
#include "contact_bodies.h"

#include <Eigen/Eigenvalues>

using namespace signorini;
using namespace signorini::test;

namespace
{
/// Largest eigenvalue of (tangent, lumped mass) over free entries.
template <int dim>
double largest_frequency_squared(BuiltScene<dim> &built, const std::vector<ForceTerm *> &terms)
{
  for (ForceTerm *term : terms)
    term->update(built.state);
  const Eigen::MatrixXd tangent = assemble_tangent(built, terms);
  const Vector mass = make_lumped_mass(built.scene.materials, built.discretization);
  Eigen::VectorXd scale = Eigen::VectorXd::Zero(tangent.rows());
  for (const unsigned int dof : built.free_dofs())
    scale[dof] = 1. / std::sqrt(mass.local_element(dof));
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(
      scale.asDiagonal() * tangent * scale.asDiagonal(), Eigen::EigenvaluesOnly);
  return eigen.eigenvalues().maxCoeff();
}

template <typename T>
class CriticalStep : public testing::Test
{
};
TYPED_TEST_SUITE(CriticalStep, AllCases);

TYPED_TEST(CriticalStep, BulkBoundIsSafeAndNotWasteful)
{
  constexpr int dim = TypeParam::dim;
  BodyParameters ball = make_ball("ball", .8, 0);
  ball.placement.shift = {3., 0., 0.};
  for (const double poissons_ratio : {.1, .45})
  {
    BodyParameters cube = make_graded_cube({1., 1., 1.});
    cube.material.poissons_ratio = ball.material.poissons_ratio = poissons_ratio;
    for (const std::vector<BodyParameters> &bodies :
         {std::vector<BodyParameters>{cube}, std::vector<BodyParameters>{ball}})
    {
      BuiltScene<dim> built(bodies, TypeParam::degree);
      built.state.displacement = built.random_vector(.01);
      const double exact = largest_frequency_squared(built, {built.forces.elasticity.get()});
      const double bound = bulk_frequency_squared(built);
      EXPECT_GE(bound, (1. - 1e-9) * exact) << bodies[0].name;
      EXPECT_LE(bound, 4. * exact) << bodies[0].name;
    }
  }
}

TYPED_TEST(CriticalStep, ContactBoundIsSafeAndNotWasteful)
{
  constexpr int dim = TypeParam::dim;
  for (const double penalty : {1., 30.})
  {
    BuiltScene<dim> built(make_overlapping_bodies<dim>(), TypeParam::degree);
    contact::PotentialSettings settings = make_settings(contact::Integration::face_quadrature);
    settings.penalty_factor = penalty;
    const auto contact = built.add_contact(settings);
    contact->renew(built.state);
    contact->update(built.state);
    const Vector mass = make_lumped_mass(built.scene.materials, built.discretization);
    const double of_contact =
        compute_contact_bound<dim>({contact.get()}, mass, built.discretization).frequency_squared;
    // It counts points that are near and not yet in contact, in all directions at once.
    const double allowed = TypeParam::degree == 1 ? 7. : 11.;
    const double of_contact_alone = largest_frequency_squared(built, {contact.get()});
    EXPECT_GE(of_contact, (1. - 1e-9) * of_contact_alone);
    EXPECT_LE(of_contact, allowed * of_contact_alone);

    const double exact = largest_frequency_squared(built, {built.forces.elasticity.get(), contact.get()});
    built.forces.elasticity->update(built.state);
    const double bound = of_contact + bulk_frequency_squared(built);
    EXPECT_GE(bound, (1. - 1e-9) * exact);
    EXPECT_LE(bound, allowed * exact);
  }
}

/// Whether central differences with damping from half a step before stay bounded.
bool is_stable(double time_step, double frequency_squared, double damping_rate)
{
  double u = 0., v = 1.;
  for (unsigned int step = 0; step < 20000; ++step)
  {
    u += time_step * v;
    v += time_step * (-frequency_squared * u - damping_rate * v);
    if (!(std::abs(u) < 1e6))
      return false;
  }
  return true;
}

TEST(CriticalTimeStep, PartsStableFromUnstable)
{
  for (const double frequency : {.5, 1., 40.})
    for (const double share_of_damping : {0., .1, 1., 5.})
    {
      const double squared = frequency * frequency, rate = share_of_damping * frequency;
      const double critical = critical_time_step(squared, rate);
      EXPECT_TRUE(is_stable(.999 * critical, squared, rate)) << frequency << " " << rate;
      EXPECT_FALSE(is_stable(1.005 * critical, squared, rate)) << frequency << " " << rate;
    }
  EXPECT_DOUBLE_EQ(critical_time_step(4., 0.), 1.);
}
} // namespace
