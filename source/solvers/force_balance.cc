// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/solvers/force_balance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace signorini
{
namespace
{
constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// However stiff the contact, a larger share of a body's forces is never taken for round-off.
constexpr double largest_round_off_share = 1e-4;
} // namespace

template <int dim>
ForceBalance<dim>::ForceBalance(const Discretization<dim> &the_discretization,
                                const SupportedDofs<dim> &supported_dofs, unsigned int n_bodies,
                                const SceneForces<dim> &scene_forces, const SurfaceMap<dim> *surface_map,
                                RunTime &the_run_time)
    : discretization(&the_discretization), supports(&supported_dofs), forces(&scene_forces), map(surface_map),
      run_time(&the_run_time), velocity(the_discretization.make_vector()),
      free_forces(the_discretization.make_vector()), support_forces(the_discretization.make_vector()),
      norms(n_bodies)
{
  all_terms.push_back(forces->elasticity);
  all_terms.insert(all_terms.end(), forces->loads.begin(), forces->loads.end());
  all_terms.insert(all_terms.end(), forces->contacts.begin(), forces->contacts.end());
}

template <int dim>
double ForceBalance<dim>::BodyNorms::scale() const
{
  return std::hypot(elastic, contact, load);
}

template <int dim>
double &ForceBalance<dim>::norm_of(ForceTerm::Kind kind, unsigned int body)
{
  return kind == ForceTerm::Kind::elastic   ? norms[body].elastic
         : kind == ForceTerm::Kind::contact ? norms[body].contact
                                            : norms[body].load;
}

template <int dim>
void ForceBalance<dim>::compute(const State &state)
{
  free_forces = 0.;
  norms.assign(norms.size(), {});
  for (const auto &term : all_terms)
  {
    const auto section = run_time->enter(term->name);
    term->update(state);
    add(term->kind, [&term](Vector &force) { term->add_force(force); });
  }
  for (const auto &friction : forces->frictions)
  {
    const auto section = run_time->enter("friction");
    friction->update(velocity);
    add(ForceTerm::Kind::contact, [&friction](Vector &force) { friction->add_force(force); });
  }
  support_forces = 0.;
  for (const unsigned int dof : supports->owned_dofs())
    support_forces.local_element(dof) = -free_forces.local_element(dof);
  supports->clear(free_forces);
}

template <int dim>
void ForceBalance<dim>::add(ForceTerm::Kind kind, const std::function<void(Vector &)> &add_force)
{
  Vector force = discretization->make_vector();
  add_force(force);
  discretization->collect(force);
  free_forces += force;
  const std::vector<double> of_term = compute_body_norms(force);
  for (unsigned int body = 0; body < norms.size(); ++body)
    norm_of(kind, body) = std::hypot(norm_of(kind, body), of_term[body]);
}

template <int dim>
std::vector<double> ForceBalance<dim>::compute_body_norms(const Vector &values) const
{
  std::vector<double> sums(norms.size(), 0.);
  for (const OwnedNode<dim> &node : discretization->owned_nodes)
    for (const unsigned int dof : node.dofs)
      sums[node.body] += values.local_element(dof) * values.local_element(dof);
  dealii::Utilities::MPI::sum(sums, discretization->communicator(), sums);
  for (double &sum : sums)
    sum = std::sqrt(sum);
  return sums;
}

template <int dim>
Vector ForceBalance<dim>::compute_contact_round_off(const State &state) const
{
  Vector stiffness = discretization->make_vector(), damping = discretization->make_vector();
  for (const auto &contact : forces->contacts)
    contact->add_row_sum_bounds(stiffness, damping);
  if (map)
    for (const OwnedNode<dim> &node : discretization->owned_nodes)
      for (unsigned int d = 0; d < dim; ++d)
        stiffness.local_element(node.dofs[d]) *= epsilon * (node.position[d] - map->surface().origin[d] +
                                                            state.displacement.local_element(node.dofs[d]));
  return stiffness;
}

template <int dim>
double ForceBalance<dim>::judge(const State &state)
{
  compute(state);
  Vector elastic = discretization->make_vector();
  forces->elasticity->add_magnitudes(elastic);
  discretization->collect(elastic);
  const std::vector<double> residuals = compute_body_norms(free_forces),
                            elastic_magnitudes = compute_body_norms(elastic),
                            contact_round_off = compute_body_norms(compute_contact_round_off(state));
  relative_residuals.assign(norms.size(), 0.);
  round_off_shares.assign(norms.size(), 0.);
  largest_magnitudes.resize(norms.size(), 0.);
  for (unsigned int body = 0; body < norms.size(); ++body)
  {
    // A body that was unloaded keeps the round-off of the state that it came from.
    largest_magnitudes[body] = std::max(largest_magnitudes[body], elastic_magnitudes[body]);
    const double scale = norms[body].scale(),
                 round_off = epsilon * largest_magnitudes[body] + contact_round_off[body];
    if (!std::isfinite(residuals[body] + scale))
      relative_residuals[body] = std::numeric_limits<double>::quiet_NaN();
    else if (norms[body].load > 0. || scale > 4. * round_off)
    {
      relative_residuals[body] = residuals[body] / scale;
      round_off_shares[body] = round_off / scale;
    }
  }
  return relative_residuals[worst_body()];
}

template <int dim>
unsigned int ForceBalance<dim>::worst_body() const
{
  const auto is_better = [](double one, double other)
  { return std::isnan(other) ? !std::isnan(one) : one < other; };
  return std::max_element(relative_residuals.begin(), relative_residuals.end(), is_better) -
         relative_residuals.begin();
}

template <int dim>
SpatialVector<dim> ForceBalance<dim>::unbalanced_force(unsigned int body) const
{
  std::vector<double> sums(dim + 1, 0.);
  for (const OwnedNode<dim> &node : discretization->owned_nodes)
    if (node.body == body)
    {
      SpatialVector<dim> force;
      for (unsigned int d = 0; d < dim; ++d)
        sums[d] += force[d] = free_forces.local_element(node.dofs[d]);
      sums[dim] += force.norm();
    }
  dealii::Utilities::MPI::sum(sums, discretization->communicator(), sums);
  const SpatialVector<dim> resultant(sums.data());
  return resultant.norm() > 0.9 * sums[dim] ? resultant : SpatialVector<dim>(SpatialVector<dim>::Zero());
}

template <int dim>
bool ForceBalance<dim>::is_within(double tolerance, bool has_stagnated) const
{
  for (unsigned int body = 0; body < norms.size(); ++body)
  {
    const double floor = has_stagnated ? std::min(largest_round_off_share, round_off_shares[body]) : 0.;
    if (!(relative_residuals[body] <= std::max(tolerance, floor)))
      return false;
  }
  return true;
}

template <int dim>
double ForceBalance<dim>::energy() const
{
  double sum = 0.;
  for (const auto &term : all_terms)
    sum += term->energy();
  for (const auto &friction : forces->frictions)
    sum += friction->held_energy();
  return sum;
}

template class ForceBalance<2>;
template class ForceBalance<3>;
} // namespace signorini
