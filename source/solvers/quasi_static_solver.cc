// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/solvers/quasi_static_solver.h"

#include "signorini/base/exceptions.h"
#include "signorini/physics/mass.h"

#include <deal.II/dofs/dof_tools.h>

#include <fmt/core.h>

#include <cmath>
#include <limits>

namespace signorini
{
namespace
{
/// Up to here sparse factorisation beats iteration (measured, doc/theory.md).
constexpr unsigned int max_n_dofs_direct_3d = 30000, max_n_dofs_direct_2d = 200000;

/// However stiff the contact, a larger share of a body's forces is never taken for round-off.
constexpr double largest_round_off_share = 1e-4;

/// After so many equilibria that new points of integration disturbed, the last one is taken.
constexpr unsigned int max_renewal_rounds = 6;
} // namespace

template <int dim>
QuasiStaticSolver<dim>::QuasiStaticSolver(const Discretization<dim> &the_discretization,
                                          const SupportedDofs<dim> &supported_dofs,
                                          const std::vector<MaterialParameters> &the_materials,
                                          const std::vector<bool> &is_body_held, SceneForces<dim> &the_forces,
                                          const SurfaceMap<dim> *surface_map,
                                          const QuasiStaticParameters &quasi_static_parameters,
                                          RunTime &the_run_time)
    : discretization(&the_discretization), supports(&supported_dofs), materials(&the_materials),
      forces(&the_forces), map(surface_map), parameters(quasi_static_parameters), run_time(&the_run_time),
      residual(the_discretization.make_vector()), support_forces(the_discretization.make_vector()),
      regularization(the_discretization.make_vector())
{
  terms.push_back(forces->elasticity);
  terms.insert(terms.end(), forces->loads.begin(), forces->loads.end());
  terms.insert(terms.end(), forces->contacts.begin(), forces->contacts.end());

  const unsigned int n_dofs = discretization->dof_handler.n_dofs();
  const bool is_direct = parameters.linear_solver == QuasiStaticParameters::LinearSolver::automatic
                             ? n_dofs <= (dim == 2 ? max_n_dofs_direct_2d : max_n_dofs_direct_3d)
                             : parameters.linear_solver == QuasiStaticParameters::LinearSolver::direct;
  linear_solver = is_direct ? make_direct_solver() : make_amg_solver(dim, 1e-8);

  std::vector<double> volume(materials->size(), 0.);
  const Vector nodal_volume = make_nodal_volume(*discretization);
  for (const OwnedNode<dim> &node : discretization->owned_nodes)
    volume[node.body] += nodal_volume.local_element(node.dofs[0]);
  dealii::Utilities::MPI::sum(volume, discretization->communicator(), volume);
  for (const OwnedNode<dim> &node : discretization->owned_nodes)
    if (!is_body_held[node.body])
      for (const unsigned int dof : node.dofs)
        regularization.local_element(dof) = 1e-6 * (*materials)[node.body].youngs_modulus *
                                            std::pow(volume[node.body], -2. / dim) *
                                            nodal_volume.local_element(dof);
  if (map)
  {
    longest_step = std::numeric_limits<double>::max();
    for (const Facet<dim> &facet : map->surface().facets)
      longest_step = std::min(longest_step, 0.25 * facet.layer_thickness);
  }
}

template <int dim>
unsigned int QuasiStaticSolver<dim>::n_searches() const
{
  unsigned int n = 0;
  for (const auto &term : terms)
    n += term->n_searches();
  return n;
}

template <int dim>
bool QuasiStaticSolver<dim>::solve(double time, State &state,
                                   const std::function<void(const NewtonReport &)> &report)
{
  const State before = state;
  if (iterate(time, state, report))
    return true;
  state = before;
  return false;
}

template <int dim>
void QuasiStaticSolver<dim>::compute_residual(const State &state)
{
  residual = 0.;
  scales.assign(materials->size(), 0.);
  Vector force = discretization->make_vector();
  for (const auto &term : terms)
  {
    const auto section = run_time->enter(term->name);
    force = 0.;
    term->update(state);
    term->add_force(force);
    discretization->collect(force);
    residual += force;
    for (const OwnedNode<dim> &node : discretization->owned_nodes)
      for (const unsigned int dof : node.dofs)
        scales[node.body] += force.local_element(dof) * force.local_element(dof);
  }
  dealii::Utilities::MPI::sum(scales, discretization->communicator(), scales);
  for (double &scale : scales)
    scale = std::sqrt(scale);
  support_forces = 0.;
  for (const unsigned int dof : supports->owned_dofs())
    support_forces.local_element(dof) = -residual.local_element(dof);
  supports->clear(residual);
}

template <int dim>
std::vector<double> QuasiStaticSolver<dim>::body_norms(const Vector &values) const
{
  std::vector<double> norms(materials->size(), 0.);
  for (const OwnedNode<dim> &node : discretization->owned_nodes)
    for (const unsigned int dof : node.dofs)
      norms[node.body] += values.local_element(dof) * values.local_element(dof);
  dealii::Utilities::MPI::sum(norms, discretization->communicator(), norms);
  for (double &norm : norms)
    norm = std::sqrt(norm);
  return norms;
}

template <int dim>
void QuasiStaticSolver<dim>::judge_bodies(const State &state)
{
  compute_residual(state);
  Vector elastic = discretization->make_vector();
  forces->elasticity->add_magnitudes(elastic);
  discretization->collect(elastic);
  Vector stiffness = discretization->make_vector(), damping = discretization->make_vector();
  for (const auto &contact : forces->contacts)
    contact->add_row_sum_bounds(stiffness, damping);
  for (const OwnedNode<dim> &node : discretization->owned_nodes)
    for (unsigned int d = 0; d < dim; ++d)
      stiffness.local_element(node.dofs[d]) *=
          node.position[d] + state.displacement.local_element(node.dofs[d]);

  const std::vector<double> norms = body_norms(residual), elastic_magnitudes = body_norms(elastic),
                            contact_magnitudes = body_norms(stiffness);
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  relative_residuals.assign(norms.size(), 0.);
  round_off_shares.assign(norms.size(), 0.);
  for (unsigned int body = 0; body < norms.size(); ++body)
  {
    // Where all forces of a body are round-off there is nothing to judge.
    const bool is_at_rest = norms[body] <= 4. * epsilon * elastic_magnitudes[body] ||
                            scales[body] <= 4. * epsilon * contact_magnitudes[body];
    if (!std::isfinite(norms[body] + scales[body]))
      relative_residuals[body] = std::numeric_limits<double>::quiet_NaN();
    else if (!is_at_rest)
    {
      relative_residuals[body] = norms[body] / scales[body];
      round_off_shares[body] =
          std::min(largest_round_off_share, epsilon * contact_magnitudes[body] / scales[body]);
    }
  }
}

template <int dim>
double QuasiStaticSolver<dim>::relative_residual(const State &state)
{
  judge_bodies(state);
  double largest = 0.;
  for (const double relative : relative_residuals)
    largest = std::isnan(relative) || std::isnan(largest) ? std::numeric_limits<double>::quiet_NaN()
                                                          : std::max(largest, relative);
  return largest;
}

template <int dim>
bool QuasiStaticSolver<dim>::is_within(double tolerance, bool has_stagnated) const
{
  for (unsigned int body = 0; body < relative_residuals.size(); ++body)
    if (relative_residuals[body] > std::max(tolerance, has_stagnated ? round_off_shares[body] : 0.))
      return false;
  return true;
}

template <int dim>
double QuasiStaticSolver<dim>::total_energy() const
{
  double sum = 0.;
  for (const auto &term : terms)
    sum += term->energy();
  return sum;
}

template <int dim>
bool QuasiStaticSolver<dim>::make_constraints(double old_time, double time)
{
  bool do_supports_move = false;
  constraints.reinit(map ? map->relevant_dofs() : discretization->relevant_dofs);
  dealii::DoFTools::make_hanging_node_constraints(discretization->dof_handler, constraints);
  if (map)
    map->add_remote_hanging_constraints(constraints);
  for (const auto &entry : supports->entries())
  {
    const double increment = supports->value(entry, time) - supports->value(entry, old_time);
    do_supports_move |= increment != 0.;
    if (constraints.can_store_line(entry.dof) && !constraints.is_constrained(entry.dof))
    {
      constraints.add_line(entry.dof);
      constraints.set_inhomogeneity(entry.dof, increment);
    }
  }
  for (const dealii::types::global_dof_index dof : discretization->unused_dofs)
    constraints.add_line(dof);
  constraints.close();
  system.constraints = &constraints;
  return do_supports_move;
}

template <int dim>
void QuasiStaticSolver<dim>::rebuild_matrix()
{
  dealii::TrilinosWrappers::SparsityPattern pattern(
      discretization->owned_dofs, discretization->owned_dofs,
      map ? map->relevant_dofs() : discretization->relevant_dofs, discretization->communicator());
  dealii::DoFTools::make_sparsity_pattern(
      discretization->dof_handler, pattern, constraints, false,
      dealii::Utilities::MPI::this_mpi_process(discretization->communicator()));
  for (const auto &term : terms)
    term->add_couplings(constraints, pattern);
  for (const dealii::types::global_dof_index dof : discretization->unused_dofs)
    pattern.add(dof, dof);
  pattern.compress();
  system.matrix.reinit(pattern);
  system.right_hand_side.reinit(discretization->owned_dofs, discretization->communicator());
  n_searches_of_matrix = n_searches();
}

template <int dim>
unsigned int QuasiStaticSolver<dim>::compute_increment(DrivenBy cause, Vector &increment)
{
  assemble(cause);
  const auto section = run_time->enter("linear solver");
  const auto &partitioner = *residual.get_partitioner();
  dealii::TrilinosWrappers::MPI::Vector solution(discretization->owned_dofs, discretization->communicator());
  const unsigned int n_iterations = linear_solver->solve(system.matrix, system.right_hand_side, solution);
  constraints.distribute(solution);
  for (unsigned int i = 0; i < increment.locally_owned_size(); ++i)
    increment.local_element(i) = solution[partitioner.local_to_global(i)];
  discretization->distribute(increment);
  return n_iterations;
}

template <int dim>
void QuasiStaticSolver<dim>::assemble(DrivenBy cause)
{
  const auto section = run_time->enter("assembly");
  if (n_searches() != n_searches_of_matrix)
    rebuild_matrix();
  system.matrix = 0.;
  system.right_hand_side = 0.;
  for (const auto &term : terms)
    term->add_tangent(system);
  const auto &partitioner = *residual.get_partitioner();
  for (unsigned int i = 0; i < residual.locally_owned_size(); ++i)
  {
    const dealii::types::global_dof_index dof = partitioner.local_to_global(i);
    if (cause == DrivenBy::residual)
      system.right_hand_side[dof] += residual.local_element(i);
    system.matrix.add(dof, dof, constraints.is_constrained(dof) ? 0. : regularization.local_element(i));
  }
  for (const dealii::types::global_dof_index dof : discretization->unused_dofs)
    system.matrix.add(dof, dof, 1.);
  system.matrix.compress(dealii::VectorOperation::add);
  system.right_hand_side.compress(dealii::VectorOperation::add);
}

template <int dim>
double QuasiStaticSolver<dim>::limit_of_step(const Vector &increment) const
{
  const double farthest = increment.linfty_norm();
  return longest_step > 0. && farthest > longest_step ? longest_step / farthest : 1.;
}

template <int dim>
double QuasiStaticSolver<dim>::search_along(const Vector &increment, State &state)
{
  // Approximate Wolfe conditions (W. W. Hager, H. Zhang, 2005): the energy decides until it drowns in
  // round-off, then the slope does. Where the tangent is indefinite Newton's direction may lead uphill: then
  // its opposite leads down.
  const double newton_slope = -(residual * increment);
  const double direction = newton_slope > 0. ? -1. : 1.;
  const double slope = direction * newton_slope;
  const double energy = total_energy();
  const unsigned int searches = n_searches();
  const Vector start = state.displacement;
  double step = limit_of_step(increment);
  for (unsigned int trial = 0; trial < 30; ++trial, step *= 0.5)
  {
    state.displacement = start;
    state.displacement.add(direction * step, increment);
    discretization->distribute(state.displacement);
    compute_residual(state);
    const double new_energy = total_energy();
    if (!std::isfinite(new_energy))
      continue;
    if (n_searches() != searches)
      return step;
    const double new_slope = -direction * (residual * increment);
    const double round_off = 1e-10 * (std::abs(energy) + std::abs(new_energy));
    if (new_energy <= energy + 1e-4 * step * slope ||
        (new_energy <= energy + round_off && std::abs(new_slope) <= 0.9 * std::abs(slope)))
      return step;
  }
  return 0.;
}

template <int dim>
void QuasiStaticSolver<dim>::move_supports(double time, State &state)
{
  // With the supports everything moves by the linear prediction; what that leaves is Newton's.
  const double old_time = state.time;
  state.time = time;
  const bool do_supports_move = make_constraints(old_time, time);
  compute_residual(state);
  if (!do_supports_move)
    return;
  Vector increment = discretization->make_vector();
  compute_increment(DrivenBy::supports, increment);
  if (longest_step > 0. && increment.linfty_norm() > 3. * longest_step)
    throw NumericalError("the supports move so far in one step that surfaces could pass through each other");
  state.displacement += increment;
  supports->impose(time, state.displacement);
  discretization->distribute(state.displacement);
  make_constraints(time, time);
}

template <int dim>
bool QuasiStaticSolver<dim>::has_converged(const State &state, double error, double error_before)
{
  const bool has_stagnated = error > 0.5 * error_before;
  if (!is_within(parameters.tolerance, has_stagnated))
    return false;
  // Points of integration follow the bodies: what was found with the old ones must be an equilibrium with the
  // new.
  for (const auto &term : terms)
    term->renew(state);
  residual_after_renewal = relative_residual(state);
  return is_within(10. * parameters.tolerance, has_stagnated) || ++n_renewal_rounds == max_renewal_rounds;
}

template <int dim>
bool QuasiStaticSolver<dim>::iterate(double time, State &state,
                                     const std::function<void(const NewtonReport &)> &report)
{
  for (const auto &term : terms)
    term->renew(state);
  Vector increment = discretization->make_vector();
  NewtonReport progress;
  progress.residual = std::numeric_limits<double>::max();
  n_renewal_rounds = 0;
  try
  {
    move_supports(time, state);
    for (;; ++progress.iteration)
    {
      const double residual_before = progress.residual;
      progress.residual = relative_residual(state);
      report(progress);
      if (!std::isfinite(progress.residual))
        throw NumericalError("an element was turned inside out");
      if (has_converged(state, progress.residual, residual_before))
        return true;
      if (progress.iteration == parameters.max_iterations)
        throw NumericalError(fmt::format("Newton's method only reached a relative residual of {:.3g}",
                                         relative_residual(state)));
      progress.linear_iterations = compute_increment(DrivenBy::residual, increment);
      progress.step_length = search_along(increment, state);
      if (progress.step_length == 0.)
        throw NumericalError("no step along Newton's direction lowers the energy");
      ++total_iterations;
    }
  }
  catch (const NumericalError &error)
  {
    reason = error.complaint().what;
    return false;
  }
}

template class QuasiStaticSolver<2>;
template class QuasiStaticSolver<3>;
} // namespace signorini
