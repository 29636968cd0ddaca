// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/solvers/implicit_contact.h"

#include "signorini/base/exceptions.h"

#include <fmt/core.h>

#include <limits>
#include <set>

namespace signorini
{
template <int dim>
ImplicitContact<dim>::ImplicitContact(const Discretization<dim> &the_discretization,
                                      const SupportedDofs<dim> &supports, const Terms &contact_terms,
                                      const Frictions &their_frictions, const Vector &mass)
    : discretization(&the_discretization), terms(&contact_terms), frictions(&their_frictions),
      inverse_mass(the_discretization.make_vector())
{
  Vector masses = mass;
  for (const unsigned int dof : supports.owned_dofs())
    masses.local_element(dof) = std::numeric_limits<double>::infinity();
  const SurfaceMap<dim> &map = contact_terms.front()->nodes();
  const std::vector<SpatialVector<dim>> nodal = map.gather(masses);
  for (unsigned int node = 0; node < map.n_own_nodes(); ++node)
    surface_masses[map.node_dofs(node)[0]] = nodal[node];
  for (unsigned int i = 0; i < masses.locally_owned_size(); ++i)
    if (masses.local_element(i) > 0.)
      inverse_mass.local_element(i) = 1. / masses.local_element(i);
  for (Vector *vector : {&elastic_force, &damping_force, &total_force, &outer_force})
    *vector = discretization->make_vector();
}

template <int dim>
void ImplicitContact<dim>::start(const State &state)
{
  stored = 0.;
  for (const auto &term : *terms)
    stored += term->energy();
  for (const auto &friction : *frictions)
  {
    friction->update(state.velocity);
    stored += friction->energy();
  }
}

template <int dim>
std::vector<SpatialVector<dim>> ImplicitContact<dim>::gather_masses(const NumberOfNode &number_of_node) const
{
  // Every node of the problem is a surface node of some rank.
  std::vector<SpatialVector<dim>> masses(number_of_node.size(), SpatialVector<dim>::Zero());
  for (const auto &[dof, number] : number_of_node)
    if (const auto known = surface_masses.find(dof); known != surface_masses.end())
      masses[number] = known->second;
  MPI_Allreduce(MPI_IN_PLACE, masses.data(), static_cast<int>(dim * masses.size()), MPI_DOUBLE, MPI_MAX,
                discretization->communicator());
  return masses;
}

template <int dim>
auto ImplicitContact<dim>::pick(const Increments &increments, const NumberOfNode &number_of_node,
                                const NodeMap<dim> &map) -> Increments
{
  Increments picked(map.n_nodes(), SpatialVector<dim>::Zero());
  if (!increments.empty())
    for (unsigned int node = 0; node < picked.size(); ++node)
      for (const auto &[master, weight] : map.masters(node))
        if (const auto number = number_of_node.find(master); number != number_of_node.end())
          picked[node] += weight * increments[number->second];
  return picked;
}

template <int dim>
auto ImplicitContact<dim>::find_increments(double least, double time_step) const -> std::vector<Increments>
{
  std::vector<SpatialVector<dim>> masses;
  contact::ContactProblem<dim> own(masses, time_step), problem(masses, time_step);
  if (frictions->empty())
    for (const auto &term : *terms)
      term->add_points(least, own);
  for (const auto &friction : *frictions)
    friction->add_points(least, own);
  // The same problem on every rank, point by point in the order of the ranks: all find the same increments.
  // Its nodes are numbered in the order of their degrees of freedom, so that it is eliminated in the same
  // order on any number of ranks.
  const auto packed_of_ranks = dealii::Utilities::MPI::all_gather(discretization->communicator(), own.pack());
  std::set<unsigned int> dofs;
  contact::ContactProblem<dim> unnumbered(masses, time_step);
  for (const std::vector<double> &packed : packed_of_ranks)
    unnumbered.add_packed(packed, [&dofs](unsigned int dof) { return *dofs.insert(dof).first; });
  NumberOfNode number_of_node;
  for (const unsigned int dof : dofs)
    number_of_node.emplace(dof, static_cast<unsigned int>(number_of_node.size()));
  for (const std::vector<double> &packed : packed_of_ranks)
    problem.add_packed(packed, [&number_of_node](unsigned int dof) { return number_of_node.at(dof); });
  masses = gather_masses(number_of_node);
  const auto increments = problem.solve();
  if (!increments)
    throw NumericalError(Complaint("the contact forces of a time step were not found")
                             .found(fmt::format("{} points near contact, {} iterations", problem.n_points(),
                                                problem.n_iterations()))
                             .advise("lower Explicit/Bulk step factor or Contact/Penalty factor, or refine"));
  std::vector<Increments> of_terms;
  for (const auto &term : *terms)
    of_terms.push_back(pick(*increments, number_of_node, term->nodes()));
  return of_terms;
}

template <int dim>
void ImplicitContact<dim>::compute_forces()
{
  Vector one = discretization->make_vector(), no_velocity = one;
  for (Vector *vector : {&elastic_force, &damping_force, &outer_force})
    *vector = 0.;
  stored = 0.;
  for (const auto &term : *terms)
  {
    stored += term->energy();
    one = 0.;
    term->add_force(one);
    elastic_force += one;
    if (term->is_external)
      outer_force += one;
    one = 0.;
    term->add_damping_force(no_velocity, one);
    damping_force += one;
    if (term->is_external)
      outer_force += one;
  }
  for (const auto &friction : *frictions)
  {
    stored += friction->energy();
    one = 0.;
    friction->add_force(one);
    elastic_force += one;
    if (friction->is_external())
      outer_force += one;
  }
  for (Vector *vector : {&elastic_force, &damping_force, &outer_force})
    discretization->collect(*vector);
  total_force = elastic_force;
  total_force += damping_force;
}

template <int dim>
auto ImplicitContact<dim>::move(const Vector &start, double time_step, const Vector &other_force,
                                State &state) -> Booking
{
  double reach = 2. * time_step * state.velocity.linfty_norm();
  for (const auto &term : *terms)
  {
    term->renew(state);
    term->update(state);
    term->find_entries(start);
    term->linearize(start);
    for (const SpatialVector<dim> &moved : term->obstacle_increments())
      reach += 2. * moved.norm();
  }
  for (const auto &friction : *frictions)
    friction->linearize(-reach, start);
  const std::vector<Increments> increments = find_increments(-reach, time_step);
  for (std::size_t i = 0; i < terms->size(); ++i)
    (*terms)[i]->follow(increments[i], time_step);
  for (const auto &friction : *frictions)
    friction->follow();
  const double stored_before = stored;
  compute_forces();

  Booking booking;
  double gain = 0.; // of kinetic energy and of the other forces' work, see doc/theory.md
  for (unsigned int i = 0; i < inverse_mass.locally_owned_size(); ++i)
  {
    const double change = time_step * inverse_mass.local_element(i) * total_force.local_element(i);
    gain += 0.5 * time_step * change * (total_force.local_element(i) + other_force.local_element(i));
    state.velocity.local_element(i) += change;
    state.displacement.local_element(i) += time_step * change;
  }
  discretization->distribute(state.velocity);
  discretization->distribute(state.displacement);
  Vector way = state.displacement;
  way -= start;
  booking.dissipated = -(damping_force * way);
  booking.loss = dealii::Utilities::MPI::sum(gain, discretization->communicator()) - elastic_force * way -
                 (stored - stored_before);
  book_obstacles(state, booking);
  for (const auto &friction : *frictions)
    booking.rubbed_off += friction->commit();
  booking.loss -= booking.rubbed_off;
  booking.outer_impulse = sum_over_nodes(*discretization, start, outer_force);
  for (unsigned int d = 0; d < 3; ++d)
  {
    booking.outer_impulse.vector[d] *= time_step;
    booking.outer_impulse.moment[d] *= time_step;
  }
  return booking;
}

template <int dim>
void ImplicitContact<dim>::book_obstacles(const State &state, Booking &booking) const
{
  const auto book = [&booking](double work)
  {
    booking.work_of_obstacles += work;
    booking.loss += work;
  };
  for (const auto &term : *terms)
  {
    const contact::ObstacleForces<dim> obstacle_forces = term->obstacle_forces(state.velocity);
    const std::vector<SpatialVector<dim>> moved = term->obstacle_increments();
    for (std::size_t o = 0; o < moved.size(); ++o)
    {
      const double dissipation = obstacle_forces.damping[o].dot(moved[o]);
      booking.work_of_obstacles += dissipation;
      booking.dissipated += dissipation;
      book(obstacle_forces.conservative[o].dot(moved[o]));
    }
  }
  for (const auto &friction : *frictions)
    for (const auto &[pair, on_body] : friction->pair_forces().obstacles)
      book(on_body.dot(friction->obstacle_increments()[pair.second]));
}

template class ImplicitContact<2>;
template class ImplicitContact<3>;
} // namespace signorini
