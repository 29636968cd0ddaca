// SPDX-License-Identifier: LGPL-2.1-or-later
#include "built_scene.h"

#include "signorini/base/to_eigen.h"
#include "signorini/discretization/placement.h"
#include "signorini/discretization/scene_mesh.h"
#include "signorini/discretization/simplex_field.h"

using namespace signorini;
using namespace signorini::test;

namespace
{
/// As rich as elements of the degree hold.
template <int dim>
SpatialVector<dim> polynomial(unsigned int degree, const SpatialVector<dim> &x)
{
  SpatialVector<dim> value = SpatialVector<dim>::Constant(.3);
  for (unsigned int d = 0; d < dim; ++d)
  {
    value[d] += (d + 1.) * x[d] - .4 * x[(d + 1) % dim];
    if (degree == 2)
      value[d] += .7 * x[d] * x[(d + 1) % dim] - .2 * x[d] * x[d];
  }
  return value;
}

/// A turned box of simplices beside a cube of hexahedra with hanging nodes.
template <int dim>
std::vector<BodyParameters> make_bodies(const std::array<unsigned int, 3> &cells)
{
  BodyParameters box = make_simplex_box("box", dim, {2., 1.5, 1.}, cells);
  box.placement.shift = {3., 1., -2.};
  box.placement.rotation_angle = 50.;
  box.placement.rotation_axis = {1., 1., 0.};
  return {box, make_graded_cube()};
}

template <typename T>
class SimplexFields : public testing::Test
{
};
TYPED_TEST_SUITE(SimplexFields, AllCases);

TYPED_TEST(SimplexFields, HoldPolynomialsOfTheirDegree)
{
  constexpr int dim = TypeParam::dim;
  const BuiltScene<dim> built(make_bodies<dim>({3, 2, 2}), TypeParam::degree);
  const Vector once = built.interpolate([](const SpatialVector<dim> &x)
                                        { return polynomial<dim>(TypeParam::degree, x); }),
               twice = built.interpolate(
                   [](const SpatialVector<dim> &x)
                   { return SpatialVector<dim>(2. * polynomial<dim>(TypeParam::degree, x)); });
  const SimplexField<dim> field(built.discretization, {&once, &twice});
  const Placement<dim> placement(built.parameters.bodies[0].placement);
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> uniform(0., 1.);
  const Triple size{2., 1.5, 1.};
  for (unsigned int i = 0; i < 500; ++i)
  {
    dealii::Point<dim> own;
    for (unsigned int d = 0; d < dim; ++d)
      own[d] = size[d] * uniform(engine);
    const dealii::Point<dim> x = placement.place(own);
    const SpatialVector<dim> exact = polynomial<dim>(TypeParam::degree, to_eigen<dim>(x));
    const auto values = field.evaluate(0, x);
    ASSERT_EQ(values.size(), 2u);
    EXPECT_LT((values[0] - exact).norm(), 1e-11);
    EXPECT_LT((values[1] - 2. * exact).norm(), 2e-11);
  }
}

TYPED_TEST(SimplexFields, ReplacedMeshesKeepWhatBothHold)
{
  constexpr int dim = TypeParam::dim;
  const auto field = [](const SpatialVector<dim> &x) { return polynomial<dim>(TypeParam::degree, x); };
  BuiltScene<dim> built(make_bodies<dim>({3, 2, 2}), TypeParam::degree);
  Vector values = built.interpolate(field);
  const auto n_old_dofs = built.discretization.n_dofs();
  built.discretization.replace_tetrahedra(
      place_simplex_meshes<dim>(make_bodies<dim>({4, 3, 5}), TypeParam::degree, MPI_COMM_WORLD), {&values});
  ASSERT_GT(built.discretization.n_dofs(), n_old_dofs);
  Vector error = built.interpolate(field);
  error -= values;
  EXPECT_LT(error.linfty_norm(), 1e-11);
}
} // namespace
