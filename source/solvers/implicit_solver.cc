// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/solvers/implicit_solver.h"

#include "signorini/physics/mass.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace signorini
{
namespace
{
/// Rounds in which contact settles in the middle of a step; the moments it leaves fall from each to the next.
constexpr unsigned int n_settling_rounds = 2;
} // namespace

template <int dim>
ImplicitSolver<dim>::ImplicitSolver(const Discretization<dim> &the_discretization,
                                    const SupportedDofs<dim> &supported_dofs, const Scene<dim> &scene,
                                    const SceneForces<dim> &scene_forces, const SurfaceMap<dim> *map,
                                    const ImplicitParameters &parameters, RunTime &the_run_time)
    : discretization(&the_discretization), supports(&supported_dofs), forces(&scene_forces),
      mass(make_lumped_mass(scene.materials, the_discretization)),
      inertia(std::make_shared<StepInertia<dim>>(mass)),
      impulse(std::make_shared<ConstantForce<dim>>("loads and momentum")),
      step_forces(replace_loads(scene_forces, {inertia, impulse})),
      newton(the_discretization, supported_dofs, scene, std::vector<bool>(scene.n_bodies(), true),
             step_forces, map, make_newton_parameters(parameters), the_run_time)
{
  for (Vector *vector :
       {&load_force, &inner_force, &contact_force, &outer_contact_force, &change, &accepted_change})
    *vector = discretization->make_vector();
}

template <int dim>
SceneForces<dim> ImplicitSolver<dim>::replace_loads(SceneForces<dim> forces,
                                                    std::vector<std::shared_ptr<ForceTerm>> loads)
{
  forces.loads = std::move(loads);
  return forces;
}

template <int dim>
QuasiStaticParameters ImplicitSolver<dim>::make_newton_parameters(const ImplicitParameters &parameters)
{
  QuasiStaticParameters newton_parameters;
  newton_parameters.tolerance = parameters.tolerance;
  newton_parameters.max_iterations = parameters.max_iterations;
  newton_parameters.linear_solver = parameters.linear_solver;
  return newton_parameters;
}

template <int dim>
void ImplicitSolver<dim>::start(State &state)
{
  supports->impose(state.time, state.displacement);
  discretization->distribute(state.displacement);
  discretization->distribute(state.velocity);
  contact_energy = 0.;
  for (const auto &contact : forces->contacts)
  {
    contact->renew(state);
    contact->update(state);
    contact_energy += contact->energy();
  }
  for (const auto &friction : forces->frictions)
  {
    friction->update(state.velocity);
    friction->commit();
  }
  forces->elasticity->update(state);
  take_stock(state);
  elastic_energy_before = this->energy_ledger.elastic;
  this->open_ledgers();
  largest_speed = norm_by_mass(state.velocity);
}

template <int dim>
Vector ImplicitSolver<dim>::compute_loads(const State &state) const
{
  Vector sum = discretization->make_vector();
  for (const auto &load : forces->loads)
  {
    load->update(state);
    load->add_force(sum);
  }
  discretization->collect(sum);
  return sum;
}

template <int dim>
double ImplicitSolver<dim>::norm_by_mass(const Vector &velocity) const
{
  double sum = 0.;
  for (unsigned int i = 0; i < mass.locally_owned_size(); ++i)
    sum += mass.local_element(i) * velocity.local_element(i) * velocity.local_element(i);
  return std::sqrt(dealii::Utilities::MPI::sum(sum, discretization->communicator()));
}

template <int dim>
std::optional<Complaint> ImplicitSolver<dim>::step(double step_length, State &state, const Report &report)
{
  before = state;
  time_step = step_length;
  contact_energy_before = contact_energy;
  load_force = compute_loads(state);
  State end = state;
  end.time += time_step;
  load_force += compute_loads(end);
  load_force *= 0.5;

  Vector driving = load_force;
  for (unsigned int i = 0; i < mass.locally_owned_size(); ++i)
    driving.local_element(i) += 2. / time_step * mass.local_element(i) * state.velocity.local_element(i);
  inertia->set_step(before.displacement, time_step);
  impulse->set(driving, before.displacement);
  forces->elasticity->set_step_start(&before.displacement);
  for (const auto &contact : forces->surface_contacts)
  {
    contact->thaw();
    contact->update(before); // a step that was given up may have left obstacles elsewhere
  }
  const bool is_solved = newton.solve(end.time, state, report) && settle_contact(state, report);
  if (is_solved)
  {
    compute_forces(state);
    compute_velocities(state);
  }
  forces->elasticity->set_step_start(nullptr);
  if (is_solved)
  {
    measure_opening(state);
    return {};
  }
  reject(state);
  return Complaint(newton.failure()).advise("shorten Implicit/Time step, or refine");
}

template <int dim>
bool ImplicitSolver<dim>::settle_contact(State &state, const Report &report)
{
  double energy = 0.;
  for (const auto &contact : forces->surface_contacts)
    energy += contact->energy();
  if (energy == 0.)
    return true;
  for (unsigned int round = 0; round < n_settling_rounds; ++round)
  {
    Vector middle = before.displacement;
    middle += state.displacement;
    middle *= 0.5;
    for (const auto &contact : forces->surface_contacts)
    {
      contact->thaw();
      contact->update(state);
      contact->freeze(middle);
    }
    for (const auto &friction : forces->frictions)
      friction->linearize(std::numeric_limits<double>::lowest(), middle);
    if (!newton.solve(state.time, state, report))
      return false;
  }
  return true;
}

template <int dim>
void ImplicitSolver<dim>::compute_forces(const State &state)
{
  inner_force = 0.;
  forces->elasticity->update(state);
  forces->elasticity->add_force(inner_force);
  discretization->collect(inner_force);
  contact_force = 0.;
  outer_contact_force = 0.;
  contact_energy = 0.;
  for (const auto &contact : forces->contacts)
  {
    Vector force = discretization->make_vector();
    contact->update(state);
    contact->add_force(force);
    contact_energy += contact->energy();
    contact_force += force;
    if (contact->is_external)
      outer_contact_force += force;
  }
  for (const auto &friction : forces->frictions)
  {
    Vector force = discretization->make_vector();
    friction->update(state.velocity);
    friction->add_force(force);
    contact_energy += friction->energy();
    contact_force += force;
    if (friction->is_external())
      outer_contact_force += force;
  }
  discretization->collect(contact_force);
  discretization->collect(outer_contact_force);
}

template <int dim>
void ImplicitSolver<dim>::compute_velocities(State &state)
{
  // By the forces, which are exactly in balance, not by the displacements, which Newton's method leaves an
  // error in.
  change = 0.;
  for (unsigned int i = 0; i < mass.locally_owned_size(); ++i)
    if (mass.local_element(i) > 0.)
      change.local_element(i) =
          time_step / mass.local_element(i) *
          (inner_force.local_element(i) + contact_force.local_element(i) + load_force.local_element(i));
  for (const unsigned int i : supports->owned_dofs())
    change.local_element(i) =
        (state.displacement.local_element(i) - before.displacement.local_element(i)) / time_step -
        before.velocity.local_element(i);
  state.velocity = before.velocity;
  state.velocity += change;
  discretization->distribute(state.velocity);
  Vector difference = change;
  if (accepted_time_step > 0.)
    difference.add(-time_step / accepted_time_step, accepted_change);
  largest_speed = std::max(largest_speed, norm_by_mass(state.velocity));
  change_of_rate = largest_speed > 0. ? norm_by_mass(difference) / largest_speed : 0.;
}

template <int dim>
void ImplicitSolver<dim>::measure_opening(const State &state)
{
  energy_opening = 0.;
  if (forces->elasticity->has_plasticity())
    return;
  Vector way = state.displacement;
  way -= before.displacement;
  forces->elasticity->update(state);
  elastic_energy = forces->elasticity->energy();
  const double stored = elastic_energy + contact_energy + 0.5 * std::pow(norm_by_mass(state.velocity), 2),
               scale = std::max(this->energy_ledger.largest, stored);
  if (scale > 0.)
    energy_opening = std::abs(elastic_energy - elastic_energy_before + inner_force * way) / scale;
}

template <int dim>
void ImplicitSolver<dim>::reject(State &state)
{
  state = before;
  contact_energy = contact_energy_before;
}

template <int dim>
void ImplicitSolver<dim>::accept(const State &state)
{
  accepted_change = change;
  accepted_time_step = time_step;
  elastic_energy_before = elastic_energy;
  Vector way = state.displacement;
  way -= before.displacement;
  Vector middle = before.displacement;
  middle.add(0.5, way);
  Vector outer_force = load_force;
  outer_force += outer_contact_force;
  this->book_impulse(sum_over_nodes(*discretization, middle, outer_force), time_step);
  EnergyLedger &energy = this->energy_ledger;
  energy.work_of_loads += load_force * way;
  energy.contact_loss -= contact_force * way + contact_energy - contact_energy_before;
  if (forces->elasticity->has_plasticity())
    energy.plastic_work += commit_yielding(state);
  if (!forces->moving_contacts.empty())
    book_obstacles(state);
  for (const auto &friction : forces->frictions)
  {
    const double rubbed_off = friction->commit();
    energy.rubbed_off += rubbed_off;
    energy.contact_loss -= rubbed_off;
  }
  if (!supports->entries().empty())
    book_supports(state);
}

template <int dim>
double ImplicitSolver<dim>::commit_yielding(const State &state)
{
  // Bodies pass through the middle of the step, where their stress acted, and yield on either half of the
  // way.
  forces->elasticity->set_step_start(&before.displacement);
  forces->elasticity->update(state);
  double work = forces->elasticity->commit();
  forces->elasticity->set_step_start(nullptr);
  forces->elasticity->update(state);
  work += forces->elasticity->commit();
  return work;
}

template <int dim>
void ImplicitSolver<dim>::book_obstacles(const State &state)
{
  const auto book = [this](double work)
  {
    this->energy_ledger.work_of_obstacles += work;
    this->energy_ledger.contact_loss += work;
  };
  for (const auto &contact : forces->moving_contacts)
  {
    const contact::ObstacleForces<dim> obstacle_forces = contact->obstacle_forces(state.velocity);
    const std::vector<SpatialVector<dim>> increments = contact->obstacle_increments();
    for (std::size_t o = 0; o < increments.size(); ++o)
      book(obstacle_forces.conservative[o].dot(increments[o]));
  }
  for (const auto &friction : forces->frictions)
    for (const auto &[pair, on_body] : friction->pair_forces().obstacles)
      book(on_body.dot(friction->obstacle_increments()[pair.second]));
}

template <int dim>
void ImplicitSolver<dim>::book_supports(const State &state)
{
  // What supported degrees of freedom changed by beyond what the other forces did came from the supports.
  double work = 0.;
  Vector impulses = discretization->make_vector();
  for (const unsigned int i : supports->owned_dofs())
  {
    const double m = mass.local_element(i), v = state.velocity.local_element(i),
                 v_before = before.velocity.local_element(i),
                 way = state.displacement.local_element(i) - before.displacement.local_element(i),
                 force = inner_force.local_element(i) + contact_force.local_element(i) +
                         load_force.local_element(i);
    work += 0.5 * m * (v * v - v_before * v_before) - force * way;
    impulses.local_element(i) = m * (v - v_before) - time_step * force;
  }
  this->energy_ledger.work_of_supports += dealii::Utilities::MPI::sum(work, discretization->communicator());
  Vector middle = before.displacement;
  middle += state.displacement;
  middle *= 0.5;
  VectorAndMoment sum = sum_over_nodes(*discretization, middle, impulses);
  // Supported nodes need not move by the mean of their velocities, which turns their momentum by itself.
  const VectorAndMoment momentum_now =
                            sum_over_nodes(*discretization, state.displacement, state.velocity, &mass),
                        momentum_before =
                            sum_over_nodes(*discretization, before.displacement, before.velocity, &mass);
  Vector velocity_change = state.velocity;
  velocity_change -= before.velocity;
  const VectorAndMoment of_change = sum_over_nodes(*discretization, middle, velocity_change, &mass);
  for (unsigned int d = 0; d < 3; ++d)
    sum.moment[d] += momentum_now.moment[d] - momentum_before.moment[d] - of_change.moment[d];
  this->book_impulse(sum);
}

template <int dim>
void ImplicitSolver<dim>::take_stock(const State &state)
{
  EnergyLedger &energy = this->energy_ledger;
  energy.kinetic = 0.5 * std::pow(norm_by_mass(state.velocity), 2);
  forces->elasticity->update(state);
  energy.elastic = forces->elasticity->energy();
  energy.contact = contact_energy;
  energy.note_scale();
  this->note_momentum(sum_over_nodes(*discretization, state.displacement, state.velocity, &mass));
}

template class ImplicitSolver<2>;
template class ImplicitSolver<3>;
} // namespace signorini
