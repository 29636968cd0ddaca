// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/solvers/critical_step.h"

#include <Eigen/Eigenvalues>

#include <cmath>

namespace signorini
{
namespace
{
/// Largest eigenvalue of a symmetric matrix of one cell with its lumped mass.
template <int dim>
double largest_eigenvalue(unsigned int cell, const std::vector<double> &matrix,
                          const std::vector<MaterialParameters> &materials, const CellTable<dim> &cells)
{
  const unsigned int n = cells.n_cell_dofs(cell);
  Eigen::VectorXd root_mass(n);
  for (unsigned int i = 0; i < n; ++i)
    root_mass[i] =
        std::sqrt(materials[cells.bodies[cell]].density * cells.cell_nodal_measures(cell)[i / dim]);
  Eigen::MatrixXd scaled = Eigen::Map<const Eigen::MatrixXd>(matrix.data(), n, n);
  scaled = root_mass.cwiseInverse().asDiagonal() * scaled * root_mass.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scaled, Eigen::EigenvaluesOnly);
  return eigen.eigenvalues()[n - 1];
}
} // namespace

template <int dim>
double compute_bulk_frequency_squared(const InternalForce<dim> &elasticity,
                                      const std::vector<MaterialParameters> &materials,
                                      const Discretization<dim> &discretization)
{
  double largest = 0.;
  elasticity.for_each_tangent(
      [&](unsigned int cell, const std::vector<double> &tangent)
      { largest = std::max(largest, largest_eigenvalue(cell, tangent, materials, discretization.cells)); });
  return dealii::Utilities::MPI::max(largest, discretization.communicator());
}

template <int dim>
double compute_bulk_damping_rate(const ViscousForce<dim> &viscosity, const State &state,
                                 const std::vector<MaterialParameters> &materials,
                                 const Discretization<dim> &discretization)
{
  double largest = 0.;
  viscosity.for_each_damping(
      state, [&](unsigned int cell, const std::vector<double> &damping)
      { largest = std::max(largest, largest_eigenvalue(cell, damping, materials, discretization.cells)); });
  return dealii::Utilities::MPI::max(largest, discretization.communicator());
}

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

template double compute_bulk_frequency_squared<2>(const InternalForce<2> &,
                                                  const std::vector<MaterialParameters> &,
                                                  const Discretization<2> &);
template double compute_bulk_frequency_squared<3>(const InternalForce<3> &,
                                                  const std::vector<MaterialParameters> &,
                                                  const Discretization<3> &);
template double compute_bulk_damping_rate<2>(const ViscousForce<2> &, const State &,
                                             const std::vector<MaterialParameters> &,
                                             const Discretization<2> &);
template double compute_bulk_damping_rate<3>(const ViscousForce<3> &, const State &,
                                             const std::vector<MaterialParameters> &,
                                             const Discretization<3> &);
template ContactBound compute_contact_bound<2>(const std::vector<const ContactTerm<2> *> &, const Vector &,
                                               const Discretization<2> &);
template ContactBound compute_contact_bound<3>(const std::vector<const ContactTerm<3> *> &, const Vector &,
                                               const Discretization<3> &);
} // namespace signorini
