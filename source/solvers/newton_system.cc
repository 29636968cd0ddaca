// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/solvers/newton_system.h"

#include <algorithm>

namespace signorini
{
template <int dim>
NewtonSystem<dim>::NewtonSystem(const Discretization<dim> &the_discretization,
                                const SupportedDofs<dim> &supported_dofs, const SceneForces<dim> &forces,
                                const std::vector<std::shared_ptr<ForceTerm>> &all_terms,
                                Vector the_regularization, std::unique_ptr<LinearSolver> solver,
                                RunTime &the_run_time)
    : discretization(&the_discretization), supports(&supported_dofs), scene_forces(&forces),
      terms(&all_terms), regularization(std::move(the_regularization)), linear_solver(std::move(solver)),
      run_time(&the_run_time)
{
}

template <int dim>
unsigned int NewtonSystem<dim>::n_searches() const
{
  unsigned int n = 0;
  for (const auto &term : *terms)
    n += term->n_searches();
  return n;
}

template <int dim>
bool NewtonSystem<dim>::constrain(double old_time, double time)
{
  times_of_constraints = {old_time, time};
  relevant_dofs = discretization->relevant_dofs;
  for (const auto &contact : scene_forces->contacts)
    relevant_dofs.add_indices(contact->nodes().relevant_dofs());
  relevant_dofs.compress();
  do_supports_move = false;
  constraints.reinit(relevant_dofs);
  constraints.merge(discretization->hanging_constraints,
                    dealii::AffineConstraints<double>::no_conflicts_allowed, true);
  for (const auto &contact : scene_forces->contacts)
    contact->nodes().add_remote_hanging_constraints(constraints);
  for (const auto &entry : supports->entries())
  {
    const double increment = supports->value(entry, time) - supports->value(entry, old_time);
    do_supports_move |= increment != 0.;
    if (constraints.can_store_line(entry.dof) && !constraints.is_constrained(entry.dof))
    {
      constraints.add_line(entry.dof);
      constraints.set_inhomogeneity(entry.dof, increment);
    }
  }
  for (const dealii::types::global_dof_index dof : discretization->unused_dofs)
    constraints.add_line(dof);
  constraints.close();
  return do_supports_move;
}

template <int dim>
void NewtonSystem<dim>::prepare(const std::vector<std::shared_ptr<ForceTerm>> &coupling_terms,
                                TangentSystem &empty_system) const
{
  dealii::TrilinosWrappers::SparsityPattern pattern(discretization->owned_dofs, discretization->owned_dofs,
                                                    relevant_dofs, discretization->communicator());
  discretization->add_couplings(constraints, pattern);
  for (const auto &term : coupling_terms)
    term->add_couplings(constraints, pattern);
  for (const dealii::types::global_dof_index dof : discretization->unused_dofs)
    pattern.add(dof, dof);
  pattern.compress();
  empty_system.constraints = &constraints;
  empty_system.matrix.reinit(pattern);
  empty_system.right_hand_side.reinit(discretization->owned_dofs, discretization->communicator());
}

template <int dim>
void NewtonSystem<dim>::rebuild_matrix()
{
  constrain(times_of_constraints.first, times_of_constraints.second); // other facets have come near
  linear_solver->forget_pattern();
  prepare(*terms, system);
  n_searches_of_matrix = n_searches();
}

template <int dim>
void NewtonSystem<dim>::assemble_constant_part()
{
  prepare({}, constant_part);
  for (const auto &term : *terms)
    if (term->has_constant_tangent())
      term->add_tangent(constant_part);
  constant_part.matrix.compress(dealii::VectorOperation::add);
}

template <int dim>
void NewtonSystem<dim>::assemble(const Vector &forces, ContactTangent kind)
{
  const auto section = run_time->enter("assembly");
  if (n_searches() != n_searches_of_matrix)
    rebuild_matrix();
  // What supports that move bring to the right hand side comes with the assembly of the cells.
  const bool is_all_anew =
      do_supports_move || std::none_of(terms->begin(), terms->end(),
                                       [](const auto &term) { return term->has_constant_tangent(); });
  system.right_hand_side = 0.;
  if (!is_all_anew && constant_part.matrix.m() == 0)
    assemble_constant_part();
  system.matrix = 0.;
  if (!is_all_anew)
    system.matrix.add(1., constant_part.matrix);
  system.contact_tangent = kind;
  const auto add_tangents = [&](bool of_contact)
  {
    for (const auto &term : *terms)
      if ((term->kind == ForceTerm::Kind::contact) == of_contact &&
          (is_all_anew || !term->has_constant_tangent()))
        term->add_tangent(system);
  };
  add_tangents(false);
  const auto &partitioner = *forces.get_partitioner();
  for (unsigned int i = 0; i < forces.locally_owned_size(); ++i)
  {
    const dealii::types::global_dof_index dof = partitioner.local_to_global(i);
    system.right_hand_side[dof] += forces.local_element(i);
    system.matrix.add(dof, dof, constraints.is_constrained(dof) ? 0. : regularization.local_element(i));
  }
  for (const dealii::types::global_dof_index dof : discretization->unused_dofs)
    system.matrix.add(dof, dof, 1.);
  system.matrix.compress(dealii::VectorOperation::add);
  const std::vector<double> diagonal_without_contact = owned_diagonal();
  add_tangents(true);
  for (const auto &friction : scene_forces->frictions)
    friction->add_tangent(system);
  system.matrix.compress(dealii::VectorOperation::add);
  find_stiff_rows(diagonal_without_contact);
  system.right_hand_side.compress(dealii::VectorOperation::add);
}

template <int dim>
std::vector<double> NewtonSystem<dim>::owned_diagonal() const
{
  std::vector<double> diagonal;
  for (const dealii::types::global_dof_index dof : discretization->owned_dofs)
    diagonal.push_back(system.matrix.diag_element(dof));
  return diagonal;
}

template <int dim>
void NewtonSystem<dim>::find_stiff_rows(const std::vector<double> &diagonal_without_contact)
{
  // Softer contact is no harder to solve for than elements are.
  constexpr double stiff = 2., hard = 100.;
  stiff_rows = dealii::IndexSet(discretization->owned_dofs.size());
  const std::vector<double> diagonal = owned_diagonal();
  double largest_ratio = 1.;
  for (std::size_t i = 0; i < diagonal.size(); ++i)
  {
    const double ratio = diagonal[i] / diagonal_without_contact[i];
    largest_ratio = std::max(largest_ratio, ratio);
    if (ratio > stiff)
      stiff_rows.add_index(discretization->owned_dofs.nth_index_in_set(i));
  }
  if (dealii::Utilities::MPI::max(largest_ratio, discretization->communicator()) < hard)
    stiff_rows.clear();
  stiff_rows.compress();
}

template <int dim>
std::optional<unsigned int> NewtonSystem<dim>::solve(const Vector &forces, ContactTangent kind,
                                                     double tolerance, Vector &increment)
{
  assemble(forces, kind);
  const auto section = run_time->enter("linear solver");
  const auto &partitioner = *forces.get_partitioner();
  dealii::TrilinosWrappers::MPI::Vector solution(discretization->owned_dofs, discretization->communicator());
  const std::optional<unsigned int> n_iterations =
      linear_solver->solve(system.matrix, system.right_hand_side, stiff_rows, tolerance, solution);
  if (!n_iterations)
    return {};
  constraints.distribute(solution);
  for (unsigned int i = 0; i < increment.locally_owned_size(); ++i)
    increment.local_element(i) = solution[partitioner.local_to_global(i)];
  discretization->distribute(increment);
  return n_iterations;
}

template class NewtonSystem<2>;
template class NewtonSystem<3>;
} // namespace signorini
