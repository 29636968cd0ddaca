// SPDX-License-Identifier: LGPL-2.1-or-later
#include "built_scene.h"

#include "signorini/discretization/placement.h"
#include "signorini/discretization/scene_mesh.h"
#include "signorini/parameters/mesh_parameters.h"

#include <algorithm>
#include <optional>
#include <set>

using namespace signorini;
using namespace signorini::test;

namespace
{
template <typename T>
class Discretizations : public testing::Test
{
};
TYPED_TEST_SUITE(Discretizations, AllCases);

TYPED_TEST(Discretizations, CollectIsTheTransposeOfDistribute)
{
  constexpr int dim = TypeParam::dim;
  BuiltScene<dim> built({graded(make_box("box", {2., 2., 2.}, {2, 2, 2}), {1., 1., 1.}, 2, .2)},
                        TypeParam::degree);
  ASSERT_FALSE(built.discretization.hanging_dofs.empty());
  const Vector u = built.random_vector(1., 1);
  Vector f = built.discretization.make_vector();
  std::mt19937 engine(2);
  for (unsigned int i = 0; i < f.locally_owned_size(); ++i)
    f.local_element(i) = std::uniform_real_distribution<double>(-1., 1.)(engine);
  const double uncollected = f * u;
  built.discretization.collect(f);
  EXPECT_NEAR(f * u, uncollected, 1e-12 * f.l2_norm() * u.l2_norm());
  for (const HangingDof &hanging : built.discretization.hanging_dofs)
    EXPECT_EQ(f.local_element(hanging.dof), 0.);
  Vector again = u;
  built.discretization.distribute(again);
  again -= u;
  EXPECT_LT(again.linfty_norm(), 1e-15) << "distributing twice must change nothing";
}

TYPED_TEST(Discretizations, DistributeReproducesLinearFields)
{
  constexpr int dim = TypeParam::dim;
  BuiltScene<dim> built({graded(make_box("box", {2., 2., 2.}, {2, 2, 2}), {1., 1., 1.}, 2, .2)},
                        TypeParam::degree);
  Vector values = built.interpolate([](const SpatialVector<dim> &x) { return SpatialVector<dim>(3. * x); });
  for (const OwnedNode<dim> &node : built.discretization.owned_nodes)
    for (unsigned int d = 0; d < dim; ++d)
      EXPECT_NEAR(values.local_element(node.dofs[d]), 3. * node.position[d], 1e-13);
}

TYPED_TEST(Discretizations, TouchingBodiesShareNoDofs)
{
  constexpr int dim = TypeParam::dim;
  BodyParameters one = make_box("one", {1., 1., 1.}, {2, 2, 2}), other = one;
  other.name = "other";
  other.placement.shift = {1., 0., 0.};
  BuiltScene<dim> built({one, other}, TypeParam::degree);
  const CellTable<dim> &cells = built.discretization.cells;
  std::array<std::set<unsigned int>, 2> dofs;
  for (unsigned int cell = 0; cell < cells.n_cells; ++cell)
    dofs[cells.bodies[cell]].insert(cells.cell_dofs(cell), cells.cell_dofs(cell) + cells.n_cell_dofs(cell));
  EXPECT_EQ(dofs[0].size(), dim * std::pow(2 * TypeParam::degree + 1, dim));
  EXPECT_EQ(dofs[1].size(), dofs[0].size());
  EXPECT_EQ(dofs[0].size() + dofs[1].size(), built.discretization.owned_dofs.size());
}

TYPED_TEST(Discretizations, EveryNodeIsOwnedOnceByItsBody)
{
  constexpr int dim = TypeParam::dim;
  BodyParameters other = make_box("other", {1., 1., 1.}, {2, 2, 2});
  other.placement.shift = {5., 0., 0.};
  BuiltScene<dim> built({make_graded_cube(), other}, TypeParam::degree);
  std::set<unsigned int> dofs;
  for (const OwnedNode<dim> &node : built.discretization.owned_nodes)
  {
    dofs.insert(node.dofs.begin(), node.dofs.end());
    EXPECT_EQ(node.body, node.position[0] > 3. ? 1u : 0u);
  }
  EXPECT_EQ(dofs.size(), built.discretization.owned_dofs.size());
  EXPECT_EQ(dim * built.discretization.owned_nodes.size(), dofs.size());
}

TYPED_TEST(Discretizations, BallsDoNotShareTheirManifolds)
{
  // Alike but for a shift: all cells of the second have the volumes of the first.
  constexpr int dim = TypeParam::dim;
  BodyParameters left = make_ball("left", 1., 2), right = make_ball("right", 1., 2);
  right.placement.shift = {3., 1., 2.};
  BuiltScene<dim> built({left, right}, TypeParam::degree);
  const CellTable<dim> &cells = built.discretization.cells;
  std::array<std::vector<double>, 2> measures;
  for (unsigned int cell = 0; cell < cells.n_cells; ++cell)
    for (unsigned int node = 0; node < cells.n_nodes(cell); ++node)
      measures[cells.bodies[cell]].push_back(cells.cell_nodal_measures(cell)[node]);
  ASSERT_EQ(measures[0].size(), measures[1].size());
  ASSERT_FALSE(measures[0].empty());
  for (std::size_t i = 0; i < measures[0].size(); ++i)
  {
    EXPECT_GT(measures[0][i], 0.);
    EXPECT_NEAR(measures[1][i], measures[0][i], 1e-12);
  }
}

TYPED_TEST(Discretizations, SurfaceNodesOfABallLieOnItsSphere)
{
  constexpr int dim = TypeParam::dim;
  BodyParameters ball = graded(make_ball("ball", .7, 1), {.7, 0., 0.}, 1, .2);
  ball.placement.shift = {1., 2., 3.};
  ball.placement.scale = 2.;
  BuiltScene<dim> built({ball}, TypeParam::degree);
  // Hanging nodes stay between their masters, so that the surface has no gaps.
  const SpatialVector<dim> centre = SpatialVector<3>(1., 2., 3.).head<dim>();
  const ContactSurface<dim> &surface = built.map.surface();
  unsigned int n_checked = 0;
  for (unsigned int node = 0; node < surface.n_nodes(); ++node)
    if (!built.discretization.hanging_constraints.is_constrained(built.map.node_dofs(node)[0]))
    {
      EXPECT_NEAR((surface.origin + surface.reference_positions[node] - centre).norm(), 1.4, 1e-12);
      ++n_checked;
    }
  EXPECT_GT(n_checked, 8u);
}

TYPED_TEST(Discretizations, HangingNodesLieBetweenTheirMasters)
{
  constexpr int dim = TypeParam::dim;
  BuiltScene<dim> built({graded(make_ball("ball", 1., 1), {1., 0., 0.}, 1, .3)}, TypeParam::degree);
  ASSERT_FALSE(built.discretization.hanging_dofs.empty());
  Vector positions = built.discretization.make_vector();
  for (const OwnedNode<dim> &node : built.discretization.owned_nodes)
    for (unsigned int d = 0; d < dim; ++d)
      positions.local_element(node.dofs[d]) = node.position[d];
  Vector distributed = positions;
  built.discretization.distribute(distributed);
  distributed -= positions;
  EXPECT_LT(distributed.linfty_norm(), 1e-13);
}

template <typename T>
class Meshes : public testing::Test
{
};
TYPED_TEST_SUITE(Meshes, LinearCases);

TYPED_TEST(Meshes, GradingRefinesWhereAskedAndNowhereElse)
{
  constexpr int dim = TypeParam::dim;
  BodyParameters box = graded(make_box("box", {4., 4., 4.}, {4, 4, 4}), {0., 0., 0.}, 2, .6);
  box.placement.shift = {3., -2., 7.};
  box.placement.rotation_angle = 30.;
  const auto mesh = make_scene_mesh<dim>({box}, MPI_COMM_WORLD);
  const Placement<dim> placement(box.placement);
  unsigned int n_coarse = 0;
  for (const auto &cell : mesh->active_cell_iterators())
  {
    double nearest = 1e300, farthest = 0.;
    for (const unsigned int v : cell->vertex_indices())
    {
      nearest = std::min(nearest, placement.own_coordinates(cell->vertex(v)).norm());
      farthest = std::max(farthest, placement.own_coordinates(cell->vertex(v)).norm());
    }
    if (nearest <= .6)
    {
      EXPECT_EQ(cell->level(), 2);
    }
    if (nearest > 2. * .6 + std::sqrt(dim) + 1.) // one coarse cell for balance
    {
      EXPECT_EQ(cell->level(), 0);
    }
    n_coarse += cell->level() == 0;
  }
  EXPECT_GT(n_coarse, std::pow(4, dim) / 2);
}

TYPED_TEST(Meshes, GradingTowardsABoundaryRefinesItsLayer)
{
  constexpr int dim = TypeParam::dim;
  BodyParameters box = make_box("box", {4., 4., 4.}, {4, 4, 4});
  box.mesh.grading.emplace();
  box.mesh.grading->boundary = "top";
  box.mesh.grading->distance = .3;
  box.mesh.grading->levels = 1;
  box.mesh.refinements = 1;
  const auto mesh = make_scene_mesh<dim>({box}, MPI_COMM_WORLD);
  for (const auto &cell : mesh->active_cell_iterators())
    EXPECT_EQ(cell->level(), cell->center()[dim - 1] > 3.5 ? 2 : 1);
}

TYPED_TEST(Meshes, RefinementOfOneBodyLeavesOthersAlone)
{
  constexpr int dim = TypeParam::dim;
  BodyParameters one = make_box("one", {1., 1., 1.}, {1, 1, 1}), other = one;
  other.mesh.refinements = 2;
  const auto mesh = make_scene_mesh<dim>({one, other}, MPI_COMM_WORLD);
  EXPECT_EQ(mesh->n_active_cells(), 1u + static_cast<unsigned int>(std::pow(4, dim)));
}

TYPED_TEST(Meshes, BoundaryIdsNameTheBodyAndItsFaces)
{
  constexpr int dim = TypeParam::dim;
  BodyParameters ball = make_ball("ball", 1., 1), box = make_box("box", {2., 3., 4.}, {1, 2, 1});
  ball.mesh.part = MeshParameters::Part::orthant;
  box.placement.shift = {5., 1., 2.};
  box.placement.rotation_angle = 40.;
  box.placement.rotation_axis = {1., 2., 3.};
  const std::vector<BodyParameters> bodies{ball, box};
  const auto mesh = make_scene_mesh<dim>(bodies, MPI_COMM_WORLD);
  std::array<std::set<unsigned int>, 2> found;
  for (const auto &cell : mesh->active_cell_iterators())
    for (const auto &face : cell->face_iterators())
      if (face->at_boundary())
      {
        const auto [body, id] = split_boundary_id(face->boundary_id());
        ASSERT_EQ(body, cell->material_id());
        found[body].insert(id);
        const Placement<dim> placement(bodies[body].placement);
        const dealii::Point<dim> own = placement.own_coordinates(face->vertex(0));
        const auto distance = [&](unsigned int vertex)
        {
          const dealii::Point<dim> x = placement.own_coordinates(face->vertex(vertex));
          if (body == 0)
            return id == 0 ? x.norm() - 1. : x[id - 1];
          const Triple &upper = bodies[body].mesh.upper_corner;
          return x[id / 2] - (id % 2 == 0 ? 0. : upper[id / 2]);
        };
        for (const unsigned int v : face->vertex_indices())
          EXPECT_NEAR(distance(v), 0., 1e-12) << "body " << body << " boundary " << id << " at " << own;
      }
  EXPECT_EQ(found[0].size(), dim + 1u);
  EXPECT_EQ(found[1].size(), 2u * dim);
  EXPECT_EQ(boundary_names(ball.mesh, dim).size(), dim + 1u);
  EXPECT_EQ(boundary_names(box.mesh, dim).size(), 2u * dim);
}

TYPED_TEST(Meshes, PartsOfABallHaveTheirShareOfIt)
{
  constexpr int dim = TypeParam::dim;
  const auto volume = [](MeshParameters::Part part)
  {
    BodyParameters ball = make_ball("ball", 2., 3);
    ball.mesh.part = part;
    const auto mesh = make_scene_mesh<dim>({ball}, MPI_COMM_WORLD);
    double sum = 0.;
    for (const auto &cell : mesh->active_cell_iterators())
      sum += cell->measure();
    return sum;
  };
  const double exact = dim == 2 ? 4. * M_PI : 4. / 3. * M_PI * 8.;
  EXPECT_NEAR(volume(MeshParameters::Part::whole), exact, .02 * exact);
  EXPECT_NEAR(volume(MeshParameters::Part::half), exact / 2., .02 * exact);
  EXPECT_NEAR(volume(MeshParameters::Part::orthant), exact / std::pow(2., dim), .02 * exact);
}

TYPED_TEST(Meshes, PlacementTurnsScalesAndShifts)
{
  constexpr int dim = TypeParam::dim;
  PlacementParameters parameters;
  parameters.shift = {1., 2., 3.};
  parameters.rotation_angle = 90.;
  parameters.scale = 2.;
  const Placement<dim> placement(parameters);
  dealii::Point<dim> own;
  own[0] = 1.;
  const dealii::Point<dim> placed = placement.place(own);
  const std::array<double, 3> expected{1., 4., 3.};
  for (unsigned int d = 0; d < dim; ++d)
    EXPECT_NEAR(placed[d], expected[d], 1e-15);

  parameters.rotation_angle = 37.;
  parameters.rotation_axis = {.3, -1., 2.};
  const Placement<dim> general(parameters);
  for (unsigned int d = 0; d < dim; ++d)
    own[d] = .3 * d - .7;
  EXPECT_LT(general.own_coordinates(general.place(own)).distance(own), 1e-14);
  EXPECT_NEAR(general.place(own).distance(general.place(dealii::Point<dim>())), 2. * own.norm(), 1e-14);
  if (dim == 3)
  {
    dealii::Point<dim> axis;
    for (unsigned int d = 0; d < dim; ++d)
      axis[d] = parameters.rotation_axis[d];
    EXPECT_LT((general.rotate(axis) - axis).norm(), 1e-14);
  }
}

TYPED_TEST(Discretizations, NumberNeighbouringSimplicesTogetherWhateverTheOrderOfTheFile)
{
  constexpr int dim = TypeParam::dim;
  BodyParameters box = make_simplex_box("box", dim, {8., 8., 8.}, {8, 8, 8});
  auto mesh = std::make_shared<SimplexMesh>(make_cut_box(box.mesh, dim));
  std::shuffle(mesh->cells.begin(), mesh->cells.end(), std::mt19937(3));
  box.mesh.mesh_of_file = mesh;
  BuiltScene<dim> built({box}, TypeParam::degree);
  double distance = 0.;
  std::optional<dealii::Point<dim>> before;
  built.discretization.for_each_own_cell(
      [&](const MeshPart<dim> &, const auto &cell, unsigned int)
      {
        if (before)
          distance += before->distance(cell->center());
        before = cell->center();
      });
  EXPECT_LT(distance / built.discretization.cells.n_cells, 1.); // in any order: four
}
} // namespace
