// SPDX-License-Identifier: LGPL-2.1-or-later
#include "built_scene.h"

#include "signorini/base/to_eigen.h"
#include "signorini/contact/coupling/facet_exchange.h"
#include "signorini/contact/geometry/segments.h"
#include "signorini/discretization/placement.h"

using namespace signorini;
using namespace signorini::test;

namespace
{
/// Area and Σ area normals of one body's facets, and whether all normals point away from `centre`.
template <int dim>
struct SurfaceSums
{
  double area = 0.;
  SpatialVector<dim> area_normal = SpatialVector<dim>::Zero();
  bool do_normals_point_out = true;

  SurfaceSums(const ContactSurface<dim> &surface, unsigned int body, const SpatialVector<dim> &centre)
  {
    for (const Facet<dim> &facet : surface.facets)
      if (facet.body == body)
        for (const auto &point : contact::make_gauss_points<dim>(facet.type, 5))
        {
          const auto frame = contact::evaluate_facet_frame(
              contact::gather_nodes(facet, surface.reference_positions), point.xi);
          area += point.weight * frame.area_normal.norm();
          area_normal += point.weight * frame.area_normal;
          do_normals_point_out =
              do_normals_point_out && frame.area_normal.dot(surface.origin + frame.position - centre) > 0.;
        }
  }
};

template <typename T>
class SurfaceMaps : public testing::Test
{
};
TYPED_TEST_SUITE(SurfaceMaps, AllCases);

TYPED_TEST(SurfaceMaps, GradedTurnedBoxIsClosedAndHasItsArea)
{
  constexpr int dim = TypeParam::dim;
  BodyParameters box = graded(make_box("box", {2., 1.5, 1.}, {3, 2, 2}), {2., 1.5, 1.}, 2);
  box.placement.rotation_angle = 50.;
  box.placement.rotation_axis = {1., 1., 0.};
  BodyParameters other = make_box("other", {1., 1., 1.}, {1, 1, 1});
  other.placement.shift = {10., 0., 0.};
  BuiltScene<dim> built({box, other}, TypeParam::degree);
  SpatialVector<dim> centre = SpatialVector<dim>::Zero();
  unsigned int n = 0;
  for (const OwnedNode<dim> &node : built.discretization.owned_nodes)
    if (node.body == 0)
    {
      ++n;
      for (unsigned int d = 0; d < dim; ++d)
        centre[d] += node.position[d];
    }
  const SurfaceSums<dim> sums(built.map.surface(), 0, centre / n);
  const double area = dim == 2 ? 2. * (2. + 1.5) : 2. * (2. * 1.5 + 2. + 1.5);
  EXPECT_NEAR(sums.area, area, 1e-12 * area);
  EXPECT_LT(sums.area_normal.norm(), 1e-13 * area);
  EXPECT_TRUE(sums.do_normals_point_out);
  SpatialVector<dim> other_centre = SpatialVector<dim>::Constant(.5);
  other_centre[0] += 10.;
  const SurfaceSums<dim> other_sums(built.map.surface(), 1, other_centre);
  EXPECT_NEAR(other_sums.area, 2. * dim, 1e-13);
  EXPECT_TRUE(other_sums.do_normals_point_out);
}

TYPED_TEST(SurfaceMaps, BoxOfSimplicesIsClosedAndHasItsArea)
{
  constexpr int dim = TypeParam::dim;
  BodyParameters box = make_simplex_box("box", dim, {2., 1.5, 1.}, {3, 2, 2});
  box.placement.rotation_angle = 50.;
  box.placement.rotation_axis = {1., 1., 0.};
  BuiltScene<dim> built({make_box("other", {1., 1., 1.}, {1, 1, 1}), box}, TypeParam::degree);
  Placement<dim> placement(box.placement);
  dealii::Point<dim> middle;
  for (unsigned int d = 0; d < dim; ++d)
    middle[d] = .5 * box.mesh.upper_corner[d];
  const SurfaceSums<dim> sums(built.map.surface(), 1, to_eigen<dim>(placement.place(middle)));
  const double area = dim == 2 ? 2. * (2. + 1.5) : 2. * (2. * 1.5 + 2. + 1.5);
  EXPECT_NEAR(sums.area, area, 1e-12 * area);
  EXPECT_LT(sums.area_normal.norm(), 1e-13 * area);
  EXPECT_TRUE(sums.do_normals_point_out);
  // Blocks of 2/3 × 3/4 × 1/2: a cell's height over an outer face is the block's edge across it.
  for (const Facet<dim> &facet : built.map.surface().facets)
    if (facet.body == 1)
    {
      const std::array<double, 3> edges{2. / 3., .75, .5};
      EXPECT_TRUE(std::any_of(edges.begin(), edges.begin() + dim,
                              [&](double edge) { return std::abs(facet.layer_thickness - edge) < 1e-12; }))
          << facet.layer_thickness;
    }
}

TYPED_TEST(SurfaceMaps, AreaOfASphereConverges)
{
  constexpr int dim = TypeParam::dim;
  const double exact = dim == 2 ? 2. * M_PI : 4. * M_PI;
  std::array<double, 2> errors;
  for (unsigned int level = 0; level < 2; ++level)
  {
    BuiltScene<dim> built({make_ball("ball", 1., level + (dim == 2 ? 2 : 1))}, TypeParam::degree);
    const SurfaceSums<dim> sums(built.map.surface(), 0, SpatialVector<dim>::Zero());
    errors[level] = std::abs(sums.area - exact) / exact;
    EXPECT_LT(sums.area_normal.norm(), 1e-13);
    EXPECT_TRUE(sums.do_normals_point_out);
  }
  EXPECT_LT(errors[1], .035);
  EXPECT_LT(errors[1], errors[0] / (TypeParam::degree == 1 ? 3.5 : 12.));
}

TYPED_TEST(SurfaceMaps, BallWithHangingNodesOnItsSurfaceIsClosed)
{
  constexpr int dim = TypeParam::dim;
  BuiltScene<dim> built({graded(make_ball("ball", 1., 1), {1., 0., 0.}, 2, .3)}, TypeParam::degree);
  ASSERT_FALSE(built.discretization.hanging_dofs.empty());
  const SurfaceSums<dim> sums(built.map.surface(), 0, SpatialVector<dim>::Zero());
  EXPECT_LT(sums.area_normal.norm(), 1e-13 * sums.area);
  EXPECT_TRUE(sums.do_normals_point_out);
}

TYPED_TEST(SurfaceMaps, PartsOfBallsAreClosedAndPointOut)
{
  constexpr int dim = TypeParam::dim;
  for (const auto part : {MeshParameters::Part::half, MeshParameters::Part::orthant})
  {
    BodyParameters ball = make_ball("ball", 1., 1);
    ball.mesh.part = part;
    BuiltScene<dim> built({ball}, TypeParam::degree);
    SpatialVector<dim> centre = SpatialVector<dim>::Constant(part == MeshParameters::Part::half ? 0. : .3);
    centre[dim - 1] = .3;
    const SurfaceSums<dim> sums(built.map.surface(), 0, centre);
    EXPECT_LT(sums.area_normal.norm(), 1e-13);
    EXPECT_TRUE(sums.do_normals_point_out);
  }
}

TYPED_TEST(SurfaceMaps, FacetsKnowTheLayerBehindThem)
{
  constexpr int dim = TypeParam::dim;
  BodyParameters box = make_box("box", {2., 1.5, 1.}, {4, 5, 8});
  box.placement.rotation_angle = 20.;
  box.placement.scale = 3.;
  BuiltScene<dim> built({make_box("first", {9., 9., 9.}, {1, 1, 1}), box}, TypeParam::degree,
                        [](Parameters &p)
                        {
                          p.bodies[0].mesh.lower_corner = {8., 8., 8.};
                          p.bodies[1].material.youngs_modulus = 77.;
                          p.bodies[1].material.density = 5.;
                        });
  const std::array<double, 3> thickness{1.5, .9, .375};
  std::array<unsigned int, 3> n_found{};
  for (const Facet<dim> &facet : built.map.surface().facets)
    if (facet.body == 0) // one cell
    {
      EXPECT_NEAR(facet.room, .5 * facet.layer_thickness, 1e-12);
    }
    else
    {
      EXPECT_EQ(facet.room, facet.layer_thickness);
      EXPECT_EQ(facet.degree, TypeParam::degree);
      EXPECT_EQ(facet.youngs_modulus, 77.);
      EXPECT_EQ(facet.density, 5.);
      for (unsigned int d = 0; d < dim; ++d)
        n_found[d] += std::abs(facet.layer_thickness - thickness[d]) < 1e-12;
    }
  const std::array<unsigned int, 3> expected =
      dim == 2 ? std::array<unsigned int, 3>{10, 8, 0} : std::array<unsigned int, 3>{80, 64, 40};
  EXPECT_EQ(n_found, expected);
}

TYPED_TEST(SurfaceMaps, GatherAndAddAreTransposes)
{
  constexpr int dim = TypeParam::dim;
  BuiltScene<dim> built({make_graded_cube()}, TypeParam::degree);
  const Vector u = built.random_vector(1.);
  const auto gathered = built.map.gather(u);
  std::vector<SpatialVector<dim>> nodal(gathered.size());
  double product = 0.;
  for (unsigned int node = 0; node < nodal.size(); ++node)
  {
    for (unsigned int d = 0; d < dim; ++d)
      nodal[node][d] = std::sin(1. + 3. * node + d);
    product += nodal[node].dot(gathered[node]);
  }
  Vector forces = built.discretization.make_vector();
  built.map.add_to_owners(nodal, forces);
  built.discretization.collect(forces);
  EXPECT_NEAR(forces * u, product, 1e-12 * nodal.size());
}

TYPED_TEST(SurfaceMaps, NodesStandWhereTheirDofsDo)
{
  constexpr int dim = TypeParam::dim;
  BuiltScene<dim> built({make_graded_cube(), make_ball("ball", .3, 0)}, TypeParam::degree);
  Vector displacement = built.discretization.make_vector();
  for (const OwnedNode<dim> &node : built.discretization.owned_nodes)
    for (unsigned int d = 0; d < dim; ++d)
      displacement.local_element(node.dofs[d]) = -node.position[d];
  for (const SpatialVector<dim> &x : built.map.positions(displacement))
    EXPECT_LT((x + built.map.surface().origin).norm(), 1e-15) << "all have gone to the point 0";
}

/// Two boxes of several ranks, the upper one `gap` above the lower one, and the lower one's map with the
/// facets of the other one that come within a margin of its own.
template <int dim, unsigned int degree>
struct SharedBoxes
{
  static constexpr double margin = .15;

