// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/coupling/contact_force.h"
#include "signorini/discretization/cut_box.h"
#include "signorini/physics/mass.h"
#include "signorini/solvers/explicit_solver.h"
#include "signorini/solvers/quasi_static_solver.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>

namespace signorini::test
{
/// Dimension and degree of a typed test.
template <int space_dim, unsigned int element_degree>
struct Case
{
  static constexpr int dim = space_dim;
  static constexpr unsigned int degree = element_degree;
};

using AllCases = testing::Types<Case<2, 1>, Case<2, 2>, Case<3, 1>, Case<3, 2>>;
using LinearCases = testing::Types<Case<2, 1>, Case<3, 1>>;

using Model = MaterialParameters::Model;

inline MaterialParameters make_material(Model model, double poissons_ratio = .3)
{
  MaterialParameters material;
  material.model = model;
  material.youngs_modulus = 1000.;
  material.poissons_ratio = poissons_ratio;
  material.density = 2.;
  return material;
}

/// A box from the origin unless moved.
inline BodyParameters make_box(const std::string &name, const Triple &upper,
                               const std::array<unsigned int, 3> &cells)
{
  BodyParameters body;
  body.name = name;
  body.mesh.upper_corner = upper;
  body.mesh.cells = cells;
  body.material = make_material(Model::neo_hookean);
  return body;
}

/// Curves the edges on the upper boundary of the last direction.
inline void bend_top(double bend, SimplexMesh &mesh)
{
  const unsigned int last = mesh.dimension - 1;
  for (const SimplexMesh::Face &face : mesh.faces)
    if (face.boundary == 2 * last + 1)
      for (unsigned int i = 0; i < mesh.dimension; ++i)
      {
        const unsigned int a = face.vertices[i], b = face.vertices[(i + 1) % mesh.dimension];
        Triple middle;
        for (unsigned int d = 0; d < 3; ++d)
          middle[d] = .5 * (mesh.vertices[a][d] + mesh.vertices[b][d]);
        middle[last] += bend;
        mesh.edge_midpoints[{std::min(a, b), std::max(a, b)}] = middle;
      }
}

/// The same box of simplices. `bend` moves the middles of the edges on the upper boundary of the last
/// direction along it [m].
inline BodyParameters make_simplex_box(const std::string &name, unsigned int dim, const Triple &upper,
                                       const std::array<unsigned int, 3> &cells, double bend = 0.)
{
  BodyParameters body = make_box(name, upper, cells);
  body.mesh.cell_type = MeshParameters::CellType::tetrahedra;
  if (bend == 0.)
    return body;
  auto mesh = std::make_shared<SimplexMesh>(make_cut_box(body.mesh, dim));
  bend_top(bend, *mesh);
  body.mesh.mesh_of_file = mesh;
  return body;
}

inline BodyParameters make_ball(const std::string &name, double radius, unsigned int refinements)
{
  BodyParameters body = make_box(name, {}, {});
  body.mesh.shape = MeshParameters::Shape::ball;
  body.mesh.radius = radius;
  body.mesh.refinements = refinements;
  return body;
}

/// Refines the cells that touch a point once more, which makes hanging nodes.
inline BodyParameters graded(BodyParameters body, const Triple &point, unsigned int levels = 1,
                             double distance = 1e-6)
{
  MeshParameters::Grading grading;
  grading.point = point;
  grading.distance = distance;
  grading.levels = levels;
  body.mesh.grading = grading;
  return body;
}

/// A cube [0, 1]^dim of 2^dim cells, one corner of it refined: the smallest body with hanging nodes.
inline BodyParameters make_graded_cube(const Triple &corner = {})
{
  return graded(make_box("cube", {1., 1., 1.}, {2, 2, 2}), corner);
}

inline SupportParameters make_support(const std::string &boundary,
                                      const std::array<std::optional<std::string>, 3> &displacement)
{
  SupportParameters support;
  support.boundary = boundary;
  support.displacement = displacement;
  return support;
}

/// Flags cells at random, though the same on any number of ranks; every mesh that comes of it has other
/// hanging nodes. Families become coarser together.
template <int dim>
void flag_at_random(Discretization<dim> &discretization, unsigned int seed, double coarsen_share)
{
  const auto chance_at = [seed](const dealii::Point<dim> &x)
  {
    const double mixed = std::sin(12.9898 * x[0] + 78.233 * x[1] + 37.719 * x[dim - 1] + seed) * 43758.5453;
    return mixed - std::floor(mixed);
  };
  for (const auto &cell : discretization.hexahedra->mesh.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      if (cell->level() > 0 && chance_at(cell->parent()->center()) < coarsen_share)
        cell->set_coarsen_flag();
      else if (chance_at(cell->center()) > .7 && cell->level() < 3)
        cell->set_refine_flag();
    }
}

/// What a simulation builds from its parameters, piece by piece.
template <int dim>
struct BuiltScene
{
  BuiltScene(
      const std::vector<BodyParameters> &bodies, unsigned int degree,
      const std::function<void(Parameters &)> &change = [](Parameters &) {})
      : parameters(make_parameters(bodies, degree, change)), scene(make_scene<dim>(parameters)),
        discretization(parameters, MPI_COMM_WORLD), supports(scene, discretization, 1.),
        map(scene, discretization)
  {
    forces.elasticity = std::make_shared<InternalForce<dim>>(scene.materials, discretization);
    state.displacement = discretization.make_vector();
    state.velocity = discretization.make_vector();
  }

