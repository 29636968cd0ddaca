// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/adaptivity/motion_marking.h"

#include "signorini/adaptivity/motion_transfer.h"

#include "../contact_bodies.h"

using namespace signorini;
using namespace signorini::test;

namespace
{
template <typename T>
class MotionMarking : public testing::Test
{
};
TYPED_TEST_SUITE(MotionMarking, LinearCases);

/// Whether any cell of a ball 2 above a floor is near contact within 1 s while the floor rises, 1 s after the
/// start.
template <int dim>
bool is_met_by_floor(const std::string &height)
{
  BodyParameters ball = make_ball("ball", 1., 1);
  ball.placement.shift[dim - 1] = 3.;
  const BuiltScene<dim> built({ball}, 1,
                              [&](Parameters &p)
                              {
                                p.obstacles = {make_floor<dim>(0.)};
                                p.obstacles[0].displacement.assign(dim, "0");
                                p.obstacles[0].displacement[dim - 1] = height;
                              });
  State state = built.state;
  state.time = 1.;
  const std::vector<bool> is_near =
      find_cells_near_contact(built.scene, ContactParameters(), built.discretization, built.map,
                              collect_boundary_faces(built.discretization, &built.map),
                              FileLevels<dim>(built.parameters.bodies), state, 1.);
  const int is_any = std::count(is_near.begin(), is_near.end(), true) > 0 ? 1 : 0;
  return dealii::Utilities::MPI::max(is_any, MPI_COMM_WORLD) == 1;
}

TYPED_TEST(MotionMarking, AnObstacleThatComesIsContactThatIsComing)
{
  constexpr int dim = TypeParam::dim;
  EXPECT_FALSE(is_met_by_floor<dim>("0"));
  EXPECT_TRUE(is_met_by_floor<dim>("if(t < 0.5, 3.9*t, 1.95)")) << "there already";
  EXPECT_TRUE(is_met_by_floor<dim>("t")) << "coming";
  EXPECT_FALSE(is_met_by_floor<dim>("-t")) << "going";
}

/// A ball over a graded block.
template <int dim>
struct Approach
{
  explicit Approach(double gap)
      : built({make_moved_ball(gap), graded(make_box("block", {4., 4., 4.}, {4, 4, 4}), {0., 0., 0.}, 1, .5)},
              1),
        levels(built.parameters.bodies)
  {
    adaptivity.max_levels = 2;
  }

  static BodyParameters make_moved_ball(double gap)
  {
    BodyParameters ball = make_ball("ball", 1., 1);
    ball.placement.shift = {2., 2., 2.};
    ball.placement.shift[dim - 1] = 5. + gap;
    return ball;
  }

  /// Adapts until nothing changes; returns how often.
  unsigned int adapt(double speed, OtherCells others)
  {
    unsigned int n = 0;
    for (; n < 10; ++n)
    {
      for (const OwnedNode<dim> &node : built.discretization.owned_nodes)
        built.state.velocity.local_element(node.dofs[dim - 1]) = node.body == 0 ? speed : 0.;
      built.discretization.distribute(built.state.velocity);
      const SurfaceMap<dim> map(built.scene, built.discretization);
      const std::vector<bool> is_near = find_cells_near_contact(
          built.scene, ContactParameters(), built.discretization, map,
          collect_boundary_faces(built.discretization, &map), levels, built.state, 1.);
      const std::vector<double> plastic_strains(built.discretization.cells.n_cells, plastic_strain);
      if (!mark_cells_in_motion(is_near, others, plastic_strains, ErrorEstimate(), adaptivity, levels,
                                built.discretization))
        break;
      adapt_in_motion(built.scene, built.discretization, built.state, built.memory);
    }
    return n;
  }

  /// The most refinements of a cell of the file's mesh, by body.
  std::array<unsigned int, 2> extra_levels() const
  {
    std::array<unsigned int, 2> most{};
    for (const auto &cell : built.discretization.hexahedra->mesh.active_cell_iterators())
      if (cell->is_locally_owned())
        most[cell->material_id()] =
            std::max(most[cell->material_id()], cell->level() - levels.level_at(cell));
    for (unsigned int &of_body : most)
      of_body = dealii::Utilities::MPI::max(of_body, MPI_COMM_WORLD);
    return most;
  }

  BuiltScene<dim> built;
  FileLevels<dim> levels;
  AdaptivityParameters adaptivity;
  double plastic_strain = 0.;
};

TYPED_TEST(MotionMarking, ContactThatIsComingIsRefinedAndContactThatIsGoneIsNot)
{
  constexpr int dim = TypeParam::dim;
  Approach<dim> approach(2.);
  const auto n_of_file = approach.built.discretization.n_cells();
  EXPECT_EQ(approach.adapt(0., OtherCells::coarser), 0u) << "a ball at rest meets nothing";
  EXPECT_EQ(approach.adapt(-1.95, OtherCells::coarser), 2u) << "level by level";
  EXPECT_EQ(approach.extra_levels(), (std::array<unsigned int, 2>{2, 2}));
  EXPECT_LT(approach.built.discretization.n_cells(), (1u << dim) * n_of_file);
  EXPECT_EQ(approach.adapt(0., OtherCells::as_they_are), 0u);
  approach.plastic_strain = 1e-3;
  EXPECT_EQ(approach.adapt(0., OtherCells::coarser), 0u) << "what has yielded stays";
  approach.plastic_strain = 0.;
  EXPECT_EQ(approach.adapt(0., OtherCells::coarser), 2u);
  EXPECT_EQ(approach.built.discretization.n_cells(), n_of_file) << "the mesh of the file, graded as it was";
}
} // namespace
