// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/adaptivity/cell_work.h"

#include "../contact_bodies.h"

using namespace signorini;
using namespace signorini::test;

namespace
{
/// A pillar on a floor: contact lies at one end of it.
template <int dim>
struct Pillar
{
  explicit Pillar(unsigned int degree)
      : built({make_pillar()}, degree, [](Parameters &p) { p.obstacles = {make_floor<dim>(0.)}; })
  {
  }

  static BodyParameters make_pillar()
  {
    Triple upper{.25, .25, .25};
    std::array<unsigned int, 3> n_cells{4, 4, 4};
    upper[dim - 1] = 1.;
    n_cells[dim - 1] = 16;
    return make_box("pillar", upper, n_cells);
  }

  std::vector<unsigned int> find_work()
  {
    built.map = SurfaceMap<dim>(built.scene, built.discretization);
    built.forces = SceneForces<dim>();
    built.add_contact(make_settings(contact::Integration::face_quadrature))->renew(built.state);
    return find_cell_work(built.discretization, collect_boundary_faces(built.discretization, &built.map),
                          built.forces);
  }

  void adapt(bool is_foot_refined)
  {
    for (const auto &cell : built.discretization.hexahedra->mesh.active_cell_iterators())
      if (cell->is_locally_owned() && is_foot_refined && cell->vertex(0)[dim - 1] < 1e-6)
        cell->set_refine_flag();
      else if (cell->is_locally_owned() && !is_foot_refined && cell->level() > 0)
        cell->set_coarsen_flag();
    built.discretization.adapt({&built.state.displacement, &built.state.velocity});
  }

  /// Position, displacement and velocity of all nodes of all ranks, sorted.
  std::vector<std::array<double, 3 * dim>> gather_motion() const
  {
    constexpr double round_off = 1e-9;
    std::vector<std::array<double, 3 * dim>> own;
    for (const OwnedNode<dim> &node : built.discretization.owned_nodes)
    {
      std::array<double, 3 * dim> row;
      for (unsigned int d = 0; d < dim; ++d)
      {
        row[d] = std::round(node.position[d] / round_off);
        row[dim + d] = built.state.displacement.local_element(node.dofs[d]);
        row[2 * dim + d] = built.state.velocity.local_element(node.dofs[d]);
      }
      own.push_back(row);
    }
    std::vector<std::array<double, 3 * dim>> all;
    for (const auto &of_rank : dealii::Utilities::MPI::all_gather(MPI_COMM_WORLD, own))
      all.insert(all.end(), of_rank.begin(), of_rank.end());
    std::sort(all.begin(), all.end());
    return all;
  }

  BuiltScene<dim> built;
};

template <typename T>
class MotionOnRanks : public testing::Test
{
};
TYPED_TEST_SUITE(MotionOnRanks, AllCases);

TYPED_TEST(MotionOnRanks, WorkOfContactIsSharedOut)
{
  constexpr int dim = TypeParam::dim;
  Pillar<dim> pillar(TypeParam::degree);
  Discretization<dim> &discretization = pillar.built.discretization;
  const auto n_cells = discretization.n_cells();
  pillar.built.state.displacement = pillar.built.random_vector(.001, 3);
  pillar.built.state.velocity = pillar.built.random_vector(1., 4);
  pillar.adapt(true);

  const std::vector<unsigned int> work = pillar.find_work();
  const bool has_contact = std::any_of(work.begin(), work.end(), [](unsigned int w) { return w > 1000; });
  ASSERT_EQ(dealii::Utilities::MPI::sum(static_cast<int>(has_contact), MPI_COMM_WORLD), 1);
  const bool is_parallel = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1;
  EXPECT_EQ(discretization.imbalance(work) > 1.15, is_parallel);

  const auto before = pillar.gather_motion();
  const bool has_moved =
      discretization.balance(work, {&pillar.built.state.displacement, &pillar.built.state.velocity});
  EXPECT_EQ(has_moved, is_parallel);
  EXPECT_EQ(pillar.gather_motion(), before);
  const std::vector<unsigned int> new_work = pillar.find_work();
  EXPECT_LE(discretization.imbalance(new_work), 1.15);
  EXPECT_FALSE(discretization.balance(new_work, {&pillar.built.state.displacement})) << "it is balanced";

  pillar.adapt(false);
  EXPECT_EQ(discretization.n_cells(), n_cells) << "children of one cell were parted";
}
} // namespace
