// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/adaptivity/error_estimator.h"

#include "../contact_bodies.h"

#include "signorini/contact/coupling/volume_contact_force.h"

#include <numeric>

using namespace signorini;
using namespace signorini::test;

namespace
{
/// A block of 4 cells along each edge, under uniform stress between a floor that balances it and another body
/// that overlaps the middle of its upper face: the outermost cells are free there.
template <int dim>
struct PressedBlock
{
  static constexpr double strain = 1e-3, overlap = .01, first_free = .25, last_free = .75;

  explicit PressedBlock(bool is_of_simplices)
      : built(make_bodies(is_of_simplices), 1,
              [](Parameters &p) { p.obstacles = {make_floor<dim>(depth_in_floor())}; }),
        volume_map(built.scene, built.discretization)
  {
    contact::PotentialSettings settings = make_settings(contact::Integration::face_quadrature);
    settings.excluded_body_pairs = {{0, 1}};
    built.add_contact(settings);
    volumes = std::make_shared<VolumeContactForce<dim>>("contact", volume_map,
                                                        contact::VolumePotentialSettings(), MPI_COMM_WORLD);
    built.forces.volume_contacts.push_back(volumes);
    built.forces.contacts.insert(built.forces.contacts.begin(), volumes);
    built.state.displacement = built.interpolate(
        [](const SpatialVector<dim> &x)
        {
          SpatialVector<dim> u = SpatialVector<dim>::Zero();
          u[dim - 1] = -strain * x[dim - 1];
          return u;
        });
    built.forces.elasticity->update(built.state);
    for (const auto &contact : built.forces.contacts)
      contact->renew(built.state);
    estimator =
        std::make_unique<ErrorEstimator<dim>>(built.discretization, built.scene, built.forces, &built.map);
    estimate = estimator->estimate(built.state);
  }

  /// k_A d = E ε.
  static double depth_in_floor()
  {
    const contact::PotentialSettings settings;
    return strain * .25 / settings.penalty_factor;
  }

  static std::vector<BodyParameters> make_bodies(bool is_of_simplices)
  {
    const Triple one{1., 1., 1.};
    BodyParameters lower =
        is_of_simplices ? make_simplex_box("lower", dim, one, {4, 4, 4}) : make_box("lower", one, {4, 4, 4});
    BodyParameters upper = make_box("upper", {.4, .4, .4}, {2, 2, 2});
    for (BodyParameters *body : {&lower, &upper})
      body->material = make_material(Model::linear_elastic, 0.);
    upper.placement.shift = {.3, .3, .3};
    upper.placement.shift[dim - 1] = 1. - overlap;
    return {upper, lower};
  }

  BuiltScene<dim> built;
  VolumeMap<dim> volume_map;
  std::shared_ptr<VolumeContactForce<dim>> volumes;
  std::unique_ptr<ErrorEstimator<dim>> estimator;
  ErrorEstimate estimate;
};

/// Whether a face of the lower block belongs to its upper face, beyond the cells that are in contact there.
template <int dim>
bool is_free_above(const BoundaryFace<dim> &face)
{
  dealii::Point<dim> centre;
  for (const dealii::Point<dim> &x : face.positions)
    centre += x / static_cast<double>(face.positions.size());
  bool is_outside = false;
  for (unsigned int d = 0; d + 1 < dim; ++d)
    is_outside =
        is_outside || centre[d] < PressedBlock<dim>::first_free || centre[d] > PressedBlock<dim>::last_free;
  return face.body == 1 && centre[dim - 1] > 1. - 1e-9 && is_outside;
}

template <typename T>
class ErrorsOnRanks : public testing::Test
{
};
TYPED_TEST_SUITE(ErrorsOnRanks, LinearCases);

/// Uniform stress: an error is only where a traction that is known does not balance it.
TYPED_TEST(ErrorsOnRanks, OnlyFacesThatVolumesPressOnStayUnbalanced)
{
  constexpr int dim = TypeParam::dim;
  for (const bool is_of_simplices : {false, true})
  {
    const PressedBlock<dim> block(is_of_simplices);
    const BuiltScene<dim> &built = block.built;
    const ErrorEstimate &estimate = block.estimate;
    std::vector<bool> is_free(built.discretization.cells.n_cells, false);
    for (const BoundaryFace<dim> &face : block.estimator->boundary_faces())
      if (is_free_above(face))
        is_free[face.cell] = true;
    const double scale = 1000. * block.strain * block.strain * std::pow(.25, dim);
    for (unsigned int cell = 0; cell < is_free.size(); ++cell)
      if (built.discretization.cells.bodies[cell] == 1)
      {
        if (is_free[cell])
          EXPECT_GT(estimate.cell_discretization[cell], .01 * scale);
        else
          EXPECT_LT(estimate.cell_discretization[cell], 1e-9 * scale);
      }
  }
}

TYPED_TEST(ErrorsOnRanks, CellsHoldTheWholeErrorOfContact)
{
  constexpr int dim = TypeParam::dim;
  for (const bool is_of_simplices : {false, true})
  {
    const PressedBlock<dim> block(is_of_simplices);
    const BuiltScene<dim> &built = block.built;
    const ErrorEstimate &estimate = block.estimate;
    const auto sum_of_ranks = [](double own) { return dealii::Utilities::MPI::sum(own, MPI_COMM_WORLD); };
    double of_all = 0., of_upper = 0.;
    for (unsigned int cell = 0; cell < estimate.cell_contact.size(); ++cell)
    {
      of_all += estimate.cell_contact[cell];
      of_upper += built.discretization.cells.bodies[cell] == 0 ? estimate.cell_contact[cell] : 0.;
    }
    const double of_volumes = block.volumes->energy();
    const double of_floor = built.forces.surface_contacts[0]->energy();
    ASSERT_GT(of_volumes, 0.);
    ASSERT_GT(of_floor, 0.);
    EXPECT_NEAR(sum_of_ranks(of_all), estimate.contact, 1e-12 * estimate.contact);
    EXPECT_NEAR(estimate.contact, 2. * (of_volumes + of_floor), 1e-12 * estimate.contact);
    EXPECT_NEAR(sum_of_ranks(of_upper), of_volumes, 1e-12 * of_volumes);
  }
}
} // namespace