  explicit SharedBoxes(double gap)
      : built({make_box("lower", {2., 2., 1.}, {4, 4, 2}), make_upper(gap)}, degree), map(built.map)
  {
    boxes = make_own_boxes(map, map.surface().reference_positions);
    for (unsigned int f = 0; f < boxes.size(); ++f)
    {
      const SpatialVector<dim> margins = SpatialVector<dim>::Constant(margin);
      queries.push_back({{boxes[f].min() - margins, boxes[f].max() + margins}, map.surface().facets[f].body});
    }
    hold_facets<dim>(
        queries, boxes, [](unsigned int body, unsigned int other) { return body != other; }, MPI_COMM_WORLD,
        map);
  }

  static BodyParameters make_upper(double gap)
  {
    BodyParameters upper = make_box("upper", {2., 2., 1.}, {3, 3, 2});
    upper.placement.shift = {.1, .2, 0.};
    upper.placement.shift[dim - 1] = (dim == 2 ? 2. : 1.) + gap;
    return upper;
  }

  BuiltScene<dim> built;
  SurfaceMap<dim> map;
  std::vector<contact::BoundingBox<dim>> boxes;
  std::vector<contact::FacetQuery<dim>> queries;
};

template <typename T>
class SurfaceMapsOnRanks : public testing::Test
{
};
TYPED_TEST_SUITE(SurfaceMapsOnRanks, AllCases);

TYPED_TEST(SurfaceMapsOnRanks, FacetsThatAreNearAreHeldAndNoOthers)
{
  constexpr int dim = TypeParam::dim;
  for (const double gap : {.1, .5})
  {
    const SharedBoxes<dim, TypeParam::degree> shared(gap);
    // All facets of all ranks: number, body, corners of the box.
    std::vector<double> own;
    for (unsigned int f = 0; f < shared.boxes.size(); ++f)
    {
      const Facet<dim> &facet = shared.map.surface().facets[f];
      own.insert(own.end(), {double(facet.number), double(facet.body)});
      own.insert(own.end(), shared.boxes[f].min().begin(), shared.boxes[f].min().end());
      own.insert(own.end(), shared.boxes[f].max().begin(), shared.boxes[f].max().end());
    }
    std::set<unsigned int> expected, held;
    const auto all = dealii::Utilities::MPI::all_gather(MPI_COMM_WORLD, own);
    for (unsigned int rank = 0; rank < all.size(); ++rank)
      for (std::size_t i = 0; i < all[rank].size(); i += 2 + 2 * dim)
        if (rank != dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD))
          for (const auto &query : shared.queries)
            if (query.body != all[rank][i + 1] &&
                query.box.intersects(contact::BoundingBox<dim>(
                    SpatialVector<dim>(Eigen::Map<const SpatialVector<dim>>(&all[rank][i + 2])),
                    SpatialVector<dim>(Eigen::Map<const SpatialVector<dim>>(&all[rank][i + 2 + dim])))))
              expected.insert(static_cast<unsigned int>(all[rank][i]));
    const auto &facets = shared.map.surface().facets;
    for (unsigned int f = 0; f < facets.size(); ++f)
    {
      EXPECT_EQ(facets[f].owned, f < shared.map.n_own_facets());
      if (!facets[f].owned)
        held.insert(facets[f].number);
    }
    EXPECT_EQ(held, expected);
    EXPECT_EQ(held.size(), facets.size() - shared.map.n_own_facets()) << "each once";
    const std::size_t n_held = dealii::Utilities::MPI::sum(held.size(), MPI_COMM_WORLD);
    const bool is_near = gap < SharedBoxes<dim, TypeParam::degree>::margin;
    EXPECT_EQ(n_held > 0, is_near && all.size() > 1);
  }
}

