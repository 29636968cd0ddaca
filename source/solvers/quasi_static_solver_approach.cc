// SPDX-License-Identifier: LGPL-2.1-or-later
// How equilibria far from the start are approached: by contact that is soft first.
#include "signorini/base/exceptions.h"
#include "signorini/solvers/quasi_static_solver.h"

#include <limits>

namespace signorini
{
template <int dim>
void QuasiStaticSolver<dim>::set_penalty_factor(double penalty_factor) const
{
  for (const auto &contact : forces->surface_contacts)
    contact->set_penalty_factor(penalty_factor);
}

template <int dim>
void QuasiStaticSolver<dim>::stiffen_contact(double penalty_factor, State &state, NewtonReport &progress,
                                             const Report &report)
{
  // The softest contact gives way about as much as an element does.
  constexpr double ratio = 10., softest = 1., tolerance = 0.1, largest_depth = 0.25;
  const double round_off = 1. + 1e-9;
  double softened = penalty_factor;
  while (softened >= ratio * softest / round_off)
    softened /= ratio;
  for (; softened < penalty_factor / round_off; softened *= ratio)
  {
    set_penalty_factor(softened);
    tangent = ContactTangent::exact;
    find_minimum(tolerance, state, progress, report);
    for (const auto &contact : forces->surface_contacts)
      if (contact->measure().max_penetration_over_thickness > largest_depth)
        throw NumericalError("soft contact lets the bodies too deep into each other");
  }
}

template <int dim>
void QuasiStaticSolver<dim>::approach(State &state, NewtonReport &progress, const Report &report)
{
  // Contact that gives way hardly more than the elements feels every point that touches too much: Newton's
  // method then loses such points ring by ring. Friction depends on the way.
  constexpr double far = 0.3;
  if (forces->surface_contacts.empty() || !forces->frictions.empty())
    return;
  const auto is_far = [&]()
  {
    progress.residual = balance.judge(state);
    report(progress);
    return !(progress.residual <= far);
  };
  if (!is_far())
    return;
  const double penalty_factor =
      forces->surface_contacts.front()->surface_potential().pair_list().settings().penalty_factor;
  const State start = state;
  try
  {
    iterate(std::numeric_limits<double>::max(), far, state, progress);
    if (!is_far())
      return;
    state = start;
    was_softened = true;
    stiffen_contact(penalty_factor, state, progress, report);
  }
  catch (const NumericalError &)
  {
    state = start;
  }
  set_penalty_factor(penalty_factor);
}

template void QuasiStaticSolver<2>::approach(State &, NewtonReport &, const Report &);
template void QuasiStaticSolver<3>::approach(State &, NewtonReport &, const Report &);
} // namespace signorini
