// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/solvers/explicit_solver.h"

#include "signorini/physics/mass.h"

#include <algorithm>
#include <cmath>

namespace signorini
{
template <int dim>
ExplicitSolver<dim>::ExplicitSolver(const Discretization<dim> &the_discretization,
                                    const SupportedDofs<dim> &supported_dofs,
                                    const std::vector<MaterialParameters> &the_materials,
                                    SceneForces<dim> &the_forces,
                                    const ExplicitParameters &explicit_parameters, RunTime &the_run_time)
    : discretization(&the_discretization), supports(&supported_dofs), materials(&the_materials),
      forces(&the_forces), parameters(explicit_parameters), run_time(&the_run_time),
      mass(make_lumped_mass(the_materials, the_discretization)), inverse_mass(mass),
      bulk_bound(*the_forces.elasticity, the_forces.viscosities, the_materials, the_discretization)
{
  for (unsigned int i = 0; i < mass.locally_owned_size(); ++i)
    inverse_mass.local_element(i) = mass.local_element(i) > 0. ? 1. / mass.local_element(i) : 0.;
  for (Vector *vector : {&force, &load_force, &damping_force, &viscous_force, &external_force, &old_force,
                         &old_load_force, &old_damping_force, &old_viscous_force})
    *vector = discretization->make_vector();
  std::vector<bool> is_supported(mass.locally_owned_size(), false);
  for (const unsigned int dof : supports->owned_dofs())
    is_supported[dof] = true;
  for (const OwnedNode<dim> &node : discretization->owned_nodes)
    if (std::any_of(node.dofs.begin(), node.dofs.end(), [&](unsigned int dof) { return is_supported[dof]; }))
      dofs_of_supported_nodes.insert(dofs_of_supported_nodes.end(), node.dofs.begin(), node.dofs.end());
  if (parameters.contact_stepping == ExplicitParameters::ContactStepping::implicit_forces &&
      !forces->surface_contacts.empty())
    implicit_contact = std::make_unique<ImplicitContact<dim>>(
        *discretization, *supports, forces->surface_contacts, forces->frictions, mass);
  half_step_of_contact = discretization->make_vector();
  has_external_forces = !forces->loads.empty();
  for (const auto &contact : forces->contacts)
    has_external_forces |= contact->is_external && !implicit_contact;
  has_work = !forces->loads.empty() || !forces->damped_contacts.empty() || !forces->viscosities.empty() ||
             !supports->entries().empty() || implicit_contact;
}

template <int dim>
void ExplicitSolver<dim>::begin(State &state)
{
  supports->impose(state.time, state.displacement);
  discretization->distribute(state.displacement);
  discretization->distribute(state.velocity);
  for (const auto &contact : forces->contacts)
  {
    contact->renew(state);
    contact->update(state);
  }
  if (implicit_contact)
    implicit_contact->start(state);
  compute_forces(state, state.velocity);
  for (const auto &friction : forces->frictions)
    friction->commit();
  bulk_bound.update(state);
  take_stock(state);
}

template <int dim>
void ExplicitSolver<dim>::start(State &state)
{
  begin(state);
  this->open_ledgers();
}

template <int dim>
void ExplicitSolver<dim>::resume(const ExplicitSolver &before, const VectorAndMoment &momentum_change,
                                 State &state)
{
  energy_ledger = before.energy_ledger;
  this->momentum_ledger = before.momentum_ledger;
  this->book_impulse(momentum_change);
  last_time_step = before.last_time_step;
  begin(state);
  energy_ledger.book_adaptation(before.energy_ledger.stored());
}

template <int dim>
double ExplicitSolver<dim>::stable_step() const
{
  const double bulk = parameters.bulk_step_factor *
                      critical_time_step(bulk_bound.frequency_squared(), bulk_bound.damping_rate());
  if (implicit_contact)
    return bulk;
  unsigned int n_searches = 0;
  for (const auto &contact : forces->contacts)
    n_searches += contact->n_searches();
  if (n_searches != n_searches_of_bound)
  {
    std::vector<const ContactTerm<dim> *> contacts;
    for (const auto &contact : forces->contacts)
      contacts.push_back(contact.get());
    contact_bound = compute_contact_bound(contacts, mass, *discretization);
    n_searches_of_bound = n_searches;
  }
  if (contact_bound.frequency_squared == 0.)
    return bulk;
  const double with_contact =
      critical_time_step(bulk_bound.frequency_squared() + contact_bound.frequency_squared,
                         bulk_bound.damping_rate() + contact_bound.damping_rate);
  return std::min(bulk, parameters.contact_step_factor * with_contact);
}

template <int dim>
void ExplicitSolver<dim>::compute_forces(const State &state, const Vector &velocity)
{
  force = 0.;
  if (has_external_forces)
    external_force = 0.;
  {
    const auto section = run_time->enter("elasticity");
    forces->elasticity->update(state);
    forces->elasticity->add_force(force);
  }
  compute_contact_forces(state, velocity);
  compute_load_forces(state);
  discretization->collect(force);
  compute_viscous_forces(state, velocity);
  if (!has_external_forces)
    return;
  discretization->collect(external_force);
  force += external_force;
  external = sum_over_nodes(*discretization, state.displacement, external_force);
}

template <int dim>
void ExplicitSolver<dim>::compute_viscous_forces(const State &state, const Vector &velocity)
{
  for (const auto &viscosity : forces->viscosities)
  {
    const auto section = run_time->enter("viscosity");
    viscous_force = 0.;
    viscosity->add_force(state, velocity, viscous_force);
    discretization->collect(viscous_force);
    force += viscous_force;
  }
}

template <int dim>
void ExplicitSolver<dim>::compute_load_forces(const State &state)
{
  if (forces->loads.empty())
    return;
  load_force = 0.;
  for (const auto &load : forces->loads)
  {
    load->update(state);
    load->add_force(load_force);
  }
  external_force += load_force;
}

template <int dim>
void ExplicitSolver<dim>::step(double time_step, State &state)
{
  suspend(state);
  if (implicit_contact && time_step != last_time_step)
    energy_ledger.contact_loss +=
        compute_energy_between_steps(time_step) - compute_energy_between_steps(last_time_step);
  old_force.swap(force);
  old_load_force.swap(load_force);
  old_damping_force.swap(damping_force);
  old_viscous_force.swap(viscous_force);
  std::swap(old_external, external);
  old_obstacle_forces.swap(obstacle_forces);
  if (has_work)
  {
    old_displacement = state.displacement;
    old_velocity = state.velocity;
  }
  kick(time_step, old_force, state.velocity);
  state.displacement.add(time_step, state.velocity);
  state.time += time_step;
  supports->impose(state.time, state.displacement);
  for (const unsigned int dof : supports->owned_dofs())
    state.velocity.local_element(dof) =
        (state.displacement.local_element(dof) - old_displacement.local_element(dof)) / time_step;
  discretization->distribute(state.displacement);
  discretization->distribute(state.velocity);

  if (implicit_contact)
    move_by_contact(time_step, state);
  else
    for (const auto &contact : forces->contacts)
    {
      const auto section = run_time->enter("contact search");
      energy_ledger.contact_renewals += contact->renew(state);
    }
  compute_forces(state, state.velocity);
  half_velocity_of_supports.resize(supports->owned_dofs().size());
  for (unsigned int i = 0; i < half_velocity_of_supports.size(); ++i)
    half_velocity_of_supports[i] = state.velocity.local_element(supports->owned_dofs()[i]);
  kick(time_step, force, state.velocity);
  for (unsigned int i = 0; i < half_velocity_of_supports.size(); ++i)
    state.velocity.local_element(supports->owned_dofs()[i]) = half_velocity_of_supports[i];
  discretization->distribute(state.velocity);
  last_time_step = time_step;
  book_step(state, time_step);
  if (implicit_contact)
    add_half_step_of_contact(state);
  constexpr unsigned int n_steps_between_looks = 10;
  if (++n_steps % n_steps_between_looks == 0)
    bulk_bound.update_strained(state);
}

template <int dim>
void ExplicitSolver<dim>::kick(double time_step, const Vector &by, Vector &velocity) const
{
  const double half_step = 0.5 * time_step, *factor = inverse_mass.begin(), *acting = by.begin();
  double *changed = velocity.begin();
  for (unsigned int i = 0; i < mass.locally_owned_size(); ++i)
    changed[i] += half_step * factor[i] * acting[i];
}

template <int dim>
void ExplicitSolver<dim>::book_step(const State &state, double time_step)
{
  if (has_work)
  {
    increment = state.displacement;
    increment -= old_displacement;
  }
  if (!forces->loads.empty())
    energy_ledger.work_of_loads += 0.5 * (old_load_force * increment + load_force * increment);
  if (!forces->damped_contacts.empty())
    energy_ledger.dissipated -= 0.5 * (old_damping_force * increment + damping_force * increment);
  if (!implicit_contact)
    for (const auto &friction : forces->frictions)
      energy_ledger.rubbed_off += friction->commit();
  {
    const auto section = run_time->enter("elasticity");
    energy_ledger.plastic_work += forces->elasticity->commit();
  }
  if (!forces->viscosities.empty())
    energy_ledger.dissipated_by_viscosity -=
        0.5 * (old_viscous_force * increment + viscous_force * increment);
  if (has_external_forces)
  {
    // In one sum: after a million steps it shows.
    VectorAndMoment both = old_external;
    for (unsigned int d = 0; d < 3; ++d)
    {
      both.vector[d] += external.vector[d];
      both.moment[d] += external.moment[d];
    }
    this->book_impulse(both, 0.5 * time_step);
  }
  if (!supports->entries().empty())
    book_supports(state, time_step);
  book_obstacles();
}

template <int dim>
void ExplicitSolver<dim>::book_supports(const State &state, double time_step)
{
  // What the momentum and kinetic energy of supported nodes changed by beyond the other forces' share came
  // from the supports. Implicit contact pushes for the whole step, from its start.
  Vector contact_force = discretization->make_vector();
  if (implicit_contact)
    contact_force = implicit_contact->force();
  double work = 0.;
  Vector impulse = discretization->make_vector(), other_impulse = discretization->make_vector();
  for (const unsigned int i : supports->owned_dofs())
  {
    const double m = mass.local_element(i), v = state.velocity.local_element(i),
                 v_old = old_velocity.local_element(i);
    work += 0.5 * m * (v * v - v_old * v_old) -
            (0.5 * (old_force.local_element(i) + force.local_element(i)) + contact_force.local_element(i)) *
                increment.local_element(i);
  }
  // A support that moves its node along turns the momentum of the node's free components with it.
  for (const unsigned int i : dofs_of_supported_nodes)
  {
    const double m = mass.local_element(i), v = state.velocity.local_element(i),
                 v_old = old_velocity.local_element(i);
    impulse.local_element(i) = m * v - 0.5 * time_step * force.local_element(i);
    other_impulse.local_element(i) =
        -m * v_old - time_step * (0.5 * old_force.local_element(i) + contact_force.local_element(i));
  }
  energy_ledger.work_of_supports += dealii::Utilities::MPI::sum(work, discretization->communicator());
  this->book_impulse(sum_over_nodes(*discretization, state.displacement, impulse));
  this->book_impulse(sum_over_nodes(*discretization, old_displacement, other_impulse));
}

template <int dim>
double ExplicitSolver<dim>::compute_energy_between_steps(double time_step) const
{
  Vector free_force = force;
  supports->clear(free_force);
  double sum = 0.;
  for (unsigned int i = 0; i < mass.locally_owned_size(); ++i)
    if (mass.local_element(i) > 0.)
      sum += std::pow(time_step * free_force.local_element(i), 2) / (8. * mass.local_element(i));
  return dealii::Utilities::MPI::sum(sum, discretization->communicator());
}

template <int dim>
void ExplicitSolver<dim>::take_stock(const State &state)
{
  // The velocities between the steps, without what add_half_step_of_contact() put there.
  Vector velocity = state.velocity;
  velocity -= half_step_of_contact;
  double twice_kinetic = 0.;
  for (unsigned int i = 0; i < mass.locally_owned_size(); ++i)
    twice_kinetic += mass.local_element(i) * velocity.local_element(i) * velocity.local_element(i);
  energy_ledger.kinetic = 0.5 * dealii::Utilities::MPI::sum(twice_kinetic, discretization->communicator());
  if (implicit_contact)
    energy_ledger.kinetic -= compute_energy_between_steps(last_time_step);
  energy_ledger.elastic = forces->elasticity->energy();
  energy_ledger.contact = 0.;
  for (const auto &contact : forces->contacts)
    energy_ledger.contact += contact->energy();
  for (const auto &friction : forces->frictions)
    energy_ledger.contact += friction->energy();
  energy_ledger.note_scale();

  this->note_momentum(sum_over_nodes(*discretization, state.displacement, velocity, &mass));
}

template class ExplicitSolver<2>;
template class ExplicitSolver<3>;
} // namespace signorini
