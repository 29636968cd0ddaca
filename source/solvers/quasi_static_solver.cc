// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/solvers/quasi_static_solver.h"

#include "signorini/base/exceptions.h"
#include "signorini/parameters/run_parameters.h"
#include "signorini/physics/mass.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <cmath>
#include <limits>
#include <utility>

namespace signorini
{
namespace
{
/// Up to about so many degrees of freedom sparse factorisation beats incomplete factors, or multigrid
/// (measured in 3-D, doc/theory.md).
struct DirectLimits
{
  unsigned int against_incomplete, against_multigrid;
};
constexpr DirectLimits direct_limits_2d{200000, 200000}, direct_limits_3d{3000, 60000};

/// Holds frictions for an iteration, until the end of its scope, whatever ends it.
template <int dim>
class Hold
{
public:
  explicit Hold(const SceneForces<dim> &scene_forces) : forces(scene_forces)
  {
    for (const auto &friction : forces.frictions)
      friction->hold();
  }
  ~Hold()
  {
    for (const auto &friction : forces.frictions)
      friction->release();
  }
  Hold(const Hold &) = delete;
  Hold &operator=(const Hold &) = delete;

private:
  const SceneForces<dim> &forces;
};
} // namespace

template <int dim>
QuasiStaticSolver<dim>::QuasiStaticSolver(const Discretization<dim> &the_discretization,
                                          const SupportedDofs<dim> &supported_dofs,
                                          const Scene<dim> &the_scene, const std::vector<bool> &held_bodies,
                                          const SceneForces<dim> &scene_forces,
                                          const SurfaceMap<dim> *surface_map,
                                          const QuasiStaticParameters &quasi_static_parameters,
                                          RunTime &the_run_time)
    : discretization(&the_discretization), supports(&supported_dofs), scene(&the_scene),
      is_body_held(held_bodies), forces(&scene_forces), parameters(quasi_static_parameters),
      run_time(&the_run_time), balance(the_discretization, supported_dofs, the_scene.n_bodies(), scene_forces,
                                       surface_map, the_run_time),
      system(the_discretization, supported_dofs, scene_forces, balance.terms(), make_regularization(),
             choose_linear_solver(), the_run_time)
{
  if (surface_map)
    longest_step = 0.25 * surface_map->surface().smallest_room();
  for (const auto &obstacle : scene->obstacles)
    longest_step = std::min(longest_step, 0.25 * obstacle->room());
}

template <int dim>
std::unique_ptr<LinearSolver> QuasiStaticSolver<dim>::choose_linear_solver() const
{
  using Choice = QuasiStaticParameters::LinearSolver;
  const unsigned int n_dofs = discretization->owned_dofs.size();
  const bool is_symmetric = forces->frictions.empty();
  const Symmetry symmetry = is_symmetric ? Symmetry::symmetric : Symmetry::unsymmetric;
  const DirectLimits &limits = dim == 2 ? direct_limits_2d : direct_limits_3d;
  const bool is_automatic = parameters.linear_solver == Choice::automatic;
  const auto make_without_incomplete = [&]
  {
    return parameters.linear_solver == Choice::direct || (is_automatic && n_dofs <= limits.against_multigrid)
               ? make_direct_solver(symmetry)
               : make_amg_solver(dim, symmetry);
  };
  const bool is_incomplete = is_symmetric && (parameters.linear_solver == Choice::cg_ic ||
                                              (is_automatic && n_dofs > limits.against_incomplete));
  return is_incomplete ? make_schwarz_solver(make_without_incomplete()) : make_without_incomplete();
}

template <int dim>
Vector QuasiStaticSolver<dim>::make_regularization() const
{
  Vector regularization = discretization->make_vector();
  std::vector<double> volume(scene->n_bodies(), 0.);
  const Vector nodal_volume = make_nodal_volume(*discretization);
  for (const OwnedNode<dim> &node : discretization->owned_nodes)
    volume[node.body] += nodal_volume.local_element(node.dofs[0]);
  dealii::Utilities::MPI::sum(volume, discretization->communicator(), volume);
  for (const OwnedNode<dim> &node : discretization->owned_nodes)
    if (!is_body_held[node.body])
      for (const unsigned int dof : node.dofs)
        regularization.local_element(dof) = 1e-6 * scene->materials[node.body].youngs_modulus *
                                            std::pow(volume[node.body], -2. / dim) *
                                            nodal_volume.local_element(dof);
  return regularization;
}

template <int dim>
double QuasiStaticSolver<dim>::forcing(double residual, double residual_before, double tolerance) const
{
  // S. C. Eisenstat, H. F. Walker, SIAM J. Sci. Comput. 17, 1996, choice 2: as exact as Newton's method
  // can use. Where nothing makes the next system another, one solve has to do.
  constexpr double exact = 1e-8, coarsest = 0.05;
  if (forces->contacts.empty() && forces->elasticity->has_constant_tangent())
    return exact;
  const bool is_first = residual_before == std::numeric_limits<double>::max();
  const double ratio = is_first ? 1. : residual / residual_before;
  const double enough = std::max(exact, 0.1 * tolerance / residual);
  return std::min(coarsest, std::max(enough, 0.9 * ratio * ratio));
}

template <int dim>
unsigned int QuasiStaticSolver<dim>::compute_increment(double residual, double linear_tolerance,
                                                       Vector &increment)
{
  // Far from equilibrium bodies may lie so deep in each other that the exact tangent is indefinite; near it
  // only the exact one converges fast.
  if (residual < 0.2)
    tangent = ContactTangent::exact;
  std::optional<unsigned int> n_iterations =
      system.solve(balance.residual(), tangent, linear_tolerance, increment);
  if (!n_iterations && tangent == ContactTangent::exact)
  {
    tangent = ContactTangent::convex;
    n_iterations = system.solve(balance.residual(), tangent, linear_tolerance, increment);
  }
  if (!n_iterations)
    throw NumericalError("the tangent of the bodies is indefinite, as of one that buckles");
  return *n_iterations;
}

template <int dim>
void QuasiStaticSolver<dim>::predict(Vector &increment)
{
  // Newton's method puts right what is left.
  constexpr double tolerance = 1e-3;
  const Vector none = discretization->make_vector();
  if (!system.solve(none, ContactTangent::exact, tolerance, increment) &&
      !system.solve(none, ContactTangent::convex, tolerance, increment))
    throw NumericalError("the tangent of the bodies is indefinite, as of one that buckles");
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
  // round-off, then the slope does. Friction has no energy: there the slope may decide earlier. Where the
  // tangent is indefinite Newton's direction may lead uphill: then its opposite leads down.
  const double newton_slope = -(balance.residual() * increment);
  const double direction = newton_slope > 0. ? -1. : 1.;
  const double slope = direction * newton_slope;

  const double energy = balance.energy();
  const unsigned int searches = system.n_searches();
  const Vector start = state.displacement;
  double step = limit_of_step(increment);
  for (unsigned int trial = 0; trial < 30; ++trial, step *= 0.5)
  {
    state.displacement = start;
    state.displacement.add(direction * step, increment);
    discretization->distribute(state.displacement);
    balance.compute(state);
    const double new_energy = balance.energy();
    if (!std::isfinite(new_energy))
      continue;
    if (system.n_searches() != searches)
      return step;
    const double new_slope = -direction * (balance.residual() * increment);
    const double round_off = 1e-10 * (std::abs(energy) + std::abs(new_energy));
    const bool may_slope_decide = new_energy <= energy + round_off || !forces->frictions.empty();
    if (new_energy <= energy + 1e-4 * step * slope ||
        (may_slope_decide && std::abs(new_slope) <= (1. - 0.1 * step) * std::abs(slope)))
      return step;
  }
  return 0.;
}

template <int dim>
void QuasiStaticSolver<dim>::move_supports(double time, State &state)
{
  // With the supports everything moves by the linear prediction; what that and the obstacles leave is
  // Newton's.
  const double old_time = state.time;
  state.time = time;
  const bool do_supports_move = system.constrain(old_time, time);
  for (unsigned int i = 0; i < scene->obstacles.size(); ++i)
  {
    const ObstacleMotion<dim> &motion = scene->obstacle_motions[i];
    if ((motion.displacement(time) - motion.displacement(old_time)).norm() > 3. * longest_step)
      throw NumericalError(
          Complaint(fmt::format("obstacle '{}' moves so far in one step that it could pass through surfaces",
                                scene->obstacles[i]->name()))
              .advise("use more load steps, unless its Displacement jumps: let it grow with t"));
  }
  balance.compute(state);
  if (!do_supports_move)
    return;
  Vector increment = discretization->make_vector();
  predict(increment);
  if (longest_step > 0. && increment.linfty_norm() > 3. * longest_step)
    throw NumericalError("the supports move so far in one step that surfaces could pass through each other");
  state.displacement += increment;
  supports->impose(time, state.displacement);
  discretization->distribute(state.displacement);
  system.constrain(time, time);
}

template <int dim>
void QuasiStaticSolver<dim>::renew_terms(const State &state)
{
  for (const auto &term : balance.terms())
  {
    const auto section = run_time->enter(term->name);
    term->renew(state);
  }
}

template <int dim>
void QuasiStaticSolver<dim>::iterate(double residual_before, double tolerance, State &state,
                                     NewtonReport &progress)
{
  const Hold<dim> hold(*forces);
  if (!forces->frictions.empty())
    balance.compute(state);
  Vector increment = discretization->make_vector();
  progress.linear_iterations =
      compute_increment(progress.residual, forcing(progress.residual, residual_before, tolerance), increment);
  progress.step_length = search_along(increment, state);
  if (progress.step_length == 0.)
    give_up("no step along Newton's direction lowers the energy", "use more load steps");
  ++total_iterations;
  ++progress.iteration;
}

template <int dim>
bool QuasiStaticSolver<dim>::find_minimum(double tolerance, State &state, NewtonReport &progress,
                                          const Report &report)
{
  progress.residual = std::numeric_limits<double>::max();
  for (;;)
  {
    const double residual_before = progress.residual;
    progress.residual = balance.judge(state);
    report(progress);
    if (!std::isfinite(progress.residual))
      give_up("an element was turned inside out",
              "use more load steps, or check loads against the stiffness");
    const bool has_stagnated = progress.residual > 0.5 * residual_before;
    if (balance.is_within(tolerance, has_stagnated))
      return has_stagnated;
    if (progress.iteration >= parameters.max_iterations)
      give_up(fmt::format("Newton's method only reached a relative residual of {:.3g}", progress.residual),
              "use more load steps, or raise Quasi-static/Maximum iterations");
    iterate(residual_before, tolerance, state, progress);
  }
}

template <int dim>
void QuasiStaticSolver<dim>::find_equilibrium(double time, Way way, State &state, const Report &report)
{
  renew_terms(state);
  balance.judge(state); // the forces to come from: what round-off is relative to
  move_supports(time, state);
  NewtonReport progress;
  if (way == Way::by_soft_contact)
    approach(state, progress, report);
  // Where points of integration still have to follow the bodies far, nothing more exact than what that
  // changes is of use.
  double tolerance = was_softened ? std::max(0.01, parameters.tolerance) : parameters.tolerance;
  double disturbance_before = std::numeric_limits<double>::max();
  for (bool is_first = true;; is_first = false)
  {
    // Points of integration follow the bodies: what was found with the old ones must be an equilibrium with
    // the new.
    const bool has_stagnated = find_minimum(tolerance, state, progress, report);
    renew_terms(state);
    disturbance = balance.judge(state);
    const bool is_rough = tolerance > parameters.tolerance;
    if (!is_rough && balance.is_within(10. * parameters.tolerance, has_stagnated))
    {
      disturbance = 0.;
      return;
    }
    if (disturbance > 0.5 * disturbance_before)
      break;
    tolerance = std::max(0.01 * disturbance, parameters.tolerance);
    if (!is_first)
      disturbance_before = disturbance;
  }
  // Points and bodies follow each other around: let the points be.
  find_minimum(parameters.tolerance, state, progress, report);
}

template <int dim>
void QuasiStaticSolver<dim>::give_up(const std::string &why, const std::string &advice) const
{
  for (unsigned int body = 0; body < scene->n_bodies(); ++body)
    if (!is_body_held[body] && !balance.is_touched(body) && balance.is_loaded(body))
      throw NumericalError(
          Complaint(fmt::format("{}; body '{}' flies off: nothing touches it", why, scene->body_names[body]))
              .advise("check that the loads press the bodies together, or add a support"));
  const unsigned int body = balance.worst_body();
  const std::string what =
      fmt::format("{}; body '{}' is farthest from equilibrium", why, scene->body_names[body]);
  const SpatialVector<dim> net_force = balance.unbalanced_force(body);
  if (!is_body_held[body] && net_force.norm() > 0.)
    throw NumericalError(
        Complaint(fmt::format("{}: a net force of ({:.4g}) N is left that nothing balances", what,
                              fmt::join(net_force.data(), net_force.data() + dim, ", ")))
            .advise(forces->frictions.empty() ? "add a support: contact without friction lets bodies slide"
                                              : "add a support, or press harder: the body slides"));
  if (const double share = balance.round_off_share(body); share > parameters.tolerance)
    throw NumericalError(
        Complaint(fmt::format("{}, where round-off alone may be {:.1g} of the forces", what, share))
            .advise(
                share < largest_newton_tolerance
                    ? "lower Contact/Penalty factor, or raise Tolerance above that share"
                    : "lower Contact/Penalty factor; no Tolerance that is allowed lies above that share"));
  throw NumericalError(Complaint(what).advise(advice));
}

template <int dim>
bool QuasiStaticSolver<dim>::solve(double time, State &state, const Report &report)
{
  const State before = state;
  was_softened = false;
  for (const Way way : {Way::by_soft_contact, Way::straight})
    try
    {
      find_equilibrium(time, way, state, report);
      return true;
    }
    catch (const NumericalError &error)
    {
      complaint = error.complaint();
      state = before;
      if (!std::exchange(was_softened, false))
        break;
    }
  return false;
}

template class QuasiStaticSolver<2>;
template class QuasiStaticSolver<3>;
} // namespace signorini
