// SPDX-License-Identifier: LGPL-2.1-or-later
// What a body does to itself, where the answer is exact.
#include "law_suites.h"
#include "voxel_surface.h"

#include <set>

using namespace signorini;
using namespace signorini::contact;
using namespace signorini::test;

namespace
{
template <int dim>
ContactPotential<dim> make_potential_at(const ContactSurface<dim> &surface, Integration integration,
                                        const Positions<dim> &x)
{
  PotentialSettings settings;
  settings.integration = integration;
  settings.self_contact = {0};
  ContactPotential<dim> potential(surface, {}, settings);
  potential.update(x);
  potential.evaluate(x);
  return potential;
}

/// A C of 8 cells whose upper arm is bent down over two cells until the rest of it, 5 cells of unit width,
/// lies on the lower one.
template <int dim>
Positions<dim> close(const VoxelSurface<dim> &c, double overlap)
{
  return c.positions(
      [overlap](const auto &lattice)
      {
        SpatialVector<dim> x = lattice_point<dim>(lattice);
        if (lattice[dim - 1] > 1)
          x[dim - 1] -= (1. + overlap) * std::min(1., .5 * std::max(0., x[0] - 1.));
        return x;
      });
}

template <typename Dimension>
class SelfContact : public testing::Test
{
};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(SelfContact, Dimensions);

constexpr std::array<Integration, 2> integrations{{Integration::face_quadrature, Integration::face_segments}};

/// Depth, pressure and energy of arms that lie flat upon each other.
TYPED_TEST(SelfContact, ArmsThatMeetPressWithTheirOverlap)
{
  constexpr int dim = TypeParam::value;
  const VoxelSurface<dim> c(make_c<dim>(8));
  for (const Integration integration : integrations)
    for (const double overlap : {1e-6, .05, .4})
    {
      const auto potential = make_potential_at<dim>(c.surface, integration, close<dim>(c, overlap));
      const ContactMeasures<dim> measures = potential.measure();
      const double stiffness = 10. * 1e3 / 2.; // α E / 2h
      EXPECT_NEAR(measures.max_penetration, overlap, 1e-12);
      EXPECT_NEAR(measures.max_pressure, stiffness * overlap, 1e-9 * stiffness * overlap);
      // Where the arm slopes a strip touches as well, and beside an edge the way out is shorter; both are of
      // the order of the overlap.
      const double area = 5. * (dim == 2 ? 1. : 3.), energy = .5 * stiffness * overlap * overlap * area;
      EXPECT_NEAR(potential.energy(), energy, 2. * overlap * energy);
      EXPECT_LT(measures.resultants[0].norm(), 1e-12 * stiffness * overlap);
      EXPECT_TRUE(potential.pair_forces({}).bodies.empty());
      for (const auto &sample : potential.samples())
        EXPECT_TRUE(sample.depth < 0. || c.centres[sample.facet][dim - 1] == 1. ||
                    c.centres[sample.facet][dim - 1] == 2.);
    }
}

TYPED_TEST(SelfContact, IsNoneBeforeTheGapCloses)
{
  constexpr int dim = TypeParam::value;
  const VoxelSurface<dim> c(make_c<dim>(8));
  for (const Integration integration : integrations)
    for (const double gap : {1e-6, .1, .5, 1.})
    {
      const auto potential = make_potential_at<dim>(c.surface, integration, close<dim>(c, -gap));
      EXPECT_EQ(potential.energy(), 0.);
      EXPECT_EQ(potential.measure().n_active, 0u);
    }
}

TYPED_TEST(SelfContact, IsOffUnlessAskedFor)
{
  constexpr int dim = TypeParam::value;
  const VoxelSurface<dim> c(make_c<dim>(8));
  const auto x = close<dim>(c, .05);
  ContactPotential<dim> potential(c.surface, {}, PotentialSettings());
  potential.update(x);
  potential.evaluate(x);
  EXPECT_EQ(potential.measure().n_pairs, 0u);
  EXPECT_TRUE(potential.pair_list().neighbours().empty());
}

/// Faces of a slit whose height is nothing beside an element.
TYPED_TEST(SelfContact, SlitsClose)
{
  constexpr int dim = TypeParam::value;
  auto slit = make_c<dim>(8);
  slit.place = [](const auto &lattice)
  {
    SpatialVector<dim> x = lattice_point<dim>(lattice);
    x[dim - 1] -= lattice[dim - 1] > 1 ? 1. - 1e-6 : 0.;
    return x;
  };
  const VoxelSurface<dim> body(slit);
  for (const Integration integration : integrations)
  {
    EXPECT_EQ(make_potential_at<dim>(body.surface, integration, body.surface.reference_positions).energy(),
              0.);
    const auto potential = make_potential_at<dim>(body.surface, integration, close<dim>(body, .05));
    EXPECT_NEAR(potential.measure().max_penetration, .05, 1e-12);
    EXPECT_NEAR(potential.energy(), .5 * 5e3 * .05 * .05 * 5. * (dim == 2 ? 1. : 3.), 2.);
  }
}

/// Bent, twisted, squashed to six tenths or stretched: nothing of a thin wall touches anything.
TYPED_TEST(SelfContact, AWallThatDoesNotFoldFeelsNothing)
{
  constexpr int dim = TypeParam::value;
  const VoxelSurface<dim> wall(make_wall<dim>(9));
  const auto &reference = wall.surface.reference_positions;
  RandomVectors<dim> random(3);
  for (const Integration integration : integrations)
    for (const double curvature : {0., .1, .35})
      for (const double thickness : {.6, 1., 1.5})
      {
        auto x = reference;
        for (std::size_t i = 0; i < x.size(); ++i)
        {
          const double height = thickness * x[i][dim - 1], along = x[i][0];
          if (curvature > 0.)
          {
            x[i][0] = (1. / curvature + height) * std::sin(curvature * along);
            x[i][dim - 1] = (1. / curvature + height) * std::cos(curvature * along);
          }
          else
            x[i][dim - 1] = height;
        }
        x = shifted<dim>(x, random.field(x.size(), .05), 1.);
        const auto potential = make_potential_at<dim>(wall.surface, integration, x);
        EXPECT_EQ(potential.measure().n_active, 0u);
        EXPECT_EQ(norm<dim>(compute_forces(potential, x.size())), 0.);
      }
}

/// Fills blocks of 2 × 2 (× 2) cells until no two cells, and no two gaps, meet in an edge or a corner only.
template <int dim>
void thicken(std::map<std::array<unsigned int, dim>, bool> &filled)
{
  constexpr unsigned int n_cells = 1u << dim;
  for (bool is_any_changed = true; is_any_changed;)
  {
    is_any_changed = false;
    for (const auto &[corner, unused] : filled)
    {
      std::array<bool *, n_cells> cells{};
      for (unsigned int i = 0; i < n_cells; ++i)
      {
        auto place = corner;
        for (unsigned int d = 0; d < dim; ++d)
          place[d] += i >> d & 1;
        const auto cell = filled.find(place);
        cells[i] = cell == filled.end() ? nullptr : &cell->second;
      }
      if (std::count(cells.begin(), cells.end(), nullptr) > 0)
        continue;
      // Numbers flow through the sides of like cells until all that hang together have the same one.
      std::array<unsigned int, n_cells> number;
      for (unsigned int i = 0; i < n_cells; ++i)
        number[i] = i;
      for (unsigned int sweep = 0; sweep < n_cells; ++sweep)
        for (unsigned int i = 0; i < n_cells; ++i)
          for (unsigned int d = 0; d < dim; ++d)
            if (const unsigned int other = i ^ (1u << d); *cells[i] == *cells[other])
              number[i] = number[other] = std::min(number[i], number[other]);
      for (unsigned int i = 0; i < n_cells; ++i)
        for (unsigned int k = 0; k < i; ++k)
          if (*cells[i] == *cells[k] && number[i] != number[k])
          {
            for (bool *cell : cells)
              *cell = true;
            is_any_changed = true;
          }
    }
  }
}

/// Whatever its shape, with thin walls, pits, narrow gaps and flat cells: a body as it was made does not
/// touch itself, nor does one that is hardly deformed.
TYPED_TEST(SelfContact, NoShapeTouchesItselfAsItIs)
{
  constexpr int dim = TypeParam::value;
  RandomVectors<dim> random(5);
  std::size_t n_facets = 0;
  for (unsigned int trial = 0; trial < (dim == 2 ? 200 : 60); ++trial)
  {
    VoxelBody<dim> body;
    body.n_cells.fill(dim == 2 ? 7 : 5);
    if (dim == 3 && trial % 2 == 1)
      body.type = FacetType::triangle;
    std::map<typename VoxelBody<dim>::Lattice, bool> filled;
    body.is_filled = [&](const auto &cell)
    { return filled.emplace(cell, random.number(0., 1.) < .6).first->second; };
    (void)VoxelSurface<dim>(body);
    body.is_filled = [&filled](const auto &cell) { return filled.at(cell); };
    thicken<dim>(filled);
    std::array<std::array<double, 9>, dim> lines;
    for (auto &line : lines)
    {
      line[0] = 0.;
      for (unsigned int i = 1; i < line.size(); ++i)
        line[i] = line[i - 1] + std::pow(10., random.number(-1., 0.));
    }
    body.place = [&lines](const auto &lattice)
    {
      SpatialVector<dim> x;
      for (unsigned int d = 0; d < dim; ++d)
        x[d] = lines[d][lattice[d]];
      return x;
    };
    const VoxelSurface<dim> shape(body);
    n_facets += shape.surface.facets.size();
    for (const double bend : {0., .002})
    {
      const auto &x = shape.surface.reference_positions;
      const auto potential = make_potential_at<dim>(shape.surface, Integration::face_quadrature,
                                                    shifted<dim>(x, random.field(x.size(), bend), 1.));
      EXPECT_EQ(potential.measure().n_active, 0u) << "trial " << trial << ", bent by " << bend;
    }
  }
  EXPECT_GT(n_facets, 2000u);
}

/// A slit that ends in a line of nodes of both its sides: forces and tangent of facets that share nodes.
TYPED_TEST(SelfContact, ForcesAndTangentAreDerivativesWhereNodesAreShared)
{
  constexpr int dim = TypeParam::value;
  auto c = make_c<dim>(4);
  c.place = [](const auto &lattice)
  {
    SpatialVector<dim> x = lattice_point<dim>(lattice);
    x[dim - 1] -= lattice[dim - 1] > 1 ? 1. - .1 * std::max(0., x[0] - 1.) : 0.;
    return x;
  };
  VoxelSurface<dim> notch(c);
  auto &surface = notch.surface;
  auto x = surface.reference_positions;
  std::vector<Facet<dim>> facets;
  for (unsigned int f = 0; f < surface.facets.size(); ++f)
  {
    Facet<dim> facet = surface.facets[f];
    for (unsigned int &node : facet.nodes)
      for (unsigned int twin = 0; twin < node; ++twin)
        if ((x[node] - x[twin]).norm() < 1e-9)
          node = twin;
    if (notch.centres[f][dim - 1] != 1.5) // the back is flat there
      facets.push_back(facet);
  }
  surface.facets = facets;
  RandomVectors<dim> random(9);
  x = shifted<dim>(x, random.field(x.size(), .01), 1.);
  for (auto &position : x) // the upper side slopes by 0.1, and by −0.05 when it is turned down
    if (position[0] > 1. && position[dim - 1] > 1.03)
      position[dim - 1] -= .15 * (position[0] - 1.);
  for (const Integration integration : integrations)
  {
    auto potential = make_potential_at<dim>(surface, integration, x);
    bool is_any_shared = false;
    potential.for_each_overlap_above(0.,
                                     [&](const auto &near)
                                     {
                                       const auto begin = near.stencil.node.begin();
                                       const std::set<unsigned int> nodes(begin,
                                                                          begin + near.stencil.n_nodes);
                                       is_any_shared |= nodes.size() < near.stencil.n_nodes;
                                     });
    EXPECT_TRUE(is_any_shared);
    const auto forces = compute_forces(potential, x.size());
    const Eigen::MatrixXd tangent = compute_tangent(potential, x.size());
    potential.for_each_tangent(
        [](const auto &nodes, const auto &block)
        {
          EXPECT_EQ(std::set<unsigned int>(nodes.begin(), nodes.end()).size(), nodes.size());
          EXPECT_EQ(block.rows(), static_cast<Eigen::Index>(dim * nodes.size()));
        });
    EXPECT_LT(measure_imbalance<dim>(x, forces), 1e-12 * norm<dim>(forces));
    for (unsigned int trial = 0; trial < 4; ++trial)
    {
      constexpr double step = 1e-7; // so that no point crosses a ridge of depth
      const auto direction = random.field(x.size(), 1.);
      const auto evaluate = [&](double t)
      {
        potential.evaluate(shifted<dim>(x, direction, t));
        return std::pair(potential.energy(),
                         Eigen::VectorXd(flatten<dim>(compute_forces(potential, x.size()))));
      };
      const auto ahead = evaluate(step), behind = evaluate(-step);
      EXPECT_NEAR((ahead.first - behind.first) / (2. * step), -dot<dim>(forces, direction),
                  1e-6 * norm<dim>(forces));
      const Eigen::VectorXd expected = -tangent * flatten<dim>(direction);
      EXPECT_LT(((ahead.second - behind.second) / (2. * step) - expected).norm(), 1e-5 * expected.norm());
    }
  }
}

/// A long wall rolled up until it lies upon itself: there is contact, and it is the overlap's.
TYPED_TEST(SelfContact, AWallThatIsRolledUpTouchesItself)
{
  constexpr int dim = TypeParam::value;
  constexpr unsigned int length = 60;
  VoxelBody<dim> strip = make_wall<dim>(length);
  if (dim == 3)
    strip.n_cells[1] = 2;
  const VoxelSurface<dim> wall(strip);
  for (const double pitch : {1.1, .9}) // from turn to turn; the wall is 1 thick
  {
    auto x = wall.surface.reference_positions;
    for (auto &position : x)
    {
      // The arc of a spiral of radius 4 + pitch angle/2π grows about as angle times the mean radius.
      const double slope = pitch / (2. * 3.14159265358979323846);
      const double angle = (std::sqrt(16. + 2. * slope * position[0]) - 4.) / slope;
      const double radius = 4. + slope * angle + position[dim - 1];
      position[0] = radius * std::sin(angle);
      position[dim - 1] = radius * std::cos(angle);
    }
    const auto potential = make_potential_at<dim>(wall.surface, Integration::face_quadrature, x);
    const ContactMeasures<dim> measures = potential.measure();
    EXPECT_EQ(measures.n_active > 0, pitch < 1.);
    if (pitch < 1.)
    {
      EXPECT_NEAR(measures.max_penetration, .1, .05);
      const auto forces = compute_forces(potential, x.size());
      EXPECT_LT(measure_imbalance<dim>(x, forces), 1e-12 * norm<dim>(forces));
    }
  }
}
} // namespace
