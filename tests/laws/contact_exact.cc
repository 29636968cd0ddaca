// SPDX-License-Identifier: LGPL-2.1-or-later
#include "potential_scene.h"

#include <gtest/gtest.h>

#include <numeric>

using namespace signorini;
using namespace signorini::contact;
using namespace signorini::test;

namespace
{
template <typename Dimension>
class ContactExact : public testing::Test
{
protected:
  static constexpr int dimension = Dimension::value;
  static constexpr double overlap = .001; ///< below the distance of any point from a rim
  BoxBody<dimension> lower, upper;
  PotentialSettings settings;
  ContactSurface<dimension> surface;

  /// Two flat boxes of unlike material, the upper one of the given width.
  void press(double width, unsigned int n_lower, unsigned int n_upper)
  {
    lower.n_faces = n_lower;
    upper.n_faces = n_upper;
    upper.size *= width;
    upper.corner.setConstant(.5 * (1. - width));
    upper.corner[dimension - 1] = 1. - overlap;
    upper.youngs_modulus = 4e3;
    upper.density = 3.;
    BoxSurfaceBuilder<dimension> builder;
    builder.add(lower);
    builder.add(upper);
    surface = builder.surface;
  }

  double stiffness() const
  {
    const double compliance = lower.size[0] / lower.n_faces / lower.youngs_modulus +
                              upper.size[0] / upper.n_faces / upper.youngs_modulus;
    return settings.penalty_factor / compliance;
  }

  ContactPotential<dimension> evaluate() const
  {
    ContactPotential<dimension> potential(surface, {}, settings);
    potential.update(surface.reference_positions);
    potential.evaluate(surface.reference_positions);
    return potential;
  }

