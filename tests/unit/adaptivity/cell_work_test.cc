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
    built.discretization.adapt({&built.state.displacement, &built.state.velocity}, built.memory);
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
  const bool has_moved = discretization.balance(
      work, {&pillar.built.state.displacement, &pillar.built.state.velocity}, pillar.built.memory);
  EXPECT_EQ(has_moved, is_parallel);
  EXPECT_EQ(pillar.gather_motion(), before);
  const std::vector<unsigned int> new_work = pillar.find_work();
  EXPECT_LE(discretization.imbalance(new_work), 1.15);
  EXPECT_FALSE(discretization.balance(new_work, {&pillar.built.state.displacement}, pillar.built.memory))
      << "it is balanced";

  pillar.adapt(false);
  EXPECT_EQ(discretization.n_cells(), n_cells) << "children of one cell were parted";
}

TYPED_TEST(MotionOnRanks, TetrahedraAreNotShared)
{
  constexpr int dim = TypeParam::dim;
  BodyParameters simplices = make_simplex_box("simplices", dim, {1., 1., 1.}, {2, 2, 2});
  simplices.placement.shift[0] = 2.;
  BuiltScene<dim> built({make_box("hexahedra", {1., 1., 1.}, {4, 4, 4}), simplices}, TypeParam::degree);
  Discretization<dim> &discretization = built.discretization;
  std::vector<unsigned int> work(discretization.cells.n_cells, 1000);
  const bool is_first = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  std::fill(work.begin() + discretization.tetrahedra->first_cell, work.end(), is_first ? 1 : 100000);
  const bool is_parallel = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1;
  EXPECT_EQ(discretization.imbalance(work) > 1.5, is_parallel);
  EXPECT_FALSE(discretization.balance(work, {&built.state.displacement}, built.memory))
      << "the hexahedra are balanced";
  std::fill(work.begin(), work.begin() + discretization.tetrahedra->first_cell, is_first ? 1000 : 3000);
  EXPECT_EQ(discretization.balance(work, {&built.state.displacement}, built.memory), is_parallel);
}

template <typename T>
class MotionOfVolumes : public testing::Test
{
};
TYPED_TEST_SUITE(MotionOfVolumes, LinearCases);

TYPED_TEST(MotionOfVolumes, OverlapsOfSimplicesAreWorkOfTheirCells)
{
  constexpr int dim = TypeParam::dim;
  BodyParameters lower = make_box("lower", {1., 1., 1.}, {4, 4, 4});
  BodyParameters upper = make_simplex_box("upper", dim, {1., 1., 1.}, {3, 3, 3});
  upper.placement.shift[dim - 1] = .99;
  BuiltScene<dim> built({lower, upper}, 1);
  const VolumeMap<dim> map(built.scene, built.discretization);
  built.forces.volume_contacts.push_back(std::make_shared<VolumeContactForce<dim>>(
      "contact", map, contact::VolumePotentialSettings(), MPI_COMM_WORLD));
  built.forces.volume_contacts[0]->renew(built.state);
  const std::vector<unsigned int> work = find_cell_work(
      built.discretization, collect_boundary_faces(built.discretization, &built.map), built.forces);
  double extra_work = 0.;
  built.discretization.for_each_own_cell(
      [&](const MeshPart<dim> &, const auto &cell, unsigned int own_cell)
      {
        const bool is_in_contact = cell->material_id() == 0 && cell->center()[dim - 1] > .75;
        EXPECT_EQ(work[own_cell] > 1000, is_in_contact) << cell->center();
        extra_work += work[own_cell] - 1000;
      });
  const unsigned int n_pairs = built.forces.volume_contacts[0]->measure().n_pairs;
  ASSERT_GT(n_pairs, 0u);
  EXPECT_EQ(dealii::Utilities::MPI::sum(extra_work, MPI_COMM_WORLD), 3500. * n_pairs);
}
} // namespace
