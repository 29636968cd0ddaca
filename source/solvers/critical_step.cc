// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/solvers/critical_step.h"

#include <cmath>

namespace signorini
{
template <int dim>
ContactBound compute_contact_bound(const std::vector<const ContactTerm<dim> *> &contacts, const Vector &mass,
                                   const Discretization<dim> &discretization)
{
  Vector stiffness = discretization.make_vector(), damping = discretization.make_vector();
  for (const ContactTerm<dim> *contact : contacts)
    contact->add_row_sum_bounds(stiffness, damping);
  discretization.collect(stiffness);
  discretization.collect(damping);
  ContactBound bound;
  for (unsigned int i = 0; i < mass.locally_owned_size(); ++i)
    if (mass.local_element(i) > 0.)
    {
      bound.frequency_squared =
          std::max(bound.frequency_squared, stiffness.local_element(i) / mass.local_element(i));
      bound.damping_rate = std::max(bound.damping_rate, damping.local_element(i) / mass.local_element(i));
    }
  bound.frequency_squared =
      dealii::Utilities::MPI::max(bound.frequency_squared, discretization.communicator());
  bound.damping_rate = dealii::Utilities::MPI::max(bound.damping_rate, discretization.communicator());
  return bound;
}

double critical_time_step(double frequency_squared, double damping_rate)
{
  return (std::sqrt(damping_rate * damping_rate + 4. * frequency_squared) - damping_rate) / frequency_squared;
}

template ContactBound compute_contact_bound<2>(const std::vector<const ContactTerm<2> *> &, const Vector &,
                                               const Discretization<2> &);
template ContactBound compute_contact_bound<3>(const std::vector<const ContactTerm<3> *> &, const Vector &,
                                               const Discretization<3> &);
} // namespace signorini
