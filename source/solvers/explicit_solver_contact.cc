// SPDX-License-Identifier: LGPL-2.1-or-later
// The contact forces of an ExplicitSolver, those of implicit contact among them.
#include "signorini/solvers/explicit_solver.h"

namespace signorini
{
template <int dim>
void ExplicitSolver<dim>::compute_contact_forces(const State &state, const Vector &velocity)
{
  if (forces->contacts.empty() || implicit_contact)
    return;
  const auto section = run_time->enter("contact");
  for (const auto &contact : forces->contacts)
    contact->update(state);
  const auto force_on_bodies = [this](const ContactTerm<dim> &contact) -> Vector &
  { return contact.is_external ? external_force : force; };
  if (forces->damped_contacts.empty())
    for (const auto &contact : forces->contacts)
      contact->add_force(force_on_bodies(*contact));
  else
  {
    damping_force = 0.;
    for (const auto &contact : forces->volume_contacts)
      contact->add_force(force_on_bodies(*contact));
    for (const auto &contact : forces->damped_contacts)
      contact->add_all_forces(velocity, force_on_bodies(*contact), damping_force);
    discretization->collect(damping_force);
  }
  for (const auto &friction : forces->frictions)
  {
    friction->update(velocity);
    friction->add_force(friction->is_external() ? external_force : force);
  }
  obstacle_forces.clear();
  for (const auto &contact : forces->moving_contacts)
  {
    obstacle_forces.push_back(contact->obstacle_forces(velocity));
    for (const auto &friction : forces->frictions)
      if (friction->is_external())
        for (const auto &[pair, on_body] : friction->pair_forces().obstacles)
          obstacle_forces.back().conservative[pair.second] += on_body;
  }
}

template <int dim>
void ExplicitSolver<dim>::move_by_contact(double time_step, State &state)
{
  const auto section = run_time->enter("contact");
  const auto booking = implicit_contact->move(old_displacement, time_step, old_force, state);
  energy_ledger.contact_loss += booking.loss;
  energy_ledger.dissipated += booking.dissipated;
  energy_ledger.rubbed_off += booking.rubbed_off;
  energy_ledger.work_of_obstacles += booking.work_of_obstacles;
  this->book_impulse(booking.outer_impulse);
}

template <int dim>
void ExplicitSolver<dim>::add_half_step_of_contact(State &state)
{
  for (unsigned int i = 0; i < mass.locally_owned_size(); ++i)
    half_step_of_contact.local_element(i) =
        mass.local_element(i) > 0.
            ? 0.5 * last_time_step / mass.local_element(i) * implicit_contact->force().local_element(i)
            : 0.;
  supports->clear(half_step_of_contact);
  state.velocity += half_step_of_contact;
  discretization->distribute(state.velocity);
}

template <int dim>
void ExplicitSolver<dim>::suspend(State &state)
{
  if (!implicit_contact)
    return;
  state.velocity -= half_step_of_contact;
  half_step_of_contact = 0.;
  discretization->distribute(state.velocity);
}

template <int dim>
void ExplicitSolver<dim>::book_obstacles()
{
  for (std::size_t i = 0; i < obstacle_forces.size(); ++i)
  {
    const contact::ObstacleForces<dim> &now = obstacle_forces[i], &before = old_obstacle_forces[i];
    const std::vector<SpatialVector<dim>> increments = forces->moving_contacts[i]->obstacle_increments();
    for (std::size_t o = 0; o < increments.size(); ++o)
    {
      const double dissipation = 0.5 * (before.damping[o] + now.damping[o]).dot(increments[o]);
      // The damping takes from the bodies less than their own way through its forces, or more.
      energy_ledger.dissipated += dissipation;
      energy_ledger.work_of_obstacles +=
          dissipation + 0.5 * (before.conservative[o] + now.conservative[o]).dot(increments[o]);
    }
  }
}

template class ExplicitSolver<2>;
template class ExplicitSolver<3>;
} // namespace signorini