  static Parameters make_parameters(const std::vector<BodyParameters> &bodies, unsigned int degree,
                                    const std::function<void(Parameters &)> &change)
  {
    Parameters parameters;
    parameters.dimension = dim;
    parameters.degree = degree;
    parameters.bodies = bodies;
    change(parameters);
    return parameters;
  }

  /// Uniform in [−amplitude, amplitude] on free entries, hanging ones interpolated.
  Vector random_vector(double amplitude, unsigned int seed = 1) const
  {
    Vector values = discretization.make_vector();
    std::mt19937 engine(seed);
    std::uniform_real_distribution<double> uniform(-amplitude, amplitude);
    for (unsigned int i = 0; i < values.locally_owned_size(); ++i)
      values.local_element(i) = uniform(engine);
    discretization.distribute(values);
    return values;
  }

  /// A vector field sampled at the nodes.
  Vector interpolate(const std::function<SpatialVector<dim>(const SpatialVector<dim> &)> &field) const
  {
    Vector values = discretization.make_vector();
    for (const OwnedNode<dim> &node : discretization.owned_nodes)
    {
      SpatialVector<dim> x;
      for (unsigned int d = 0; d < dim; ++d)
        x[d] = node.position[d];
      const SpatialVector<dim> value = field(x);
      for (unsigned int d = 0; d < dim; ++d)
        values.local_element(node.dofs[d]) = value[d];
    }
    discretization.distribute(values);
    return values;
  }

  /// Force of a term at a displacement, on free entries.
  Vector force_of(ForceTerm &term, const Vector &displacement)
  {
    state.displacement = displacement;
    Vector force = discretization.make_vector();
    term.update(state);
    term.add_force(force);
    discretization.collect(force);
    return force;
  }

  double energy_of(ForceTerm &term, const Vector &displacement)
  {
    state.displacement = displacement;
    term.update(state);
    return term.energy();
  }

  std::shared_ptr<ContactForce<dim>> add_contact(const contact::PotentialSettings &settings)
  {
    const auto contact = std::make_shared<ContactForce<dim>>("contact", !scene.obstacles.empty(), map,
                                                             scene.obstacles, settings, MPI_COMM_WORLD);
    forces.contacts.push_back(contact);
    forces.surface_contacts.push_back(contact);
    if (settings.damping_ratio)
      forces.damped_contacts.push_back(contact);
    if (scene.is_any_obstacle_moving())
    {
      contact->set_motions(scene.obstacle_motions);
      forces.moving_contacts.push_back(contact);
    }
    return contact;
  }

  /// Free entries: neither hanging nor supported.
  std::vector<unsigned int> free_dofs() const
  {
    std::vector<bool> is_free(discretization.make_vector().locally_owned_size(), true);
    for (const HangingDof &hanging : discretization.hanging_dofs)
      is_free[hanging.dof] = false;
    for (const unsigned int dof : supports.owned_dofs())
      is_free[dof] = false;
    std::vector<unsigned int> dofs;
    for (unsigned int i = 0; i < is_free.size(); ++i)
      if (is_free[i])
        dofs.push_back(i);
    return dofs;
  }

