// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/potential/simplex_pair.h"

#include "simplex_samples.h"

#include <Eigen/Eigenvalues>

#include <optional>

namespace signorini::contact
{
namespace
{
using namespace testing;

template <typename Dimension>
class SimplexPairTest : public ::testing::Test
{
};
TYPED_TEST_SUITE(SimplexPairTest, Dimensions);

/// A pair of which single corners can be moved.
template <int dim>
struct Couple
{
  static constexpr unsigned int n = dim + 1;
  std::array<Corners<dim>, 2> corners;
  std::array<double, 2> strengths{3., 7.};

  SpatialVector<dim> &corner(unsigned int i) { return corners[i / n][i % n]; }

  template <typename Use>
  auto with_pair(const Use &use) const
  {
    const auto first = make_simplex_shape<dim>(corners[0]), second = make_simplex_shape<dim>(corners[1]);
    return use(SimplexPair<dim>{{&first, &second}, strengths});
  }

  std::optional<typename SimplexPair<dim>::State> evaluate() const
  {
    return with_pair([](const auto &pair) { return pair.evaluate(); });
  }

  double energy() const
  {
    const auto state = evaluate();
    return state ? state->energy : 0.;
  }

  Eigen::VectorXd forces() const
  {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(2 * n * dim);
    if (const auto state = evaluate())
      for (unsigned int p = 0; p < 2 * n; ++p)
        all.template segment<dim>(dim * p) = state->forces[p];
    return all;
  }

  typename SimplexPair<dim>::Tangent tangent() const
  {
    typename SimplexPair<dim>::Tangent matrix;
    matrix.setZero();
    with_pair([&](const auto &pair) { return pair.compute_tangent(0., matrix); });
    return matrix;
  }