TYPED_TEST(SurfaceMapsOnRanks, GatherAndAddAreTransposesWithFacetsOfOthers)
{
  constexpr int dim = TypeParam::dim;
  SharedBoxes<dim, TypeParam::degree> shared(.1);
  const Vector u = shared.built.random_vector(1.);
  const auto gathered = shared.map.gather(u);
  ASSERT_EQ(gathered.size(), shared.map.surface().n_nodes());
  std::vector<SpatialVector<dim>> nodal(gathered.size());
  double product = 0.;
  for (unsigned int node = 0; node < nodal.size(); ++node)
  {
    for (unsigned int d = 0; d < dim; ++d)
      nodal[node][d] = std::sin(1. + 3. * node + d);
    product += nodal[node].dot(gathered[node]);
  }
  Vector forces = shared.built.discretization.make_vector();
  shared.map.add_to_owners(nodal, forces);
  shared.built.discretization.collect(forces);
  product = dealii::Utilities::MPI::sum(product, MPI_COMM_WORLD);
  EXPECT_NEAR(forces * u, product, 1e-12 * shared.map.n_all_facets());
}

TYPED_TEST(SurfaceMapsOnRanks, WhatNodesHaveIsCombinedOverRanks)
{
  constexpr int dim = TypeParam::dim;
  const SharedBoxes<dim, TypeParam::degree> shared(.1);
  const auto x = shared.map.positions(shared.built.discretization.make_vector());
  EXPECT_EQ(shared.map.extend(x), x) << "what own nodes have comes to all that are held";
  std::vector<double> ones(x.size(), 1.),
      ranks(x.size(), dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD));
  shared.map.sum(ones);
  shared.map.maximize(ranks);
  const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  double largest = 0.;
  for (unsigned int node = 0; node < x.size(); ++node)
  {
    EXPECT_GE(ones[node], 1.);
    EXPECT_LE(ones[node], n_ranks);
    EXPECT_LT(ranks[node], n_ranks);
    largest = std::max(largest, ones[node]);
    if (ones[node] == n_ranks)
    {
      EXPECT_EQ(ranks[node], n_ranks - 1.) << "the last rank holds it, too";
    }
  }
  EXPECT_EQ(dealii::Utilities::MPI::max(largest, MPI_COMM_WORLD) > 1., n_ranks > 1) << "nodes between ranks";
}
} // namespace
