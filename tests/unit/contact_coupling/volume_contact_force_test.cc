// SPDX-License-Identifier: LGPL-2.1-or-later
#include "contact_bodies.h"

#include "signorini/contact/coupling/volume_contact_force.h"
#include "signorini/physics/momentum.h"

using namespace signorini;
using namespace signorini::test;

namespace
{
/// A box of simplices in a cube of hexahedra with hanging nodes, joined by the volume potential.
template <int dim>
struct OverlappingVolumes
{
  OverlappingVolumes() : built(make_bodies(), 1), map(built.scene, built.discretization)
  {
    contact = std::make_shared<VolumeContactForce<dim>>("contact", map, contact::VolumePotentialSettings(),
                                                        MPI_COMM_WORLD);
    built.forces.contacts.push_back(contact);
    u = built.random_vector(.01);
    built.state.displacement = u;
    contact->renew(built.state);
  }

  static std::vector<BodyParameters> make_bodies()
  {
    std::vector<BodyParameters> bodies = make_overlapping_bodies<dim>();
    BodyParameters upper = make_simplex_box("upper", dim, {.7, .7, .7}, {2, 2, 2});
    upper.material = bodies[1].material;
    upper.placement = bodies[1].placement;
    return {bodies[0], upper};
  }

  BuiltScene<dim> built;
  VolumeMap<dim> map;
  std::shared_ptr<VolumeContactForce<dim>> contact;
  Vector u;
};

template <typename T>
class VolumeContactForces : public testing::Test
{
};
TYPED_TEST_SUITE(VolumeContactForces, LinearCases);

TYPED_TEST(VolumeContactForces, SimplicesFillTheBodies)
{
  constexpr int dim = TypeParam::dim;
  const OverlappingVolumes<dim> scene;
  const ContactVolume<dim> &volume = scene.map.volume();
  const auto vertices = volume.vertex_positions(volume.reference_positions);
  std::array<double, 2> measures{};
  for (const Simplex<dim> &simplex : volume.simplices)
  {
    std::array<SpatialVector<dim>, dim + 1> x;
    for (unsigned int v = 0; v <= dim; ++v)
      x[v] = vertices[simplex.vertices[v]];
    measures[simplex.body] += measure_simplex<dim>(x);
  }
  EXPECT_NEAR(measures[0], 1., 1e-13);
  EXPECT_NEAR(measures[1], std::pow(.7, dim), 1e-13);
}

TYPED_TEST(VolumeContactForces, ForceIsEnergyGradient)
{
  OverlappingVolumes<TypeParam::dim> scene;
  ASSERT_FALSE(scene.built.discretization.hanging_dofs.empty());
  ASSERT_GT(scene.built.energy_of(*scene.contact, scene.u), 0.);
  expect_force_is_energy_gradient(scene.built, *scene.contact, scene.u, 1e-6, 1e-6);
}

TYPED_TEST(VolumeContactForces, TangentIsForceGradient)
{
  OverlappingVolumes<TypeParam::dim> scene;
  expect_tangent_is_force_gradient(scene.built, *scene.contact, scene.u, 1e-7, 1e-5);
}

TYPED_TEST(VolumeContactForces, ForcesOfBodiesBalance)
{
  constexpr int dim = TypeParam::dim;
  OverlappingVolumes<dim> scene;
  const Vector force = scene.built.force_of(*scene.contact, scene.u);
  const VectorAndMoment sums = sum_over_nodes(scene.built.discretization, scene.u, force);
  ASSERT_GT(sums.vector_scale, 0.);
  for (unsigned int d = 0; d < 3; ++d)
  {
    EXPECT_LT(std::abs(sums.vector[d]), 1e-12 * sums.vector_scale);
    EXPECT_LT(std::abs(sums.moment[d]), 1e-11 * sums.moment_scale);
  }
  SpatialVector<dim> on_upper = SpatialVector<dim>::Zero();
  for (const OwnedNode<dim> &node : scene.built.discretization.owned_nodes)
    for (unsigned int d = 0; d < dim && node.body == 1; ++d)
      on_upper[d] += force.local_element(node.dofs[d]);
  const auto measures = scene.contact->measure();
  EXPECT_LT((measures.resultants[1] - on_upper).norm(), 1e-12 * on_upper.norm());
  const auto pairs = scene.contact->pair_forces(scene.built.state);
  EXPECT_LT((pairs.bodies.at({0, 1}) + on_upper).norm(), 1e-12 * on_upper.norm());
}
} // namespace
