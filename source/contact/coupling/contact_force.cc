// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/coupling/contact_force.h"

#include "signorini/contact/potential/unseen_contact.h"

#include <deal.II/base/mpi.h>

#include <Eigen/Cholesky>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

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

template <int dim>
double undeformed_area(const Facet<dim> &facet, const ContactSurface<dim> &surface)
{
  const auto nodes = contact::gather_nodes(facet, surface.reference_positions);
  double area = 0.;
  for (const auto &point : contact::make_gauss_points<dim>(facet.type, 3))
    area += point.weight * contact::evaluate_facet_frame(nodes, point.xi).area_normal.norm();
  return area;
}

/// One number for each corner of a facet.
template <int dim>
using Corners = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 1 << (dim - 1), 1>;

/// The (bi)linear functions of a facet, each 1 at one of its corners.
template <int dim>
Corners<dim> corner_functions(const FacetType type, const LocalPoint<dim> &xi)
{
  FacetElement<dim> element;
  element.type = type;
  const auto shape = contact::evaluate_facet_shape(element, xi);
  return Eigen::Map<const Corners<dim>>(shape.value.data(), shape.n_nodes);
}

/// The coefficients of these functions in the L2 projection of a function whose integrals with them are
/// `moments`, over a facet of the given area.
template <int dim>
Corners<dim> project_on_corners(const FacetType type, const Corners<dim> &moments, const double area)
{
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(moments.size(), moments.size());
  double measure = 0.;
  for (const auto &point : contact::make_gauss_points<dim>(type, 2))
  {
    const Corners<dim> corners = corner_functions<dim>(type, point.xi);
    mass += point.weight * corners * corners.transpose();
    measure += point.weight;
  }
  return mass.llt().solve(moments) * measure / area;
}

/// The middle nodes of the sides of quadratic triangles, with the ends of the sides.
template <int dim>
std::map<unsigned int, std::array<unsigned int, 2>> find_triangle_middles(const ContactSurface<dim> &surface)
{
  std::map<unsigned int, std::array<unsigned int, 2>> middles;
  for (const Facet<dim> &facet : surface.facets)
    for (unsigned int side = 0; side < 3 && facet.type == FacetType::triangle && facet.degree == 2; ++side)
      middles[facet.nodes[3 + side]] = {facet.nodes[side], facet.nodes[(side + 1) % 3]};
  return middles;
}
} // namespace

template <int dim>
ContactForce<dim>::ContactForce(const std::string &term_name, bool is_an_external_term,
                                const SurfaceMap<dim> &surface_map,
                                const typename contact::ContactPotential<dim>::Obstacles &obstacles,
                                const contact::PotentialSettings &settings, const MPI_Comm &mpi_communicator)
    : ContactTerm<dim>(term_name, is_an_external_term, mpi_communicator), map(&surface_map),
      potential(surface_map.surface(), move_to<dim>(surface_map.surface().origin, obstacles), settings)
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
  return dealii::Utilities::MPI::sum(potential.update(map->positions(state.displacement)),
                                     this->communicator);
}

template <int dim>
void ContactForce<dim>::update(const State &state)
{
  if (is_frozen)
  {
    std::vector<SpatialVector<dim>> x = map->positions(state.displacement);
    for (unsigned int node = 0; node < x.size(); ++node)
      x[node] -= potential.positions()[node];
    potential.follow(x, std::numeric_limits<double>::infinity()); // without damping
    return;
  }
  move_obstacles(state.time);
  const std::vector<SpatialVector<dim>> x = map->positions(state.displacement);
  if (potential.is_stale(x))
    potential.update(x);
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
  std::vector<SpatialVector<dim>> nodal(map->surface().n_nodes(), SpatialVector<dim>::Zero());
  potential.add_forces(nodal);
  map->add_to_owners(nodal, force);
}

template <int dim>
double ContactForce<dim>::add_damping_force(const Vector &velocity, Vector &force) const
{
  std::vector<SpatialVector<dim>> nodal(map->surface().n_nodes(), SpatialVector<dim>::Zero());
  const double power = potential.add_damping_forces(map->gather(velocity), nodal);
  map->add_to_owners(nodal, force);
  return dealii::Utilities::MPI::sum(power, this->communicator);
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
    for (const auto &[node, share] : map->masters(point.stencil.node[a]))
      weights.push_back({node, share * point.stencil.weight[a], share * point.slip.levers[a]});
  problem.add(point, weights);
}