  Parameters parameters;
  Scene<dim> scene;
  Discretization<dim> discretization;
  SupportedDofs<dim> supports;
  SurfaceMap<dim> map;
  SceneForces<dim> forces;
  PointValues memory; ///< of points, carried along when the mesh changes
  State state;
  RunTime run_time;
};

/// BulkBound's at the state of the last update of the elasticity [1/s²].
template <int dim>
double bulk_frequency_squared(const BuiltScene<dim> &built)
{
  BulkBound<dim> bound(*built.forces.elasticity, built.forces.viscosities, built.scene.materials,
                       built.discretization);
  bound.update(built.state);
  return bound.frequency_squared();
}

/// −dE/du·direction by a central difference against f·direction.
template <int dim>
void expect_force_is_energy_gradient(BuiltScene<dim> &built, ForceTerm &term, const Vector &displacement,
                                     double step = 1e-6, double tolerance = 1e-7)
{
  const Vector force = built.force_of(term, displacement);
  for (unsigned int seed = 11; seed < 14; ++seed)
  {
    const Vector direction = built.random_vector(1., seed);
    Vector forth = displacement, back = displacement;
    forth.add(step, direction);
    back.add(-step, direction);
    const double slope = (built.energy_of(term, forth) - built.energy_of(term, back)) / (2. * step);
    EXPECT_NEAR(force * direction, -slope, tolerance * force.l2_norm() * direction.l2_norm());
  }
}

/// Assembled tangent of some terms at the present state; rows and columns of hanging entries are zero.
template <int dim>
Eigen::MatrixXd assemble_tangent(BuiltScene<dim> &built, const std::vector<ForceTerm *> &terms)
{
  const Discretization<dim> &discretization = built.discretization;
  dealii::AffineConstraints<double> constraints(built.map.relevant_dofs());
  constraints.merge(discretization.hanging_constraints,
                    dealii::AffineConstraints<double>::no_conflicts_allowed, true);
  constraints.close();

  TangentSystem system;
  system.constraints = &constraints;
  dealii::TrilinosWrappers::SparsityPattern pattern(discretization.owned_dofs, discretization.owned_dofs,
                                                    built.map.relevant_dofs(), MPI_COMM_WORLD);
  discretization.add_couplings(constraints, pattern);
  for (const ForceTerm *term : terms)
    term->add_couplings(constraints, pattern);
  pattern.compress();
  system.matrix.reinit(pattern);
  system.right_hand_side.reinit(discretization.owned_dofs, MPI_COMM_WORLD);
  for (const ForceTerm *term : terms)
    term->add_tangent(system);
  system.matrix.compress(dealii::VectorOperation::add);

  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(system.matrix.m(), system.matrix.m());
  for (const auto &entry : system.matrix)
    if (!constraints.is_constrained(entry.row()) && !constraints.is_constrained(entry.column()))
      dense(entry.row(), entry.column()) = entry.value();
  return dense;
}

/// Free entries of a vector, zero elsewhere.
template <int dim>
Eigen::VectorXd free_part(const BuiltScene<dim> &built, const Vector &values)
{
  Eigen::VectorXd part = Eigen::VectorXd::Zero(values.locally_owned_size());
  for (const unsigned int dof : built.free_dofs())
    part[dof] = values.local_element(dof);
  return part;
}

/// Assembled tangent times a direction against −df/du·direction.
template <int dim>
void expect_tangent_is_force_gradient(BuiltScene<dim> &built, ForceTerm &term, const Vector &displacement,
                                      double step = 1e-6, double tolerance = 1e-6)
{
  built.force_of(term, displacement);
  const Eigen::MatrixXd tangent = assemble_tangent(built, {&term});
  EXPECT_LT((tangent - tangent.transpose()).norm(), 1e-12 * tangent.norm());
  for (unsigned int seed = 21; seed < 24; ++seed)
  {
    const Vector direction = built.random_vector(1., seed);
    Vector forth = displacement, back = displacement;
    forth.add(step, direction);
    back.add(-step, direction);
    Vector difference = built.force_of(term, back);
    difference -= built.force_of(term, forth);
    const Eigen::VectorXd product = tangent * free_part(built, direction);
    ASSERT_GT(product.norm(), 0.);
    EXPECT_LT((product - free_part(built, difference) / (2. * step)).norm(), tolerance * product.norm());
  }
}
} // namespace signorini::test
