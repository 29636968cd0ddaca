// SPDX-License-Identifier: LGPL-2.1-or-later
#include "built_scene.h"

#include "signorini/base/exceptions.h"

using namespace signorini;
using namespace signorini::test;

namespace
{
template <typename Case>
class RestoredMeshOnRanks : public testing::Test
{
protected:
  static constexpr int dim = Case::dim;

  static Parameters make_parameters(unsigned int n_cells)
  {
    Parameters parameters;
    parameters.dimension = dim;
    parameters.degree = Case::degree;
    parameters.bodies = {make_box("one", {1., 1., 1.}, {n_cells, n_cells, n_cells}),
                         make_box("other", {1., 1., 1.}, {1, 1, 1})};
    parameters.bodies[1].mesh.refinements = 1;
    parameters.bodies[1].placement.shift = {2., 0., 0.};
    return parameters;
  }

  /// Refines and coarsens by cells' places, so that no cell is where it was first made.
  static void adapt(unsigned int round, Discretization<dim> &discretization)
  {
    for (const auto &cell : discretization.hexahedra->mesh.active_cell_iterators())
    {
      if (!cell->is_locally_owned())
        continue;
      const double chance = std::sin(12.9898 * cell->center()[0] + 78.233 * cell->center()[dim - 1] + round);
      if (chance > .4 && cell->level() < 3)
        cell->set_refine_flag();
      else if (cell->level() > 0 && std::sin(37. * cell->parent()->center()[0] + round) < 0.)
        cell->set_coarsen_flag();
    }
    PointValues nothing;
    discretization.adapt({}, nothing);
    std::vector<unsigned int> weights(discretization.cells.n_cells, 1);
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      weights.assign(weights.size(), 4);
    discretization.balance(weights, {}, nothing);
  }
};
TYPED_TEST_SUITE(RestoredMeshOnRanks, AllCases);

TYPED_TEST(RestoredMeshOnRanks, IsNumberedAsTheOneThatWasAdaptedInManySteps)
{
  using Meshes = Discretization<TestFixture::dim>;
  Meshes adapted(this->make_parameters(2), MPI_COMM_WORLD);
  Meshes restored(this->make_parameters(2), MPI_COMM_WORLD);
  const unsigned int n_cells_of_file = adapted.n_cells();
  for (unsigned int round = 0; round < 4; ++round)
    this->adapt(round, adapted);
  EXPECT_NE(adapted.n_cells(), n_cells_of_file);
  restored.restore(adapted.hexahedron_ids());
  EXPECT_EQ(restored.hexahedron_ids(), adapted.hexahedron_ids());
  EXPECT_EQ(restored.owned_dofs, adapted.owned_dofs);
  EXPECT_EQ(restored.cells.dofs, adapted.cells.dofs);
  EXPECT_EQ(restored.cells.bodies, adapted.cells.bodies);
  for (unsigned int i = 0; i < adapted.node_positions.locally_owned_size(); ++i)
    ASSERT_NEAR(restored.node_positions.local_element(i), adapted.node_positions.local_element(i), 1e-14);
}

TYPED_TEST(RestoredMeshOnRanks, OfAnotherCoarseMeshIsRefused)
{
  using Meshes = Discretization<TestFixture::dim>;
  const Meshes finer(this->make_parameters(3), MPI_COMM_WORLD);
  Meshes other(this->make_parameters(2), MPI_COMM_WORLD);
  EXPECT_THROW(other.restore(finer.hexahedron_ids()), FileError);
}

TYPED_TEST(RestoredMeshOnRanks, MayHaveAFamilyOnTwoRanks)
{
  using Meshes = Discretization<TestFixture::dim>;
  Parameters parameters = this->make_parameters(1);
  parameters.bodies.pop_back();
  parameters.bodies[0].mesh.refinements = 2;
  constexpr unsigned int n = 1u << TestFixture::dim; // cells of a family
  const auto way_of = [](const auto &cell)
  {
    const dealii::CellId id = cell->id();
    const auto way = id.get_child_indices();
    return std::vector<unsigned int>(way.begin(), way.end());
  };
  // The first family is divided while one of its cells is refined, and complete again afterwards.
  Meshes adapted(parameters, MPI_COMM_WORLD);
  for (const auto &cell : adapted.hexahedra->own_cells())
    if (way_of(cell) == std::vector<unsigned int>{0, 0})
      cell->set_refine_flag();
  PointValues nothing;
  adapted.adapt({}, nothing);
  std::vector<unsigned int> weights;
  for (const auto &cell : adapted.hexahedra->own_cells())
    weights.push_back(way_of(cell) == std::vector<unsigned int>{0, n / 2 - 1} ? n * (n - 1) - n + 2 : 1);
  adapted.balance(weights, {}, nothing);
  for (const auto &cell : adapted.hexahedra->own_cells())
    if (cell->level() == 3)
      cell->set_coarsen_flag();
  adapted.adapt({}, nothing);
  unsigned int n_own = 0;
  for (const auto &cell : adapted.hexahedra->own_cells())
    n_own += way_of(cell).at(0) == 0;
  const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  if (n_ranks == 2)
  {
    EXPECT_EQ(n_own, n / 2);
  }
  Meshes restored(parameters, MPI_COMM_WORLD);
  restored.restore(adapted.hexahedron_ids());
  EXPECT_EQ(restored.cells.dofs, adapted.cells.dofs);
}
} // namespace