template <int dim>
contact::ObstacleForces<dim> ContactForce<dim>::obstacle_forces(const Vector &velocity) const
{
  contact::ObstacleForces<dim> forces = potential.obstacle_forces(map->gather(velocity));
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
      { constraints.add_entries_local_to_global(map->collect_dofs(nodes), pattern, false); });
}

template <int dim>
void ContactForce<dim>::add_tangent(TangentSystem &system) const
{
  potential.for_each_tangent([&](const std::vector<unsigned int> &nodes, const Eigen::MatrixXd &block)
                             { this->add_block(nodes, block, system); });
}

template <int dim>
std::vector<SpatialVector<dim>> ContactForce<dim>::nodal_forces() const
{
  std::vector<SpatialVector<dim>> forces(map->surface().n_nodes(), SpatialVector<dim>::Zero());
  potential.add_forces(forces);
  MPI_Allreduce(MPI_IN_PLACE, forces.data(), static_cast<int>(dim * forces.size()), MPI_DOUBLE, MPI_SUM,
                this->communicator);
  return forces;
}

template <int dim>
std::vector<double> ContactForce<dim>::nodal_areas() const
{
  // A point counts once however many surfaces it is near.
  std::set<std::pair<unsigned int, std::array<double, dim - 1>>> known;
  std::vector<double> areas(map->surface().n_nodes(), 0.);
  for (const contact::ContactSample<dim> &sample : potential.samples())
  {
    std::array<double, dim - 1> xi;
    std::copy(sample.xi.begin(), sample.xi.end(), xi.begin());
    if (!known.emplace(sample.facet, xi).second)
      continue;
    const Facet<dim> &facet = map->surface().facets[sample.facet];
    const auto shape = contact::evaluate_facet_shape(facet, sample.xi);
    for (unsigned int i = 0; i < facet.n_nodes(); ++i)
      areas[facet.nodes[i]] += shape.value[i] * sample.full_area;
  }
  MPI_Allreduce(MPI_IN_PLACE, areas.data(), static_cast<int>(areas.size()), MPI_DOUBLE, MPI_SUM,
                this->communicator);
  return areas;
}

template <int dim>
std::vector<std::optional<double>> ContactForce<dim>::nodal_pressures() const
{
  const ContactSurface<dim> &surface = map->surface();
  std::vector<SpatialVector<dim>> forces = nodal_forces();
  std::vector<double> areas = nodal_areas();
  const auto middles = find_triangle_middles(surface);
  for (const auto &[middle, ends] : middles)
    for (const unsigned int end : ends)
    {
      forces[end] += 0.5 * forces[middle];
      areas[end] += 0.5 * areas[middle];
    }
  const double largest_area = areas.empty() ? 0. : *std::max_element(areas.begin(), areas.end());
  std::vector<std::optional<double>> pressures(surface.n_nodes());
  for (unsigned int node = 0; node < surface.n_nodes(); ++node)
    if (areas[node] > 1e-9 * largest_area)
      pressures[node] = forces[node].norm() / areas[node];
  for (const auto &[middle, ends] : middles)
    if (pressures[middle])
      pressures[middle] = 0.5 * (*pressures[ends[0]] + *pressures[ends[1]]);
  return pressures;
}

template <int dim>
void ContactForce<dim>::add_row_sum_bounds(Vector &stiffness, Vector &damping) const
{
  const unsigned int n_nodes = map->surface().n_nodes();
  std::vector<double> nodal_stiffness(n_nodes, 0.), nodal_damping(n_nodes, 0.);
  potential.add_row_sum_bounds(nodal_stiffness, nodal_damping);
  this->spread(nodal_stiffness, stiffness);
  this->spread(nodal_damping, damping);
}

