// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/adaptivity/marking.h"

#include "signorini/adaptivity/remeshing.h"

#include "../built_scene.h"

#include <numeric>

using namespace signorini;
using namespace signorini::test;

namespace
{
/// Flags of the hexahedra.
struct Flags
{
  unsigned int n_cells = 0, n_refined = 0, n_coarser = 0;
};

/// A body of hexahedra refined once, and one of simplices.
template <int dim>
struct MixedScene
{
  MixedScene() : built(make_bodies(), 1) {}

  static std::vector<BodyParameters> make_bodies()
  {
    BodyParameters hexahedra = make_box("hexahedra", {1., 1., 1.}, {2, 2, 2});
    hexahedra.mesh.refinements = 1;
    BodyParameters simplices = make_simplex_box("simplices", dim, {1., 1., 1.}, {3, 3, 3});
    simplices.placement.shift = {2., 0., 0.};
    return {hexahedra, simplices};
  }

  /// Marks with the same error in all hexahedra, together that share of the square, and in all simplices.
  Flags mark(double share_of_hexahedra)
  {
    const unsigned int n_cells = built.discretization.cells.n_cells,
                       n_hexahedra = built.discretization.tetrahedra->first_cell;
    ErrorEstimate estimate;
    estimate.is_contact_unseen.assign(n_cells, false);
    estimate.cell_discretization.assign(n_hexahedra, share_of_hexahedra / n_hexahedra);
    estimate.cell_discretization.resize(n_cells, (1. - share_of_hexahedra) / (n_cells - n_hexahedra));
    estimate.discretization = 1.;
    auto &mesh = built.discretization.hexahedra->mesh;
    for (const auto &cell : mesh.active_cell_iterators())
    {
      cell->clear_refine_flag();
      cell->clear_coarsen_flag();
    }
    mark_cells(estimate, AdaptivityParameters(), built.discretization);
    Flags flags;
    for (const auto &cell : mesh.active_cell_iterators())
    {
      ++flags.n_cells;
      flags.n_refined += cell->refine_flag_set() ? 1 : 0;
      flags.n_coarser += cell->coarsen_flag_set() ? 1 : 0;
    }
    return flags;
  }

  BuiltScene<dim> built;
};

template <typename T>
class Marking : public testing::Test
{
};
TYPED_TEST_SUITE(Marking, LinearCases);

TYPED_TEST(Marking, HexahedraCountByTheirShareOfTheWholeScene)
{
  MixedScene<TypeParam::dim> scene;
  const Flags of_few = scene.mark(.001), of_some = scene.mark(.1), of_most = scene.mark(.999);
  EXPECT_EQ(of_few.n_refined, 0u) << "simplices hold the error";
  EXPECT_EQ(of_few.n_coarser, of_few.n_cells) << "less than the coarsen share";
  EXPECT_EQ(of_some.n_refined + of_some.n_coarser, 0u);
  EXPECT_EQ(of_most.n_refined, of_most.n_cells);
}

/// How many cells a mesh has after all its cells but one had no error, over what it had before.
template <int dim>
double coarsen(const BodyParameters &body)
{
  const BuiltScene<dim> built({body}, 1);
  ErrorEstimate estimate;
  estimate.cell_discretization.assign(built.discretization.cells.n_cells, 0.);
  estimate.is_contact_unseen.assign(built.discretization.cells.n_cells, false);
  estimate.cell_discretization[0] = estimate.discretization = 1.;
  const auto meshes =
      make_adapted_meshes(estimate, AdaptivityParameters(), built.parameters.bodies, built.discretization);
  return static_cast<double>(meshes.at(0).mesh.cells.size()) / built.discretization.cells.n_cells;
}

TYPED_TEST(Marking, SimplicesGrowNoLargerThanTheElementSize)
{
  constexpr int dim = TypeParam::dim;
  BodyParameters body = make_box("body", {1., 1., 1.}, {});
  body.mesh.cell_type = MeshParameters::CellType::tetrahedra;
  body.mesh.element_size = .2;
  EXPECT_GT(coarsen<dim>(body), .8);
  body.placement.scale = 5.;
  EXPECT_GT(coarsen<dim>(body), .8) << "the element size is that before the placement";
  body.mesh.element_size = .4;
  body.mesh.refinements = 1;
  EXPECT_LT(coarsen<dim>(body), .6) << "a refinement may be taken back";
  EXPECT_GT(coarsen<dim>(make_simplex_box("cut", dim, {1., 1., 1.}, {5, 5, 5})), .6);
}
} // namespace
