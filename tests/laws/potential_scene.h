// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/potential/contact_potential.h"

#include "box_surface.h"

#include <Eigen/Geometry>

#include <ostream>

namespace signorini::test
{
enum class Target
{
  body,
  itself, ///< a part of the same body
  plane,
  sphere
};

enum class Multipliers
{
  none,
  given ///< random ones, about as large as the pressures of the overlap
};

/// Which of the two boxes have surfaces of triangles.
enum class Triangles
{
  none,
  both,
  upper,
  lower
};

struct Case
{
  int dim;
  unsigned int degree;
  Target target;
  contact::Integration integration;
  Multipliers multipliers = Multipliers::none;
  Triangles triangles = Triangles::none;
};

inline std::ostream &operator<<(std::ostream &out, const Case &c)
{
  const std::array<const char *, 4> targets{"Body", "Itself", "Plane", "Sphere"};
  const std::array<const char *, 4> triangles{"", "Triangles", "TrianglesAbove", "TrianglesBelow"};
  return out << "Dim" << c.dim << "Degree" << c.degree << targets[static_cast<std::size_t>(c.target)]
             << (c.integration == contact::Integration::face_quadrature ? "Quadrature" : "Segments")
             << (c.multipliers == Multipliers::given ? "Multipliers" : "")
             << triangles[static_cast<std::size_t>(c.triangles)];
}

/// A bent box pressed a little into another bent box of other mesh and material, or into an obstacle; or the
/// two are ends of one body that were apart when it was undeformed, and whatever joins them is far away.
template <int dim>
struct PotentialScene
{
  static constexpr double overlap = .06;
  static constexpr double reach = 1.;     ///< pairs farther apart than this need not be known
  static constexpr double sharpness = .1; ///< the largest eigenvalue over its bound, at least

  ContactSurface<dim> surface;
  Positions<dim> positions;
  typename contact::ContactPotential<dim>::Obstacles obstacles;
  contact::PotentialSettings settings;
  Target target;
  unsigned int first_moving_node; ///< those of the upper box
  NodalPressures<dim> multipliers;

  explicit PotentialScene(const Case &c, unsigned int n_faces = 2, double bend = .02)
      : target(c.target), first_moving_node(0)
  {
    BoxSurfaceBuilder<dim> builder;
    BoxBody<dim> lower;
    lower.degree = c.degree;
    lower.n_faces = n_faces;
    const auto is_of_triangles = [&](Triangles side)
    { return c.triangles == Triangles::both || c.triangles == side; };
    lower.type = is_of_triangles(Triangles::lower) ? FacetType::triangle : FacetType::tensor_product;
    if (is_between_bodies())
    {
      builder.add(lower);
      first_moving_node = builder.surface.n_nodes();
    }
    BoxBody<dim> upper = lower;
    upper.type = is_of_triangles(Triangles::upper) ? FacetType::triangle : FacetType::tensor_product;
    upper.size *= .75;
    upper.corner = SpatialVector<dim>::Constant(.1371);
    upper.corner[dim - 1] = 1. - overlap;
    upper.youngs_modulus = 3e3;
    upper.density = 4.;
    builder.add(upper);
    surface = builder.surface;
    RandomVectors<dim> random(5);
    positions = shifted<dim>(surface.reference_positions, random.field(surface.n_nodes(), bend), 1.);
    if (target == Target::itself)
      become_one_body();
    move(SpatialTensor<dim>::Identity(), SpatialVector<dim>::Zero());
    settings.integration = c.integration;
    settings.damping_ratio = .3;
    if (c.integration == contact::Integration::face_segments)
      settings.n_quadrature_points = 2; // there are many segments
    if (c.multipliers == Multipliers::given)
      for (const Facet<dim> &facet : surface.facets)
      {
        multipliers.emplace_back();
        for (double &pressure : multipliers.back())
          pressure = .1 * facet.youngs_modulus * std::abs(random.vector(1.)[0]);
      }
  }

  /// Turns and shifts all there is.
  void move(const SpatialTensor<dim> &rotation, const SpatialVector<dim> &shift)
  {
    for (auto &x : positions)
      x = rotation * x + shift;
    SpatialVector<dim> up = SpatialVector<dim>::Unit(dim - 1);
    up[0] = .1;
    const SpatialVector<dim> middle = SpatialVector<dim>::Constant(.5);
    SpatialVector<dim> point = middle;
    point[dim - 1] = 1.;
    obstacles.clear();
    if (target == Target::plane)
      obstacles.push_back(
          std::make_shared<RigidPlane<dim>>("floor", rotation * point + shift, rotation * up));
    else if (target == Target::sphere)
      obstacles.push_back(std::make_shared<RigidSphere<dim>>("ball", rotation * middle + shift, .53));
  }