template <int dim>
std::vector<unsigned int> ContactForce<dim>::unseen_contact(const State &state, double unheeded_depth) const
{
  const ContactSurface<dim> &surface = map->surface();
  const std::vector<bool> is_active = potential.active_facets();
  // At nodes of facets in contact any depth is known, elsewhere that to which contact goes anyway: with a
  // stiff penalty a corner at the rim may lie in the other side a little while no point does.
  std::vector<double> known_depth(surface.n_nodes(), std::max(measure().max_penetration, unheeded_depth));
  for (unsigned int f = 0; f < surface.facets.size(); ++f)
    for (unsigned int i = 0; i < surface.facets[f].n_nodes(); ++i)
      if (is_active[f])
        known_depth[surface.facets[f].nodes[i]] = std::numeric_limits<double>::max();
  MPI_Allreduce(MPI_IN_PLACE, known_depth.data(), static_cast<int>(known_depth.size()), MPI_DOUBLE, MPI_MAX,
                this->communicator);
  return contact::find_unseen_contact(surface, potential.pair_list(), map->positions(state.displacement),
                                      known_depth);
}

template <int dim>
std::vector<double> ContactForce<dim>::projected_pressures() const
{
  const ContactSurface<dim> &surface = map->surface();
  const NodalPressures<dim> of_facets = facet_pressures();
  std::vector<double> sums(2 * surface.n_nodes(), 0.); // force and area of each node
  for (unsigned int f = 0; f < surface.facets.size(); ++f)
  {
    const Facet<dim> &facet = surface.facets[f];
    const auto end = of_facets[f].begin() + facet.n_nodes();
    if (!facet.owned ||
        std::all_of(of_facets[f].begin(), end, [](double pressure) { return pressure == 0.; }))
      continue; // where contact ends, as on a cut, its last faces count alone
    const double area = undeformed_area(facet, surface);
    for (unsigned int i = 0; i < facet.n_nodes(); ++i)
    {
      sums[2 * facet.nodes[i]] += area * of_facets[f][i];
      sums[2 * facet.nodes[i] + 1] += area;
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM,
                this->communicator);
  std::vector<double> pressures;
  for (unsigned int node = 0; node < surface.n_nodes(); ++node)
    pressures.push_back(sums[2 * node + 1] > 0. ? sums[2 * node] / sums[2 * node + 1] : 0.);
  return pressures;
}

template <int dim>
NodalPressures<dim> ContactForce<dim>::facet_pressures() const
{
  const ContactSurface<dim> &surface = map->surface();
  NodalPressures<dim> pressures(surface.facets.size());
  std::vector<Corners<dim>> moments(surface.facets.size()); // ∫ p N dA, of facets that have samples
  for (const contact::ContactSample<dim> &sample : potential.samples())
  {
    const Corners<dim> corners = corner_functions<dim>(surface.facets[sample.facet].type, sample.xi);
    Corners<dim> &sum = moments[sample.facet];
    if (sum.size() == 0)
      sum.setZero(corners.size());
    sum += sample.full_area * sample.pressure * corners;
  }
  for (unsigned int f = 0; f < surface.facets.size(); ++f)
  {
    const Facet<dim> &facet = surface.facets[f];
    pressures[f].fill(0.);
    if (moments[f].size() == 0)
      continue;
    const Corners<dim> corners =
        project_on_corners<dim>(facet.type, moments[f], undeformed_area(facet, surface));
    for (unsigned int i = 0; i < facet.n_nodes(); ++i)
      pressures[f][i] =
          std::max(0., corners.dot(corner_functions<dim>(facet.type, contact::node_coordinates(facet, i))));
  }
  return pressures;
}

template <int dim>
std::vector<unsigned int> ContactForce<dim>::n_pairs_of_facets() const
{
  std::vector<unsigned int> n_pairs(map->surface().facets.size(), 0);
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
    sample.position += map->surface().origin;
  return samples;
}

template <int dim>
contact::ContactMeasures<dim> ContactForce<dim>::measure() const
{
  return this->sum(potential.measure(), map->surface().origin);
}

template <int dim>
contact::PairForces<dim> ContactForce<dim>::pair_forces(const State &state) const
{
  using Velocities = std::vector<SpatialVector<dim>>;
  return this->sum(
      potential.pair_forces(state.velocity.size() > 0 ? map->gather(state.velocity) : Velocities()));
}

template class ContactForce<2>;
template class ContactForce<3>;
} // namespace signorini
