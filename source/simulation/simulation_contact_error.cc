// SPDX-License-Identifier: LGPL-2.1-or-later
// What a Simulation does about the error that the penalty leaves in an equilibrium, and about pressures that
// the faces do not resolve.
#include "signorini/simulation/simulation.h"

#include "signorini/base/exceptions.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace signorini
{
template <int dim>
std::optional<Complaint> Simulation<dim>::correct_contact(double time)
{
  const CorrectionParameters &wanted = *parameters.contact->correction;
  const auto multipliers_before = correction->multipliers();
  for (unsigned int step = 1;; ++step)
  {
    const double change = correction->update(state);
    results.correction_change = change;
    progress.step(fmt::format("load {:.5g}  correction {}  pressures change by {:.2e}", time, step, change),
                  time / std::get<QuasiStaticParameters>(parameters.solver).end_time);
    if (const std::optional<Complaint> fault = find_equilibrium(time))
    {
      correction->set(multipliers_before);
      return fault;
    }
    if (change <= wanted.tolerance)
      return {};
    if (step == wanted.max_steps)
    {
      warn(
          fmt::format("the correction of the contact at load {:.6g} still changed the pressures by {:.2e} in "
                      "its last step, {}: raise Contact/Correction/Maximum steps or Contact/Penalty factor",
                      time, change, step));
      return {};
    }
  }
}

template <int dim>
void Simulation<dim>::set_penalty_factor(double penalty_factor)
{
  results.penalty_factor = penalty_factor;
  for (const auto &contact : forces.surface_contacts)
    contact->set_penalty_factor(penalty_factor);
}

template <int dim>
std::optional<Complaint> Simulation<dim>::choose_penalty_factor(double time)
{
  // The square of the error by contact falls like 1/α; that of discretisation does not depend on it. What is
  // a little too soft stays, and what is too stiff has cost its price already.
  constexpr double smallest = 1., largest = 1e6, too_soft = 1.25, too_stiff = 16.;
  constexpr unsigned int max_rounds = 4;
  for (unsigned int round = 0; round < max_rounds; ++round)
  {
    estimate_error();
    const ErrorEstimate &estimate = results.estimate;
    if (estimate.is_any_contact_unseen || estimate.contact == 0. || estimate.discretization == 0.)
      return {};
    const double share = parameters.contact->contact_share, old_factor = results.penalty_factor;
    const double wanted =
        std::clamp(old_factor * estimate.contact / (share * estimate.discretization), smallest, largest);
    if (wanted == largest && old_factor == largest && estimate.contact > share * estimate.discretization)
      warn(fmt::format(
          "Penalty factor = auto ends at {:g}, where the error by contact is still {:.2g} of that of "
          "discretization: raise Contact/Contact share, or set Contact/Correction",
          largest, std::sqrt(estimate.contact / estimate.discretization)));
    if (wanted < too_soft * old_factor && old_factor < too_stiff * wanted)
      return {};
    const unsigned int n_before = results.n_iterations;
    set_penalty_factor(wanted);
    if (const std::optional<Complaint> fault = find_equilibrium(time))
      return fault;
    progress.say(fmt::format("load {:.5g}: error by contact {:.3g} of that of discretization: penalty factor "
                             "{:.4g} -> {:.4g}, k_A "
                             "= {:.4g} Pa/m, for {} more Newton iterations",
                             time, std::sqrt(estimate.contact / estimate.discretization), old_factor, wanted,
                             measure_contact().max_stiffness, results.n_iterations - n_before));
  }
  return {};
}

template <int dim>
void Simulation<dim>::warn_of_lone_points()
{
  if (results.has_ledger || forces.surface_contacts.empty() || !forces.volume_contacts.empty())
    return;
  double largest_mean = 0.;
  const std::vector<Facet<dim>> &facets = surface_map->surface().facets;
  for (const auto &term : forces.surface_contacts)
  {
    const NodalPressures<dim> pressures = term->facet_pressures();
    for (std::size_t f = 0; f < facets.size(); ++f)
    {
      const unsigned int n = facets[f].n_nodes();
      largest_mean =
          std::max(largest_mean, std::accumulate(pressures[f].begin(), pressures[f].begin() + n, 0.) / n);
    }
  }
  largest_mean = dealii::Utilities::MPI::max(largest_mean, communicator);
  constexpr double resolved = 2., round_off = 1e-6;
  if (results.contact.max_pressure > resolved * largest_mean + round_off * results.max_pressure)
    warn(fmt::format(
        "the largest contact pressure, {:.3g} Pa, is that of single points; the mean of no face "
        "exceeds {:.3g} Pa: contact is narrower than a face, or lies at an edge, or the facets of curved "
        "faces do not fit each other. Pressures and contact area are not resolved, less so than forces: "
        "refine there",
        results.contact.max_pressure, largest_mean));
}

template class Simulation<2>;
template class Simulation<3>;
} // namespace signorini
