// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/potential/volume_potential.h"

#include "../../laws/potential_scene.h"
#include "../../laws/volume_scene.h"
#include "simplex_samples.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

namespace signorini::contact
{
namespace
{
using namespace signorini::test;

template <typename Dimension>
class VolumePotentialTest : public ::testing::Test
{
};
TYPED_TEST_SUITE(VolumePotentialTest, testing::Dimensions);

template <int dim>
constexpr unsigned int n_lower_nodes = dim == 2 ? 16 : 64;

/// Two flat unit boxes of unlike material and mesh, 3 cells and 2 along each edge, one upon the other.
template <int dim>
ContactVolume<dim> make_slabs(Cells cells, double overlap, bool is_upper_finer = false)
{
  BoxBody<dim> lower, upper;
  (is_upper_finer ? upper : lower).n_faces = 3;
  upper.corner[dim - 1] = 1. - overlap;
  upper.youngs_modulus = 4e3;
  return BoxVolumeBuilder<dim>({lower, upper}, cells).volume;
}

template <int dim>
VolumePotential<dim> evaluate(const ContactVolume<dim> &volume, const Positions<dim> &positions,
                              const VolumePotentialSettings &settings = {})
{
  VolumePotential<dim> potential(volume, settings);
  potential.update(positions);
  potential.evaluate(positions);
  return potential;
}

/// σ = k_A d (1 − O(d/h)), the k_A of the surface potential: the elements' edges take part of the layer away.
TYPED_TEST(VolumePotentialTest, SlabsPushWithTheStiffnessOfTheSurfacePotential)
{
  constexpr int dim = TypeParam::value;
  constexpr double stiffness = 10. / (1. / 3. / 1e3 + .5 / 4e3);
  for (const Cells cells : {Cells::simplices, Cells::split})
    for (const double overlap : {1e-2, 1e-3, 1e-5})
    {
      const auto volume = make_slabs<dim>(cells, overlap);
      const auto potential = evaluate<dim>(volume, volume.reference_positions);
      const auto measures = potential.measure();
      const double force = measures.resultants[1][dim - 1], exact = stiffness * overlap;
      EXPECT_LT(force, exact);
      EXPECT_GT(force, exact * (1. - 30. * overlap)); // 10 d/h and less
      EXPECT_NEAR(potential.energy(), .5 * exact * overlap, 20. * overlap * exact * overlap);
      EXPECT_NEAR(measures.area, 1., 1e-9);
      EXPECT_NEAR(measures.max_penetration, overlap, .3 * overlap);
      EXPECT_NEAR(measures.max_penetration_over_thickness, 3. * overlap, overlap);
      EXPECT_NEAR(measures.max_pressure, exact, 1e-9 * exact);
      EXPECT_EQ(potential.pair_forces().bodies.at({0, 1}), measures.resultants[0]);
      EXPECT_LT((measures.resultants[0] + measures.resultants[1]).norm(), 1e-12 * force);
    }
}

/// Deepest, in their sizes, in the smaller elements lies a point on the face of the other body.
TYPED_TEST(VolumePotentialTest, DeepestIsThePointInTheThinnerElement)
{
  constexpr int dim = TypeParam::value;
  constexpr double overlap = 1e-3;
  for (const bool is_upper_finer : {false, true})
  {
    const auto volume = make_slabs<dim>(Cells::simplices, overlap, is_upper_finer);
    const auto measures = evaluate<dim>(volume, volume.reference_positions).measure();
    EXPECT_EQ(measures.deepest_body, is_upper_finer ? 0u : 1u);
    EXPECT_NEAR(measures.deepest_thickness, 1. / 3., 1e-14);
    EXPECT_NEAR(measures.deepest_position[dim - 1], is_upper_finer ? 1. : 1. - overlap, 1e-14);
  }
}

/// Elements that sink into others are seen to their middle, deeper than their force turns round.
TYPED_TEST(VolumePotentialTest, DepthsAreSeenUntilElementsAreSunk)
{
  constexpr int dim = TypeParam::value;
  for (const Cells cells : {Cells::simplices, Cells::split})
    for (const double overlap : {.02, .04, .1, .3, .6})
    {
      const auto volume = make_slabs<dim>(cells, overlap);
      const auto measures = evaluate<dim>(volume, volume.reference_positions).measure();
      EXPECT_GE(measures.max_penetration_over_thickness, .999 * std::min(3. * overlap, .5));
      EXPECT_LE(measures.max_penetration, overlap * (1. + 1e-9));
    }
}

/// Laid exactly upon each other: nothing acts, but the tangent holds them with k_A.
TYPED_TEST(VolumePotentialTest, TouchingSlabsHoldEachOther)
{
  constexpr int dim = TypeParam::value;
  const auto volume = make_slabs<dim>(Cells::simplices, 0.);
  const auto potential = evaluate<dim>(volume, volume.reference_positions);
  EXPECT_EQ(potential.measure().n_active, 0u);
  EXPECT_EQ(potential.energy(), 0.);
  const auto tangent = compute_tangent(potential, volume.n_nodes());
  Eigen::VectorXd up = Eigen::VectorXd::Zero(tangent.cols());
  for (unsigned int node = n_lower_nodes<dim>; node < volume.n_nodes(); ++node)
    up[dim * node + dim - 1] = 1.;
  EXPECT_NEAR(up.dot(tangent * up), 10. / (1. / 3. / 1e3 + .5 / 4e3), 1e-2);
}

TYPED_TEST(VolumePotentialTest, HeightsOfBoxes)
{
  constexpr int dim = TypeParam::value;
  const auto cut = make_slabs<dim>(Cells::simplices, 0.), split = make_slabs<dim>(Cells::split, 0.);
  EXPECT_EQ(cut.simplices.size(), dim == 2 ? 26u : 210u);
  EXPECT_EQ(split.simplices.size(), dim == 2 ? 52u : 840u);
  for (const auto *volume : {&cut, &split})
  {
    const auto positions = volume->vertex_positions(volume->reference_positions);
    std::array<double, 2> volumes{0., 0.};
    for (const auto &simplex : volume->simplices)
    {
      std::array<SpatialVector<dim>, dim + 1> x;
      for (unsigned int a = 0; a <= dim; ++a)
        x[a] = positions[simplex.vertices[a]];
      volumes[simplex.body] += measure_simplex<dim>(x);
      bool touches_surface = false;
      for (unsigned int axis = 0; axis < dim; ++axis)
        for (const double side : {0., 1.})
        {
          unsigned int n_on_side = 0;
          for (unsigned int a = 0; a <= dim; ++a)
            n_on_side += std::abs(x[a][axis] - (axis == dim - 1 ? simplex.body : 0.) - side) < 1e-12;
          touches_surface = touches_surface || n_on_side > 0;
          if (n_on_side == dim)
          {
            EXPECT_NEAR(simplex.height, simplex.layer_thickness * (volume == &cut ? 1. : .5), 1e-14);
          }
        }
      if (touches_surface)
      {
        EXPECT_NEAR(simplex.layer_thickness, simplex.body == 0 ? 1. / 3. : .5, 1e-14);
      }
    }
    EXPECT_NEAR(volumes[0], 1., 1e-14);
    EXPECT_NEAR(volumes[1], 1., 1e-14);
  }
}

template <int dim>
double distance_of_boxes(const ContactVolume<dim> &volume, const Positions<dim> &positions,
                         unsigned int first, unsigned int second)
{
  std::array<BoundingBox<dim>, 2> boxes;
  for (unsigned int a = 0; a <= dim; ++a)
  {
    boxes[0].extend(positions[volume.simplices[first].vertices[a]]);
    boxes[1].extend(positions[volume.simplices[second].vertices[a]]);
  }
  return boxes[0].exteriorDistance(boxes[1]);
}

/// All pairs that overlap after less than half a skin of motion are in the list, and none that is far.
TYPED_TEST(VolumePotentialTest, SearchFindsEveryOverlapUntilItIsStale)
{
  constexpr int dim = TypeParam::value;
  for (const Cells cells : {Cells::simplices, Cells::split})
  {
    VolumeScene<dim> scene({dim, cells});
    constexpr double skin = .05;
    SimplexSearch<dim> search(scene.volume, skin, [](unsigned int, unsigned int) { return true; });
    EXPECT_TRUE(search.is_stale(scene.positions));
    search.rebuild(scene.positions);
    const std::set<std::pair<unsigned int, unsigned int>> pairs(search.pairs().begin(), search.pairs().end());
    const auto vertices = scene.volume.vertex_positions(scene.positions);
    for (const auto &[first, second] : pairs)
      EXPECT_LE(distance_of_boxes<dim>(scene.volume, vertices, first, second), std::sqrt(dim) * skin);

    RandomVectors<dim> random(9);
    Positions<dim> moved = scene.positions;
    for (auto &x : moved)
      x += .499 * skin * random.vector(1.).normalized();
    EXPECT_FALSE(search.is_stale(moved));
    const auto moved_vertices = scene.volume.vertex_positions(moved);
    unsigned int n_overlaps = 0;
    const auto shape = [&](unsigned int simplex)
    {
      std::array<SpatialVector<dim>, dim + 1> x;
      for (unsigned int a = 0; a <= dim; ++a)
        x[a] = moved_vertices[scene.volume.simplices[simplex].vertices[a]];
      return make_simplex_shape<dim>(x);
    };
    for (unsigned int i = 0; i < scene.volume.simplices.size(); ++i)
      for (unsigned int j = 0; j < scene.volume.simplices.size(); ++j)
        if (scene.volume.simplices[i].body < scene.volume.simplices[j].body &&
            distance_of_boxes<dim>(scene.volume, moved_vertices, i, j) == 0. &&
            !make_overlap(shape(i), shape(j)).is_empty())
        {
          EXPECT_EQ(pairs.count({i, j}), 1u);
          ++n_overlaps;
        }
    EXPECT_GT(n_overlaps, 3u);
    moved[0] = scene.positions[0] + .501 * skin * SpatialVector<dim>::Unit(0);
    EXPECT_TRUE(search.is_stale(moved));
  }
}

TYPED_TEST(VolumePotentialTest, RowSumBoundHoldsUntilTheNextSearch)
{
  constexpr int dim = TypeParam::value;
  const auto largest_eigenvalue = [](const VolumePotential<dim> &potential, std::size_t n)
  {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(compute_tangent(potential, n),
                                                                Eigen::EigenvaluesOnly);
    return solver.eigenvalues().maxCoeff();
  };
  for (const Cells cells : {Cells::simplices, Cells::split})
    for (const double overlap : {.003, 0., -.002})
    {
      const auto volume = make_slabs<dim>(cells, overlap);
      auto potential = evaluate<dim>(volume, volume.reference_positions);
      const auto bounds = bound_stiffness<dim>(potential, volume.n_nodes());
      const double bound = *std::max_element(bounds.begin(), bounds.end());
      RandomVectors<dim> random(10);
      double largest = largest_eigenvalue(potential, volume.n_nodes());
      for (unsigned int trial = 0; trial < testing::count_cases(10); ++trial)
      {
        // Both bodies towards each other, not far enough for another search.
        const double way = random.number(.001, .002);
        Positions<dim> x =
            test::shifted<dim>(volume.reference_positions, random.field(volume.n_nodes(), .001), 1.);
        for (unsigned int node = 0; node < volume.n_nodes(); ++node)
          x[node][dim - 1] += node < n_lower_nodes<dim> ? way : -way;
        ASSERT_FALSE(potential.is_stale(x));
        potential.evaluate(x);
        largest = std::max(largest, largest_eigenvalue(potential, volume.n_nodes()));
      }
      EXPECT_LE(largest, bound);
      EXPECT_GE(largest, .03 * bound) << "a bound that bounds anything is of no use";
    }
}

TYPED_TEST(VolumePotentialTest, ExcludedBodiesPassThroughEachOther)
{
  constexpr int dim = TypeParam::value;
  const auto volume = make_slabs<dim>(Cells::simplices, .1);
  VolumePotentialSettings settings;
  settings.excluded_body_pairs = {{1, 0}};
  EXPECT_EQ(evaluate<dim>(volume, volume.reference_positions, settings).measure().n_pairs, 0u);
}

TYPED_TEST(VolumePotentialTest, RejectsWhatMakesNoSense)
{
  constexpr int dim = TypeParam::value;
  auto volume = make_slabs<dim>(Cells::simplices, .1);
  const auto make = [&](double penalty_factor, double skin) {
    return VolumePotential<dim>(volume, {penalty_factor, skin, {}});
  };
  EXPECT_NO_THROW(make(1., .1));
  EXPECT_THROW(make(0., .1), std::invalid_argument);
  EXPECT_THROW(make(1., 0.), std::invalid_argument);
  volume.simplices[3].height = 0.;
  EXPECT_THROW(make(1., .1), std::invalid_argument);
}
} // namespace
} // namespace signorini::contact
