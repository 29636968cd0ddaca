// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/output/impact_solutions.h"

#include "signorini/output/error_rows.h"

#include <algorithm>
#include <cmath>

namespace signorini
{
namespace
{
/// Time from the first to the last touch, from rows with a contact force.
double contact_duration(const std::vector<HistoryRow> &history)
{
  double first = -1., last = -1.;
  for (std::size_t i = 1; i < history.size(); ++i)
    if (norm(history[i].bodies.at(0).contact_force) > 0.)
    {
      first = first < 0. ? 0.5 * (history[i - 1].time + history[i].time) : first;
      last = i + 1 < history.size() ? 0.5 * (history[i].time + history[i + 1].time) : history[i].time;
    }
  return last - first;
}

double peak_force(const std::vector<HistoryRow> &history)
{
  double peak = 0.;
  for (const HistoryRow &row : history)
    peak = std::max(peak, norm(row.bodies.at(0).contact_force));
  return peak;
}

/// Time integral of the contact force on the first body along the last axis, from the rows of the history.
template <int dim>
double contact_impulse(const std::vector<HistoryRow> &history)
{
  double impulse = 0.;
  for (std::size_t i = 1; i < history.size(); ++i)
    impulse +=
        0.5 * (history[i].time - history[i - 1].time) *
        (history[i - 1].bodies.at(0).contact_force[dim - 1] + history[i].bodies.at(0).contact_force[dim - 1]);
  return impulse;
}
} // namespace

double restitution(double damping_ratio)
{
  // Doubling the angle turns the usual π − atan(2ξ√(1−ξ²)/(1−2ξ²)) into 2 acos ξ, which goes on beyond ξ = 1.
  const double xi = damping_ratio;
  if (xi < 1.)
    return std::exp(-2. * xi * std::acos(xi) / std::sqrt(1. - xi * xi));
  return xi > 1. ? std::exp(-2. * xi * std::acosh(xi) / std::sqrt(xi * xi - 1.)) : std::exp(-2.);
}

BallImpact solve_ball_impact(double modulus, double radius, double mass, double speed)
{
  // ½ m v² = ⅖ K δ^(5/2) with the force K δ^(3/2).
  const double pi = std::acos(-1.), K = 4. / 3. * modulus * std::sqrt(radius);
  BallImpact impact;
  impact.approach = std::pow(1.25 * mass * speed * speed / K, 0.4);
  impact.peak_force = K * std::pow(impact.approach, 1.5);
  impact.duration = 0.8 * std::sqrt(pi) * std::tgamma(0.4) / std::tgamma(0.9) * impact.approach / speed;
  return impact;
}

template <int dim>
std::vector<ErrorRow> compare_with_ball_impact(const Results<dim> &results)
{
  double inverse_mass = 0.;
  for (const double mass : results.body_masses)
    inverse_mass += 1. / mass;
  const HistoryRow &start = results.history.front();
  Triple velocity = start.bodies.at(0).velocity;
  for (unsigned int d = 0; d < dim && results.body_masses.size() > 1; ++d)
    velocity[d] -= start.bodies.at(1).velocity[d];
  const BallImpact exact = solve_ball_impact(contact_modulus(*results.parameters),
                                             results.parameters->exact_solution->values.at("Radius"),
                                             1. / inverse_mass, norm(velocity));
  const EnergyLedger &energy = results.energy;
  return {compare("peak contact force", peak_force(results.history), exact.peak_force),
          compare("contact time", contact_duration(results.history), exact.duration),
          compare("mechanical energy", energy.kinetic + energy.elastic + energy.contact, energy.initial)};
}

template <int dim>
std::vector<ErrorRow> compare_with_bar_impact(const Results<dim> &results)
{
  const BodyParameters &bar = results.parameters->bodies.at(0);
  const double length = bar.mesh.upper_corner[dim - 1] - bar.mesh.lower_corner[dim - 1];
  const double wave_speed = std::sqrt(bar.material.youngs_modulus / bar.material.density);
  const HistoryRow &start = results.history.front(), &end = results.history.back();
  const double v_one = start.bodies.at(0).velocity[dim - 1], v_other = start.bodies.at(1).velocity[dim - 1];
  const double exchanged = end.bodies.at(0).velocity[dim - 1] - v_one;
  const double area = results.body_volumes.at(0) / length;
  const double exact_force = 0.5 * bar.material.density * wave_speed * std::abs(v_other - v_one) * area;
  const EnergyLedger &energy = results.energy;
  return {compare("momentum exchange (velocity)", exchanged, v_other - v_one),
          compare("mechanical energy", energy.kinetic + energy.elastic + energy.contact, energy.initial),
          compare("contact time", contact_duration(results.history), 2. * length / wave_speed),
          compare("peak contact force (dashpots included)", peak_force(results.history), exact_force)};
}

template <int dim>
std::vector<ErrorRow> compare_with_bounce(const Results<dim> &results)
{
  const HistoryRow &start = results.history.front(), &end = results.history.back();
  // The dashpot is scaled with the mass of half a layer of elements but moves all of the block's layers.
  const MeshParameters &mesh = results.parameters->bodies.at(0).mesh;
  const double n_layers = mesh.cells[dim - 1] * std::pow(2., mesh.refinements);
  const double ratio = results.parameters->contact->damping->damping_ratio / std::sqrt(2. * n_layers);
  const double v_start = std::abs(start.bodies.at(0).velocity[dim - 1]), e = restitution(ratio);
  const double mass = results.body_masses.at(0);
  return {
      compare("restitution", end.bodies.at(0).velocity[dim - 1] / v_start, e),
      compare("impulse of the obstacle", contact_impulse<dim>(results.history), mass * (1. + e) * v_start),
      compare("dissipated energy", results.energy.dissipated, 0.5 * mass * v_start * v_start * (1. - e * e))};
}

template std::vector<ErrorRow> compare_with_bar_impact(const Results<2> &);
template std::vector<ErrorRow> compare_with_bar_impact(const Results<3> &);
template std::vector<ErrorRow> compare_with_ball_impact(const Results<2> &);
template std::vector<ErrorRow> compare_with_ball_impact(const Results<3> &);
template std::vector<ErrorRow> compare_with_bounce(const Results<2> &);
template std::vector<ErrorRow> compare_with_bounce(const Results<3> &);
} // namespace signorini
