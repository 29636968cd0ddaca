// SPDX-License-Identifier: LGPL-2.1-or-later
#include "built_scene.h"

#include <deal.II/fe/fe_values.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>

using namespace signorini;
using namespace signorini::test;

namespace
{
BodyParameters make_plastic_cube(double yield_stress)
{
  BodyParameters cube = make_graded_cube();
  cube.material = make_material(Model::plastic);
  cube.material.yield_stress = yield_stress;
  cube.material.hardening_modulus = 100.;
  return cube;
}

/// Numbers at the points of all own cells, [cell][point][component].
template <int dim>
std::vector<double>
sample(const BuiltScene<dim> &built, unsigned int n_components,
       const std::function<double(const dealii::Point<dim> &, unsigned int component)> &field)
{
  std::vector<double> numbers;
  built.discretization.for_each_own_cell(
      [&](const MeshPart<dim> &part, const auto &cell, unsigned int)
      {
        dealii::FEValues<dim> values(part.mapping(), part.element, part.cell_rule(),
                                     dealii::update_quadrature_points);
        values.reinit(cell);
        for (const dealii::Point<dim> &point : values.get_quadrature_points())
          for (unsigned int c = 0; c < n_components; ++c)
            numbers.push_back(field(point, c));
      });
  return numbers;
}

double largest_difference(const std::vector<double> &one, const std::vector<double> &other)
{
  EXPECT_EQ(one.size(), other.size());
  double largest = 0.;
  for (std::size_t i = 0; i < std::min(one.size(), other.size()); ++i)
    largest = std::max(largest, std::abs(one[i] - other[i]));
  return largest;
}

template <typename T>
class PlasticMemoryOnRanks : public testing::Test
{
};
TYPED_TEST_SUITE(PlasticMemoryOnRanks, AllCases);

TYPED_TEST(PlasticMemoryOnRanks, IsCarriedAsThePolynomialThroughThePointsOfACell)
{
  constexpr int dim = TypeParam::dim;
  // Beside the hexahedra, which are refined and made coarser, stand simplices as they are.
  BodyParameters simplices = make_simplex_box("simplices", dim, {1., 1., 1.}, {1, 1, 1});
  simplices.placement.shift = {3., 0., 0.};
  BuiltScene<dim> built({make_plastic_cube(20.), simplices}, TypeParam::degree);
  const auto field = [](const dealii::Point<dim> &x, unsigned int component)
  { return 1. + component + std::pow(x[0] - 2. * x[dim - 1] + component, TypeParam::degree); };
  built.memory = {3, sample<dim>(built, 3, field)};
  for (unsigned int round = 0; round < 3; ++round)
  {
    const auto n_cells = built.discretization.n_cells();
    flag_at_random(built.discretization, round, round == 0 ? 0. : .6);
    built.discretization.adapt({&built.state.displacement}, built.memory);
    EXPECT_NE(built.discretization.n_cells(), n_cells);
    EXPECT_LT(largest_difference(built.memory.values, sample<dim>(built, 3, field)), 1e-12);
  }
  const bool is_first = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  const std::vector<unsigned int> work(built.discretization.cells.n_cells, is_first ? 1000 : 3000);
  EXPECT_EQ(built.discretization.balance(work, {&built.state.displacement}, built.memory),
            dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1);
  EXPECT_LT(largest_difference(built.memory.values, sample<dim>(built, 3, field)), 1e-12);
}

TYPED_TEST(PlasticMemoryOnRanks, AUniformlyYieldedBodyKeepsItsStressAndEnergyOnAnyMesh)
{
  constexpr int dim = TypeParam::dim;
  BuiltScene<dim> built({make_plastic_cube(20.)}, TypeParam::degree);
  SpatialTensor<3> A;
  A << .05, -.08, .02, .03, -.04, .06, -.02, .01, .03;
  const SpatialTensor<dim> H = A.topLeftCorner<dim, dim>();
  built.state.displacement =
      built.interpolate([&](const SpatialVector<dim> &x) { return SpatialVector<dim>(H * x); });
  built.forces.elasticity->update(built.state);
  ASSERT_GT(built.forces.elasticity->commit(), 0.);
  const double energy = built.forces.elasticity->energy();
  const double strain = built.forces.elasticity->plastic_strains()[0];
  const Eigen::Matrix3d stress = built.forces.elasticity->stresses()[0];
  built.memory = built.forces.elasticity->memory();
  for (unsigned int round = 0; round < 2; ++round)
  {
    flag_at_random(built.discretization, round, round == 0 ? 0. : .6);
    built.discretization.adapt({&built.state.displacement}, built.memory);
  }
  InternalForce<dim> adapted(built.scene.materials, built.discretization);
  adapted.update(built.state);
  adapted.remember(built.memory);
  EXPECT_NEAR(adapted.energy(), energy, 1e-11 * energy);
  for (unsigned int cell = 0; cell < built.discretization.cells.n_cells; ++cell)
  {
    EXPECT_NEAR(adapted.plastic_strains()[cell], strain, 1e-13);
    EXPECT_LT((adapted.stresses()[cell] - stress).norm(), 1e-11 * stress.norm());
  }
}

TEST(PlasticStates, AreRecalledFromWhatInterpolationMakesOfTheirMemories)
{
  Eigen::Matrix3d gradient, other_gradient;
  gradient << .05, -.3, .02, .03, -.2, .06, -.02, .5, .03;
  other_gradient << -.4, .1, .2, .3, .6, -.06, .3, -.1, .2;
  const PlasticState untouched;
  J2Plastic<3> law{3., 7., .01, .5, &untouched};
  const PlasticState one = law.yield(gradient).state, other = law.yield(other_gradient).state;
  law.state = &other;
  const auto of_other = law.memory(other_gradient);
  law.state = &one;
  const auto of_one = law.memory(gradient);
  const PlasticState back = law.recall(gradient, of_one);
  EXPECT_LT((back.inverse_metric - one.inverse_metric).norm(), 1e-14);
  EXPECT_EQ(back.equivalent_strain, one.equivalent_strain);

  for (const double share : {.3, .7})
  {
    J2Plastic<3>::Memory between;
    for (unsigned int i = 0; i < between.size(); ++i)
      between[i] = (1. - share) * of_one[i] + share * of_other[i];
    const Eigen::Matrix3d there = (1. - share) * gradient + share * other_gradient;
    const PlasticState state = law.recall(there, between);
    const Eigen::Matrix3d metric = Eigen::Matrix3d::Identity() + state.inverse_metric;
    EXPECT_NEAR(metric.determinant(), 1., 1e-12);
    EXPECT_EQ(metric.llt().info(), Eigen::Success);
    J2Plastic<3> hard{3., 7., 100., .5, &state};
    for (unsigned int i = 0; i < between.size(); ++i)
      EXPECT_NEAR(hard.memory(there)[i], between[i], 1e-13);
  }
  J2Plastic<3>::Memory below_none = of_one;
  below_none[6] = -1e-3;
  EXPECT_EQ(law.recall(gradient, below_none).inverse_metric.norm(), 0.);
}

TEST(PlasticStates, KeepTheirDigitsWhereStrainsAreSmall)
{
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
  H(0, 0) = 1e-12;
  const PlasticState state =
      J2Plastic<3>::recall(H, {0., 0., 0., 0., 0., 0., 1e-12}); // all of the shape yielded
  // Exact but for the square of the strain.
  EXPECT_NEAR(state.inverse_metric(0, 0), -4. / 3. * 1e-12, 1e-23);
  EXPECT_NEAR(state.inverse_metric(1, 1), 2. / 3. * 1e-12, 1e-23);
}
} // namespace
