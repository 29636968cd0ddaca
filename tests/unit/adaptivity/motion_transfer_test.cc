// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/adaptivity/motion_transfer.h"

#include "../contact_bodies.h"

#include <Eigen/Geometry>

using namespace signorini;
using namespace signorini::test;

namespace
{
using Vector3 = Eigen::Vector3d;

struct Momenta
{
  double mass = 0.;
  Vector3 linear = Vector3::Zero();
  Vector3 angular = Vector3::Zero(); ///< about the origin
  double linear_scale = 0., angular_scale = 0.;
};

/// Of one body, summed up afresh.
template <int dim>
Momenta momenta_of(const BuiltScene<dim> &built, unsigned int body)
{
  const Vector mass = make_lumped_mass(built.scene.materials, built.discretization);
  Momenta sum;
  for (const OwnedNode<dim> &node : built.discretization.owned_nodes)
    if (node.body == body)
    {
      Vector3 x = Vector3::Zero(), v = Vector3::Zero();
      for (unsigned int d = 0; d < dim; ++d)
      {
        x[d] = node.position[d] + built.state.displacement.local_element(node.dofs[d]);
        v[d] = built.state.velocity.local_element(node.dofs[d]);
      }
      const double m = mass.local_element(node.dofs[0]);
      sum.mass += m;
      sum.linear += m * v;
      sum.angular += m * x.cross(v);
      sum.linear_scale += m * v.norm();
      sum.angular_scale += m * x.norm() * v.norm();
    }
  for (double *number : {&sum.mass, &sum.linear_scale, &sum.angular_scale})
    *number = dealii::Utilities::MPI::sum(*number, MPI_COMM_WORLD);
  for (Vector3 *vector : {&sum.linear, &sum.angular})
    for (double &component : *vector)
      component = dealii::Utilities::MPI::sum(component, MPI_COMM_WORLD);
  return sum;
}

/// Adapts the mesh again and again while the bodies are displaced by a field.
template <int dim, typename Field>
void expect_displacement_is_kept(BuiltScene<dim> &built, const Field &field)
{
  built.state.displacement = built.interpolate(field);
  for (unsigned int round = 0; round < 3; ++round)
  {
    flag_at_random(built.discretization, round, round == 0 ? 0. : .6);
    adapt_in_motion(built.scene, built.discretization, built.state, built.memory);
    Vector difference = built.interpolate(field);
    difference -= built.state.displacement;
    EXPECT_LT(difference.linfty_norm(), 1e-13);
  }
}

BodyParameters make_shifted_ball()
{
  BodyParameters ball = graded(make_ball("ball", 1., 1), {1., 0., 0.}, 1, .3);
  ball.placement.shift = {3., 2., 1.};
  return ball;
}

template <typename T>
class MotionTransfer : public testing::Test
{
};
TYPED_TEST_SUITE(MotionTransfer, AllCases);

TYPED_TEST(MotionTransfer, EveryBodyKeepsItsMassAndMomenta)
{
  constexpr int dim = TypeParam::dim;
  BuiltScene<dim> built({make_graded_cube(), make_shifted_ball()}, TypeParam::degree);
  built.state.displacement = built.random_vector(.02, 3);
  built.state.velocity = built.random_vector(1., 4);
  for (unsigned int round = 0; round < 3; ++round)
  {
    const std::array<Momenta, 2> before{momenta_of(built, 0), momenta_of(built, 1)};
    const auto n_cells = built.discretization.n_cells();
    flag_at_random(built.discretization, round, round == 0 ? 0. : .6);
    const VectorAndMoment change =
        adapt_in_motion(built.scene, built.discretization, built.state, built.memory);
    EXPECT_NE(built.discretization.n_cells(), n_cells);
    EXPECT_GT(dealii::Utilities::MPI::max(built.discretization.hanging_dofs.size(), MPI_COMM_WORLD), 0u);
    for (unsigned int body = 0; body < 2; ++body)
    {
      const Momenta after = momenta_of(built, body);
      EXPECT_NEAR(after.mass, before[body].mass, 1e-13 * before[body].mass);
      EXPECT_LT((after.linear - before[body].linear).norm(), 1e-14 * after.linear_scale);
      EXPECT_LT((after.angular - before[body].angular).norm(), 1e-14 * after.angular_scale);
    }
    for (unsigned int d = 0; d < 3; ++d)
    {
      EXPECT_EQ(change.vector[d], 0.);
      EXPECT_EQ(change.moment[d], 0.);
    }
    for (Vector *values : {&built.state.displacement, &built.state.velocity})
    {
      Vector distributed = *values;
      built.discretization.distribute(distributed);
      distributed -= *values;
      EXPECT_LT(distributed.linfty_norm(), 1e-15) << "hanging nodes are not between their masters";
    }
  }
}

TYPED_TEST(MotionTransfer, RefinementLeavesTheDisplacementOfABoxAsItIs)
{
  constexpr int dim = TypeParam::dim;
  // A product of one power of each coordinate: the elements hold it, and coarser ones do too.
  const auto field = [](const SpatialVector<dim> &x)
  {
    const double product = std::pow(x[0] * x[dim - 1], TypeParam::degree);
    return SpatialVector<dim>(SpatialVector<dim>::Constant(1. + x[0] + 2. * product));
  };
  BuiltScene<dim> built({make_graded_cube()}, TypeParam::degree);
  expect_displacement_is_kept(built, field);
}

TYPED_TEST(MotionTransfer, ABallThatHasTurnedIsNotStrained)
{
  constexpr int dim = TypeParam::dim;
  BuiltScene<dim> built({make_shifted_ball()}, TypeParam::degree);
  SpatialTensor<dim> rotation;
  if constexpr (dim == 2)
    rotation = Eigen::Rotation2Dd(2.).toRotationMatrix();
  else
    rotation = Eigen::AngleAxisd(2., Vector3(1., 2., -1.).normalized()).toRotationMatrix();
  const auto turn = [&](const SpatialVector<dim> &x) { return SpatialVector<dim>(rotation * x - x); };
  expect_displacement_is_kept(built, turn);
}

TYPED_TEST(MotionTransfer, SupportsTakeOnlyTheirOwnComponents)
{
  constexpr int dim = TypeParam::dim;
  BodyParameters ball = make_shifted_ball();
  ball.mesh.part = MeshParameters::Part::half;
  ball.supports = {make_support(dim == 2 ? "y" : "z", {})};
  ball.supports[0].displacement[dim - 1] = "0";
  ball.mesh.grading.reset();
  BuiltScene<dim> built({ball}, TypeParam::degree);
  built.state.displacement = built.random_vector(.02, 3);
  built.state.velocity = built.random_vector(1., 4);
  for (Vector *values : {&built.state.displacement, &built.state.velocity})
  {
    built.supports.clear(*values);
    built.discretization.distribute(*values);
  }
  const Momenta before = momenta_of(built, 0);
  flag_at_random(built.discretization, 2, 0.);
  const VectorAndMoment change =
      adapt_in_motion(built.scene, built.discretization, built.state, built.memory);
  const Momenta after = momenta_of(built, 0);
  const double round_off = 1e-13 * after.angular_scale;
  for (unsigned int d = 0; d < 3; ++d)
  {
    EXPECT_NEAR(change.vector[d], after.linear[d] - before.linear[d], round_off);
    EXPECT_NEAR(change.moment[d], after.angular[d] - before.angular[d], round_off);
    if (d != dim - 1)
    {
      EXPECT_EQ(change.vector[d], 0.);
    }
  }
  EXPECT_GT(std::abs(change.vector[dim - 1]), 1e-6 * after.linear_scale);
  EXPECT_GT(std::abs(change.moment[dim == 2 ? 2 : 0]), 1e-6 * after.angular_scale);
  const SupportedDofs<dim> supports(built.scene, built.discretization, 1.);
  ASSERT_GT(dealii::Utilities::MPI::max(supports.owned_dofs().size(), MPI_COMM_WORLD), 0u);
  for (const unsigned int dof : supports.owned_dofs())
    EXPECT_EQ(built.state.velocity.local_element(dof), 0.);
}

TYPED_TEST(MotionTransfer, JumpsOfEnergyAreBooked)
{
  constexpr int dim = TypeParam::dim;
  BuiltScene<dim> built(make_overlapping_bodies<dim>(.08), TypeParam::degree);
  const contact::PotentialSettings settings = make_settings(contact::Integration::face_quadrature);
  built.add_contact(settings);
  built.state.velocity = built.random_vector(.3);
  const auto make_solver = [&]()
  {
    return std::make_unique<ExplicitSolver<dim>>(built.discretization, built.supports, built.scene.materials,
                                                 built.forces, ExplicitParameters(), built.run_time);
  };
  auto solver = make_solver();
  solver->start(built.state);
  for (unsigned int step = 0; step < 20; ++step)
    solver->step(.3 * solver->stable_step(), built.state);
  solver->take_stock(built.state);
  flag_at_random(built.discretization, 7, 0.);
  const VectorAndMoment change =
      adapt_in_motion(built.scene, built.discretization, built.state, built.memory);
  built.supports = SupportedDofs<dim>(built.scene, built.discretization, 1.);
  built.map = SurfaceMap<dim>(built.scene, built.discretization);
  built.forces = SceneForces<dim>();
  built.forces.elasticity = std::make_shared<InternalForce<dim>>(built.scene.materials, built.discretization);
  built.add_contact(settings);
  const auto old_solver = std::move(solver);
  solver = make_solver();
  solver->resume(*old_solver, change, built.state);

  const EnergyLedger &before = old_solver->energy(), &after = solver->energy();
  EXPECT_NE(after.adaptation, 0.);
  EXPECT_DOUBLE_EQ(after.adaptation, after.stored() - before.stored());
  EXPECT_DOUBLE_EQ(after.max_adaptation, std::abs(after.adaptation));
  EXPECT_NEAR(after.imbalance(), before.imbalance(), 1e-15 * after.largest);
  for (unsigned int step = 0; step < 20; ++step)
    solver->step(.3 * solver->stable_step(), built.state);
  solver->take_stock(built.state);
  EXPECT_LT(solver->momentum().linear_drift(), 1e-13);
  EXPECT_LT(solver->momentum().angular_drift(), 1e-13);
}
} // namespace