  Positions<dimension> velocities(double up) const
  {
    Positions<dimension> v(surface.n_nodes(), SpatialVector<dimension>::Zero());
    for (const auto &facet : surface.facets)
      for (unsigned int a = 0; a < facet.n_nodes(); ++a)
        v[facet.nodes[a]][dimension - 1] = facet.body == 1 ? up : 0.;
    return v;
  }
};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(ContactExact, Dimensions);

template <int dim>
void expect_uniform_pressure(const ContactPotential<dim> &potential, double pressure, double area)
{
  const auto measures = potential.measure();
  EXPECT_NEAR(measures.max_pressure, pressure, 1e-11 * pressure);
  EXPECT_NEAR(measures.area, area, 1e-12);
  EXPECT_NEAR(measures.resultants[1][dim - 1], pressure * area, 1e-11 * pressure * area);
  EXPECT_NEAR(measures.resultants[0][dim - 1], -pressure * area, 1e-11 * pressure * area);
  for (const auto &sample : potential.samples())
    if (sample.depth > 0.)
    {
      EXPECT_NEAR(sample.pressure, pressure, 1e-11 * pressure);
    }
}

TYPED_TEST(ContactExact, EqualBoxesWithFaceQuadrature)
{
  for (unsigned int degree : {1u, 2u})
  {
    this->lower.degree = this->upper.degree = degree;
    this->upper = this->lower;
    this->press(1., 2, 3);
    const auto potential = this->evaluate();
    expect_uniform_pressure(potential, this->stiffness() * this->overlap, 1.);
    EXPECT_NEAR(potential.energy(), .5 * this->stiffness() * this->overlap * this->overlap, 1e-12);
    EXPECT_NEAR(potential.measure().max_penetration_over_thickness, this->overlap * 3., 1e-12);
    EXPECT_DOUBLE_EQ(potential.measure().max_stiffness, this->stiffness());
  }
}

TYPED_TEST(ContactExact, UnlikeBoxesWithFaceSegments)
{
  constexpr int dim = TypeParam::value;
  this->settings.integration = Integration::face_segments;
  for (const FacetType upper_type : {FacetType::tensor_product, FacetType::triangle})
  {
    if (dim == 3)
      this->upper.type = upper_type;
    this->press(.5, 3, 2);
    expect_uniform_pressure(this->evaluate(), this->stiffness() * this->overlap, dim == 2 ? .5 : .25);
    this->upper = BoxBody<dim>();
  }
}

/// ∫ N_a of a flat facet of area 1 over it.
template <int dim>
double exact_share(const FacetElement<dim> &element, unsigned int a)
{
  if (element.type == FacetType::triangle)
    return element.degree == 1 || a >= 3 ? 1. / 3. : 0.;
  const unsigned int n_line = element.degree + 1;
  const auto on_line = [&](unsigned int i) { return element.degree == 1 ? .5 : i == 1 ? 4. / 6. : 1. / 6.; };
  return on_line(a % n_line) * (dim == 3 ? on_line(a / n_line) : 1.);
}

/// Meshes that do not match, of one kind or two, under a uniform overlap: every node bears what a uniform
/// pressure k_A d on its facets gives it.
TYPED_TEST(ContactExact, FaceSegmentsGiveNodalForcesOfUniformPressure)
{
  constexpr int dim = TypeParam::value;
  this->settings.integration = Integration::face_segments;
  std::vector<FacetType> types{FacetType::tensor_product};
  if (dim == 3)
    types.push_back(FacetType::triangle);
  for (const FacetType lower_type : types)
    for (const FacetType upper_type : types)
      for (unsigned int degree : {1u, 2u})
      {
        this->upper = this->lower = BoxBody<dim>();
        this->lower.type = lower_type;
        this->upper.type = upper_type;
        this->lower.degree = this->upper.degree = degree;
        this->press(1., 3, 2);
        const auto potential = this->evaluate();
        const double pressure = this->stiffness() * this->overlap;
        expect_uniform_pressure(potential, pressure, 1.);

        Positions<dim> expected(this->surface.n_nodes(), SpatialVector<dim>::Zero());
        const auto &x = this->surface.reference_positions;
        for (const auto &facet : this->surface.facets)
        {
          const bool is_upper = facet.body == 1;
          const auto nodes = gather_nodes(facet, x);
          const auto is_on_face = [&](const auto &p)
          { return p[dim - 1] == (is_upper ? 1. - this->overlap : 1.); };
          if (!std::all_of(nodes.position.begin(), nodes.position.begin() + facet.n_nodes(), is_on_face))
            continue;
          const double n_faces = is_upper ? 2. : 3., n_parts = facet.type == FacetType::triangle ? 2. : 1.;
          const double area = std::pow(1. / n_faces, dim - 1) / n_parts;
          for (unsigned int a = 0; a < facet.n_nodes(); ++a)
            expected[facet.nodes[a]][dim - 1] +=
                (is_upper ? 1. : -1.) * pressure * area * exact_share(facet, a);
        }
        const auto difference = shifted<dim>(compute_forces(potential, x.size()), expected, -1.);
        for (const auto &error : difference)
          EXPECT_LT(error.norm(), 1e-12 * pressure);
      }
}

TYPED_TEST(ContactExact, BoxOnPlane)
{
  constexpr int dim = TypeParam::value;
  BoxSurfaceBuilder<dim> builder;
  builder.add(this->lower);
  this->surface = builder.surface;
  const SpatialVector<dim> up = SpatialVector<dim>::Unit(dim - 1);
  const auto plane = std::make_shared<RigidPlane<dim>>("floor", .02 * up, up);
  for (bool excluded : {false, true})
  {
    if (excluded)
      this->settings.excluded_obstacle_pairs = {{0, 0}};
    ContactPotential<dim> potential(this->surface, {plane}, this->settings);
    potential.update(this->surface.reference_positions);
    potential.evaluate(this->surface.reference_positions);
    const double stiffness = 10. * 1e3 / .5; // α E/h
    EXPECT_NEAR(potential.measure().resultants[0][dim - 1], excluded ? 0. : stiffness * .02, 1e-9);
  }
}

TYPED_TEST(ContactExact, ExcludedBodiesPassThroughEachOther)
{
  this->press(1., 2, 2);
  this->settings.excluded_body_pairs = {{1, 0}};
  EXPECT_EQ(this->evaluate().measure().n_pairs, 0u);
}

/// σ_c = 2ξ√(k_A m_A) ḋ, and never less than −k_A d.
TYPED_TEST(ContactExact, DampingPressure)
{
  constexpr int dim = TypeParam::value;
  this->settings.damping_ratio = .2;
  this->press(1., 2, 3);
  const auto potential = this->evaluate();
  const double m_0 = 10. * .5 / 2., m_1 = 3. / 3. / 2.;
  const double damping = .4 * std::sqrt(this->stiffness() * m_0 * m_1 / (m_0 + m_1));
  for (double speed : {.001, -.001, -100.})
  {
    Positions<dim> forces(this->surface.n_nodes(), SpatialVector<dim>::Zero());
    const double power = potential.add_damping_forces(this->velocities(-speed), forces);
    const double pressure = std::max(damping * speed, -this->stiffness() * this->overlap);
    EXPECT_NEAR(power, pressure * speed, 1e-11 * std::abs(pressure * speed));
    potential.add_forces(forces);
    if (speed == -100.)
    {
      EXPECT_LT(norm<dim>(forces), 1e-12) << "surfaces that part must not pull";
    }
  }
}

/// The middle Gauss point of the upper face stands on the seam of the lower faces, which are in one plane.
TYPED_TEST(ContactExact, FlatSurfaceHasNoTangentialStiffness)
{
  constexpr int dim = TypeParam::value;
  this->press(1., 2, 1);
  const auto tangent = compute_tangent(this->evaluate(), this->surface.n_nodes());
  Eigen::VectorXd sideways = Eigen::VectorXd::Zero(tangent.rows());
  const auto up = this->velocities(1.);
  for (std::size_t i = 0; i < up.size(); ++i)
    sideways[dim * i] = up[i][dim - 1];
  EXPECT_GT(tangent.norm(), 0.);
  // Displaced points turn with the target's normal only to second order in depth.
  EXPECT_LT(sideways.dot(tangent * sideways), 1e-10 * tangent.norm());
}

/// Renewing the pairs brings no energy: points in contact keep the stiffness they were made with, also where
/// they have slid onto a stiffer part of the target.
TYPED_TEST(ContactExact, RenewalBringsNoEnergy)
{
  constexpr int dim = TypeParam::value;
  this->press(.5, 4, 2);
  for (bool uniform : {true, false})
  {
    if (!uniform)
      for (auto &facet : this->surface.facets)
        if (facet.body == 0 && this->surface.reference_positions[facet.nodes[0]][0] > .6)
          facet.youngs_modulus *= 5.;
    ContactPotential<dim> potential(this->surface, {}, this->settings);
    EXPECT_EQ(potential.update(this->surface.reference_positions), 0.);
    EXPECT_FALSE(potential.is_stale(this->surface.reference_positions));

    auto moved = this->surface.reference_positions;
    const auto up = this->velocities(.23);
    for (std::size_t i = 0; i < moved.size(); ++i)
      moved[i][0] += up[i][dim - 1];
    EXPECT_TRUE(potential.is_stale(moved));
    potential.evaluate(moved);
    const double before = potential.energy();
    const double jump = potential.update(moved);
    potential.evaluate(moved);
    EXPECT_GT(before, 0.);
    EXPECT_EQ(potential.energy(), before);
    EXPECT_EQ(jump, 0.);
    EXPECT_EQ(potential.update(moved), 0.);

    ContactPotential<dim> made_here(this->surface, {}, this->settings);
    made_here.update(moved);
    made_here.evaluate(moved);
    if (uniform)
      EXPECT_DOUBLE_EQ(made_here.energy(), before);
    else
      EXPECT_GT(made_here.energy(), 1.01 * before);
  }
}

TYPED_TEST(ContactExact, RejectsSettingsWithoutSense)
{
  constexpr int dim = TypeParam::value;
  this->press(1., 1, 1);
  const auto expect_rejected = [this](auto change)
  {
    PotentialSettings changed;
    change(changed);
    EXPECT_THROW(ContactPotential<dim>(this->surface, {}, changed), std::invalid_argument);
  };
  expect_rejected([](auto &s) { s.penalty_factor = 0.; });
  expect_rejected([](auto &s) { s.skin_over_thickness = 0.; });
  expect_rejected([](auto &s) { s.n_quadrature_points = 0; });
  expect_rejected([](auto &s) { s.damping_ratio = -1.; });
  expect_rejected([this](auto &) { this->surface.facets[0].layer_thickness = 0.; });
}
} // namespace
