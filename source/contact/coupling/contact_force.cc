// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/coupling/contact_force.h"

#include "signorini/contact/coupling/facet_exchange.h"
#include "signorini/contact/potential/unseen_contact.h"

#include <deal.II/base/mpi.h>

#include <limits>

namespace signorini
{
namespace
{
/// The obstacles as seen from `origin`.
template <int dim>
typename contact::ContactPotential<dim>::Obstacles
move_to(const SpatialVector<dim> &origin, const typename contact::ContactPotential<dim>::Obstacles &obstacles)
{
  typename contact::ContactPotential<dim>::Obstacles moved;
  for (const auto &obstacle : obstacles)
    moved.push_back(obstacle->moved(-origin));
  return moved;
}

} // namespace

template <int dim>
ContactForce<dim>::ContactForce(const std::string &term_name, bool is_an_external_term,
                                const SurfaceMap<dim> &surface_map,
                                const typename contact::ContactPotential<dim>::Obstacles &obstacles,
                                const contact::PotentialSettings &settings, const MPI_Comm &mpi_communicator)
    : ContactTerm<dim>(term_name, is_an_external_term, mpi_communicator), map(surface_map),
      potential(map.surface(), move_to<dim>(map.surface().origin, obstacles), settings)
{
}

template <int dim>
void ContactForce<dim>::move_obstacles(double time)
{
  if (motions.empty())
    return;
  contact::ObstaclePlaces<dim> places;
  places.time = time;
  for (const ObstacleMotion<dim> &motion : motions)
  {
    places.shifts.push_back(motion.displacement(time));
    places.velocities.push_back(motion.velocity(time));
  }
  potential.move_obstacles(places);
}

template <int dim>
double ContactForce<dim>::renew(const State &state)
{
  if (is_frozen)
    return 0.;
  move_obstacles(state.time);
  const std::vector<SpatialVector<dim>> x = map.positions(state.displacement);
  const double jump = is_any(potential.is_stale(x)) ? search(state, x) : potential.update(x);
  return dealii::Utilities::MPI::sum(jump, this->communicator);
}

template <int dim>
bool ContactForce<dim>::is_any(bool is_here) const
{
  return dealii::Utilities::MPI::max(static_cast<int>(is_here), this->communicator) == 1;
}

template <int dim>
double ContactForce<dim>::search(const State &state, const std::vector<SpatialVector<dim>> &positions)
{
  return potential.search(positions,
                          [&]()
                          {
                            take_facets(positions);
                            return map.positions(state.displacement);
                          });
}

template <int dim>
void ContactForce<dim>::take_facets(const std::vector<SpatialVector<dim>> &positions)
{
  const contact::PairList<dim> &pairs = potential.pair_list();
  if (dealii::Utilities::MPI::n_mpi_processes(this->communicator) == 1 || !pairs.may_bodies_touch())
    return;
  const std::vector<contact::BoundingBox<dim>> boxes = make_own_boxes(map, positions);
  std::vector<contact::FacetQuery<dim>> queries;
  for (unsigned int f = 0; f < boxes.size(); ++f)
  {
    const SpatialVector<dim> margin = SpatialVector<dim>::Constant(pairs.search_distance(f));
    queries.push_back({{boxes[f].min() - margin, boxes[f].max() + margin}, map.surface().facets[f].body});
  }
  hold_facets<dim>(queries, boxes, pairs.allowed_pairs(), this->communicator, map);
}

template <int dim>
void ContactForce<dim>::update(const State &state)
{
  if (is_frozen)
  {
    std::vector<SpatialVector<dim>> x = map.positions(state.displacement);
    for (unsigned int node = 0; node < x.size(); ++node)
      x[node] -= potential.positions()[node];
    potential.follow(x, std::numeric_limits<double>::infinity()); // without damping
    return;
  }
  move_obstacles(state.time);
  const std::vector<SpatialVector<dim>> x = map.positions(state.displacement);
  if (is_any(potential.is_stale(x)))
    search(state, x);
  else
    potential.evaluate(x);
}

template <int dim>
double ContactForce<dim>::energy() const
{
  return dealii::Utilities::MPI::sum(potential.energy(), this->communicator);
}

template <int dim>
void ContactForce<dim>::add_force(Vector &force) const
{
  std::vector<SpatialVector<dim>> nodal(map.surface().n_nodes(), SpatialVector<dim>::Zero());
  potential.add_forces(nodal);
  map.add_to_owners(nodal, force);
}

template <int dim>
double ContactForce<dim>::add_damping_force(const Vector &velocity, Vector &force) const
{
  std::vector<SpatialVector<dim>> nodal(map.surface().n_nodes(), SpatialVector<dim>::Zero());
  const double power = potential.add_damping_forces(map.gather(velocity), nodal);
  map.add_to_owners(nodal, force);
  return dealii::Utilities::MPI::sum(power, this->communicator);
}

template <int dim>
void ContactForce<dim>::add_all_forces(const Vector &velocity, Vector &force, Vector &damping_force) const
{
  std::vector<SpatialVector<dim>> nodal(map.surface().n_nodes(), SpatialVector<dim>::Zero()), damping = nodal;
  potential.add_all_forces(map.gather(velocity), nodal, damping);
  map.add_to_owners(damping, damping_force);
  for (std::size_t node = 0; node < nodal.size(); ++node)
    nodal[node] += damping[node];
  map.add_to_owners(nodal, force);
}

template <int dim>
void ContactForce<dim>::freeze(const Vector &start)
{
  linearize(start);
  is_frozen = true;
}

template <int dim>
void ContactForce<dim>::add_points(double least, contact::ContactProblem<dim> &problem) const
{
  potential.for_each_linear_point(least, [&](const auto &point) { add_point(point, problem); });
}

template <int dim>
void ContactForce<dim>::add_point(const contact::LinearPoint<dim> &point,
                                  contact::ContactProblem<dim> &problem) const
{
  typename contact::ContactProblem<dim>::Weights weights;
  for (unsigned int a = 0; a < point.stencil.n_nodes; ++a)
    for (const auto &[node, share] : map.masters(point.stencil.node[a]))
      weights.push_back(
          {static_cast<unsigned int>(node), share * point.stencil.weight[a], share * point.slip.levers[a]});
  problem.add(point, weights);
}

template <int dim>
contact::ObstacleForces<dim> ContactForce<dim>::obstacle_forces(const Vector &velocity) const
{
  contact::ObstacleForces<dim> forces = potential.obstacle_forces(map.gather(velocity));
  for (auto *const list : {&forces.conservative, &forces.damping})
    MPI_Allreduce(MPI_IN_PLACE, list->data(), static_cast<int>(dim * list->size()), MPI_DOUBLE, MPI_SUM,
                  this->communicator);
  return forces;
}

template <int dim>
std::vector<SpatialVector<dim>> ContactForce<dim>::obstacle_increments() const
{
  std::vector<SpatialVector<dim>> increments = potential.obstacle_places().shifts;
  for (std::size_t i = 0; i < increments.size(); ++i)
    increments[i] -= potential.obstacle_places_before().shifts[i];
  return increments;
}

template <int dim>
void ContactForce<dim>::add_couplings(const dealii::AffineConstraints<double> &constraints,
                                      dealii::TrilinosWrappers::SparsityPattern &pattern) const
{
  potential.for_each_coupling(
      [&](const std::vector<unsigned int> &nodes)
      { constraints.add_entries_local_to_global(map.collect_dofs(nodes), pattern, false); });
}

template <int dim>
void ContactForce<dim>::add_tangent(TangentSystem &system) const
{
  potential.for_each_tangent([&](const std::vector<unsigned int> &nodes, const Eigen::MatrixXd &block)
                             { this->add_block(nodes, block, system); },
                             system.contact_tangent == ContactTangent::convex);
}

template <int dim>
void ContactForce<dim>::add_row_sum_bounds(Vector &stiffness, Vector &damping) const
{
  const unsigned int n_nodes = map.surface().n_nodes();
  std::vector<double> nodal_stiffness(n_nodes, 0.), nodal_damping(n_nodes, 0.);
  potential.add_row_sum_bounds(nodal_stiffness, nodal_damping);
  this->spread(nodal_stiffness, stiffness);
  this->spread(nodal_damping, damping);
}

template <int dim>
std::vector<unsigned int> ContactForce<dim>::unseen_contact(const State &state, double unheeded_depth) const
{
  const ContactSurface<dim> &surface = map.surface();
  const std::vector<bool> is_active = potential.active_facets();
  // At nodes of facets in contact any depth is known, elsewhere that to which contact goes anyway: with a
  // stiff penalty a corner at the rim may lie in the other side a little while no point does.
  std::vector<double> known_depth(surface.n_nodes(), std::max(measure().max_penetration, unheeded_depth));
  for (unsigned int f = 0; f < surface.facets.size(); ++f)
    for (unsigned int i = 0; i < surface.facets[f].n_nodes(); ++i)
      if (is_active[f])
        known_depth[surface.facets[f].nodes[i]] = std::numeric_limits<double>::max();
  map.maximize(known_depth);
  return contact::find_unseen_contact(surface, potential.pair_list(), map.positions(state.displacement),
                                      known_depth);
}

template <int dim>
std::vector<unsigned int> ContactForce<dim>::n_pairs_of_facets() const
{
  std::vector<unsigned int> n_pairs(map.surface().facets.size(), 0);
  for (const auto *pairs : {&potential.pair_list().body_pairs(), &potential.pair_list().obstacle_pairs()})
    for (const auto &pair : *pairs)
      ++n_pairs[pair.facet];
  return n_pairs;
}

template <int dim>
std::vector<contact::ContactSample<dim>> ContactForce<dim>::samples() const
{
  std::vector<contact::ContactSample<dim>> samples = potential.samples();
  for (contact::ContactSample<dim> &sample : samples)
    sample.position += map.surface().origin;
  return samples;
}

template <int dim>
contact::ContactMeasures<dim> ContactForce<dim>::measure() const
{
  return this->sum(potential.measure(), map.surface().origin);
}

template <int dim>
contact::PairForces<dim> ContactForce<dim>::pair_forces(const State &state) const
{
  using Velocities = std::vector<SpatialVector<dim>>;
  return this->sum(
      potential.pair_forces(state.velocity.size() > 0 ? map.gather(state.velocity) : Velocities()));
}

template class ContactForce<2>;
template class ContactForce<3>;
} // namespace signorini