  contact::ContactPotential<dim> make_potential() const
  {
    contact::ContactPotential<dim> potential(surface, obstacles, settings);
    potential.set_multipliers(multipliers);
    return potential;
  }

  /// Moves every node of the upper box by `shift`.
  Positions<dim> moved(const SpatialVector<dim> &shift) const
  {
    Positions<dim> x(positions);
    for (std::size_t i = first_moving_node; i < x.size(); ++i)
      x[i] += shift;
    return x;
  }

  Positions<dim> zeros() const { return Positions<dim>(positions.size(), SpatialVector<dim>::Zero()); }

  /// Whether what is below the box deforms, too.
  bool is_between_bodies() const { return target == Target::body || target == Target::itself; }

  /// Whether pairs made anew leave the energy what it was.
  bool may_be_renewed() const { return settings.integration == contact::Integration::face_quadrature; }

  auto &parts() { return surface.facets; }

  /// Leads the upper box round, by few points: each has its own kinks.
  Loop<dim> make_loop()
  {
    settings.n_quadrature_points = may_be_renewed() ? 2 : 1;
    SpatialVector<dim> upwards = .05 * SpatialVector<dim>::Unit(dim - 1);
    upwards[dim - 2] += .01;
    return {shifted<dim>(moved(.07 * SpatialVector<dim>::Unit(0)), positions, -1.),
            shifted<dim>(moved(upwards), positions, -1.)};
  }

private:
  void become_one_body()
  {
    surface.n_bodies = 1;
    for (Facet<dim> &facet : surface.facets)
      facet.body = 0;
    for (std::size_t i = first_moving_node; i < surface.n_nodes(); ++i)
      surface.reference_positions[i][dim - 1] += .2;
    settings.self_contact = {0};
  }
};

template <int dim>
double dot(const Positions<dim> &u, const Positions<dim> &v)
{
  double sum = 0.;
  for (std::size_t i = 0; i < u.size(); ++i)
    sum += u[i].dot(v[i]);
  return sum;
}

template <int dim>
double norm(const Positions<dim> &u)
{
  return std::sqrt(dot<dim>(u, u));
}

/// The potential of a scene, at its positions.
template <typename Scene>
auto evaluate(const Scene &scene)
{
  auto potential = scene.make_potential();
  potential.update(scene.positions);
  potential.evaluate(scene.positions);
  return potential;
}

template <int dim, template <int> class Potential>
Positions<dim> compute_forces(const Potential<dim> &potential, std::size_t n_nodes)
{
  Positions<dim> forces(n_nodes, SpatialVector<dim>::Zero());
  potential.add_forces(forces);
  return forces;
}

/// Zeros, a row for each component of each node.
template <int dim>
Eigen::MatrixXd make_square(std::size_t n_nodes)
{
  const auto size = static_cast<Eigen::Index>(dim * n_nodes);
  return Eigen::MatrixXd::Zero(size, size);
}

template <int dim>
void add_block(const std::vector<unsigned int> &nodes, const Eigen::MatrixXd &block, Eigen::MatrixXd &matrix)
{
  for (std::size_t a = 0; a < nodes.size(); ++a)
    for (std::size_t b = 0; b < nodes.size(); ++b)
      matrix.template block<dim, dim>(dim * nodes[a], dim * nodes[b]) +=
          block.template block<dim, dim>(dim * a, dim * b);
}

template <int dim, template <int> class Potential>
Eigen::MatrixXd compute_tangent(const Potential<dim> &potential, std::size_t n_nodes)
{
  Eigen::MatrixXd tangent = make_square<dim>(n_nodes);
  potential.for_each_tangent([&](const auto &nodes, const Eigen::MatrixXd &block)
                             { add_block<dim>(nodes, block, tangent); });
  return tangent;
}

template <int dim>
std::vector<double> bound_stiffness(const contact::ContactPotential<dim> &potential, std::size_t n_nodes)
{
  std::vector<double> stiffness(n_nodes, 0.), damping(n_nodes, 0.);
  potential.add_row_sum_bounds(stiffness, damping);
  return stiffness;
}

/// All components in one column, node by node.
template <int dim>
Eigen::VectorXd flatten(const Positions<dim> &u)
{
  return Eigen::Map<const Eigen::VectorXd>(u.front().data(), static_cast<Eigen::Index>(dim * u.size()));
}
} // namespace signorini::test