  /// Derivative by corner component `i`, of fourth order.
  template <typename Function>
  auto differentiate(const Function &f, unsigned int i, double step) const
  {
    const auto at = [&](double t)
    {
      Couple moved = *this;
      moved.corner(i / dim)[i % dim] += t;
      return f(moved);
    };
    using Value = decltype(f(*this));
    return Value((8. * (at(step) - at(-step)) - (at(2. * step) - at(-2. * step))) / (12. * step));
  }
};

template <int dim>
Couple<dim> make_couple(Dice &dice)
{
  Couple<dim> couple;
  do
    for (auto &corners : couple.corners)
      corners = make_random_simplex<dim>(dice);
  while (couple.energy() == 0.);
  return couple;
}

/// ∫ min_m λ_m over the overlap is ∫ over t of the volume of the part with all λ_m ≥ t, a simplex again: an
/// independent way to the energy, by Simpson's rule.
template <int dim>
double energy_by_layers(const Couple<dim> &couple)
{
  constexpr unsigned int n_steps = 4000;
  double energy = 0.;
  for (unsigned int owner = 0; owner < 2; ++owner)
    for (unsigned int i = 0; i <= n_steps; ++i)
    {
      const double size = 1. - static_cast<double>(i) / n_steps;
      const SpatialVector<dim> shift = (1. - size) * mean<dim>(couple.corners[owner]);
      const auto layer = moved<dim>(couple.corners[owner], size * SpatialTensor<dim>::Identity(), shift);
      const double weight = (i == 0 || i == n_steps ? 1. : i % 2 == 0 ? 2. : 4.) / (3. * n_steps * (dim + 1));
      energy += weight * couple.strengths[owner] * overlap_volume<dim>(layer, couple.corners[1 - owner], 1);
    }
  return energy;
}

TYPED_TEST(SimplexPairTest, EnergyAgreesWithLayers)
{
  constexpr int dim = TypeParam::value;
  Dice dice(1);
  for (unsigned int trial = 0; trial < count_cases(20); ++trial)
  {
    const auto couple = make_couple<dim>(dice);
    EXPECT_NEAR(couple.energy(), energy_by_layers<dim>(couple), 1e-9);
  }
}

TYPED_TEST(SimplexPairTest, ForcesAreTheGradientOfEnergyCornerByCorner)
{
  constexpr int dim = TypeParam::value;
  Dice dice(2);
  for (unsigned int trial = 0; trial < count_cases(100); ++trial)
  {
    const auto couple = make_couple<dim>(dice);
    const Eigen::VectorXd forces = couple.forces();
    for (unsigned int i = 0; i < forces.size(); ++i)
      EXPECT_NEAR(couple.differentiate([](const auto &moved) { return moved.energy(); }, i, 1e-5), -forces[i],
                  1e-9 + 1e-7 * forces.norm());
  }
}

TYPED_TEST(SimplexPairTest, TangentIsTheSymmetricDerivativeOfForces)
{
  constexpr int dim = TypeParam::value;
  Dice dice(3);
  for (unsigned int trial = 0; trial < count_cases(100); ++trial)
  {
    const auto couple = make_couple<dim>(dice);
    const Eigen::MatrixXd tangent = couple.tangent();
    const double largest = tangent.cwiseAbs().maxCoeff();
    EXPECT_LT((tangent - tangent.transpose()).cwiseAbs().maxCoeff(), 1e-13 * largest);
    for (unsigned int i = 0; i < tangent.cols(); ++i)
    {
      const Eigen::VectorXd slope =
          couple.differentiate([](const auto &moved) { return moved.forces(); }, i, 1e-6);
      EXPECT_LT((slope + tangent.col(i)).norm(), 1e-6 * largest);
    }
  }
}

/// Identical simplices cover each other: only the stretching forces are left, φ being 0 on both surfaces.
TYPED_TEST(SimplexPairTest, IdenticalSimplices)
{
  constexpr int dim = TypeParam::value;
  Couple<dim> couple;
  couple.corners = {make_unit_corner<dim>(), make_unit_corner<dim>()};
  const auto shape = make_simplex_shape<dim>(couple.corners[0]);
  // The mean of min λ is that of a pyramid's height: a third of 1/3 (2-D), a fourth of 1/4.
  const double mean_of_least = 1. / ((dim + 1) * (dim + 1));
  EXPECT_NEAR(couple.energy(), 10. * shape.volume * mean_of_least, 1e-14);
  const Eigen::VectorXd forces = couple.forces();
  for (unsigned int p = 0; p < 2 * (dim + 1); ++p)
  {
    const SpatialVector<dim> exact =
        -couple.strengths[p / (dim + 1)] * shape.volume * mean_of_least * shape.gradients[p % (dim + 1)];
    EXPECT_LT((forces.template segment<dim>(dim * p) - exact).norm(), 1e-14);
  }
  EXPECT_TRUE(couple.tangent().allFinite());
}

/// Two faces of equal size face to face, at a gap or an overlap of `overlap`.
template <int dim>
Couple<dim> face_to_face(double overlap)
{
  Couple<dim> couple;
  couple.corners[0] = make_unit_corner<dim>();
  couple.corners[1] = couple.corners[0];
  couple.corners[1][dim] *= -1.;
  for (auto &x : couple.corners[1])
    x[dim - 1] += overlap;
  return couple;
}

TYPED_TEST(SimplexPairTest, NothingActsWhereSimplicesOnlyTouch)
{
  constexpr int dim = TypeParam::value;
  for (const double overlap : {0., -1e-12, -.1})
  {
    const auto couple = face_to_face<dim>(overlap);
    EXPECT_FALSE(couple.evaluate().has_value());
    typename SimplexPair<dim>::Tangent tangent;
    const bool is_on_verge =
        couple.with_pair([&](const auto &pair) { return pair.compute_tangent(1e-9, tangent); });
    EXPECT_EQ(is_on_verge, overlap > -1e-9);
    if (is_on_verge)
    {
      const auto touching = face_to_face<dim>(1e-7).tangent();
      EXPECT_LT((tangent - touching).norm(), 1e-5 * touching.norm());
    }
  }
}

TYPED_TEST(SimplexPairTest, MeasuresOfAFlatOverlap)
{
  constexpr int dim = TypeParam::value;
  constexpr double overlap = .01;
  const auto state = face_to_face<dim>(overlap).evaluate();
  ASSERT_TRUE(state.has_value());
  for (const double depth : state->depths)
    EXPECT_NEAR(depth, overlap, 1e-15);
  EXPECT_NEAR(state->largest_potentials[0], 3. * overlap, 1e-15);
  EXPECT_NEAR(state->largest_potentials[1], 7. * overlap, 1e-15);
  // That of the common face but for strips along the slanting sides.
  EXPECT_NEAR(state->area[dim - 1], 1. / (dim - 1), 1.6 * overlap);
  // Deepest below the face of one lies a point on the face of the other.
  EXPECT_NEAR(state->deepest_positions[0][dim - 1], overlap, 1e-15);
  EXPECT_NEAR(state->deepest_positions[1][dim - 1], 0., 1e-15);
  // Their sides lie in the same planes, not within the other one.
  for (unsigned int opposite = 0; opposite <= dim; ++opposite)
    for (const unsigned int first : {0u, dim + 1u})
      EXPECT_EQ(state->is_face_in_contact[first + opposite], opposite == 0 || opposite == dim);
}

/// Vertices of unit mass: the largest eigenvalue, at this place and at any that a small motion leads to.
TYPED_TEST(SimplexPairTest, RowSumsBoundTheLargestEigenvalue)
{
  constexpr int dim = TypeParam::value;
  constexpr double motion = .04;
  Dice dice(8);
  const auto largest_eigenvalue = [](const Couple<dim> &couple)
  {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(Eigen::MatrixXd(couple.tangent()),
                                                                Eigen::EigenvaluesOnly);
    return solver.eigenvalues().maxCoeff();
  };
  for (unsigned int trial = 0; trial < count_cases(300); ++trial)
  {
    auto couple = make_couple<dim>(dice);
    couple.corners[1] = shifted<dim>(couple.corners[1], dice.point<dim>(-.5, .5));
    std::array<double, 2 * (dim + 1)> bounds{}, present_bounds{};
    couple.with_pair([&](const auto &pair) { pair.add_row_sum_bounds(motion, bounds); });
    couple.with_pair([&](const auto &pair) { pair.add_row_sum_bounds(0., present_bounds); });
    const double present_bound = *std::max_element(present_bounds.begin(), present_bounds.end());
    const double bound = *std::max_element(bounds.begin(), bounds.end());
    EXPECT_LE(largest_eigenvalue(couple), present_bound);
    EXPECT_LE(present_bound, bound);
    for (unsigned int step = 0; step < 20; ++step)
    {
      const SpatialVector<dim> way = motion * dice.point<dim>(-1., 1.).normalized();
      auto moved = couple;
      moved.corners[step % 2] = shifted<dim>(moved.corners[step % 2], way);
      EXPECT_LE(largest_eigenvalue(moved), bound * (1. + 1e-12));
    }
  }
  const auto flat = face_to_face<dim>(.01);
  std::array<double, 2 * (dim + 1)> bounds{};
  flat.with_pair([&](const auto &pair) { pair.add_row_sum_bounds(0., bounds); });
  EXPECT_GT(largest_eigenvalue(flat), .2 * *std::max_element(bounds.begin(), bounds.end()))
      << "a bound that bounds anything is of no use";
}
} // namespace
} // namespace signorini::contact
