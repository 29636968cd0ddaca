// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/solvers/linear_solver.h"

#include "signorini/base/exceptions.h"

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/petsc_precondition.h>
#include <deal.II/lac/petsc_solver.h>
#include <deal.II/lac/petsc_sparse_matrix.h>
#include <deal.II/lac/petsc_vector.h>
#include <deal.II/lac/solver_control.h>
#include <deal.II/lac/trilinos_solver.h>

namespace signorini
{
namespace
{
class DirectSolver : public LinearSolver
{
public:
  unsigned int solve(const dealii::TrilinosWrappers::SparseMatrix &matrix,
                     const dealii::TrilinosWrappers::MPI::Vector &right_hand_side,
                     dealii::TrilinosWrappers::MPI::Vector &solution) override
  {
    dealii::SolverControl control(1, 0.);
    dealii::TrilinosWrappers::SolverDirect solver(
      control, dealii::TrilinosWrappers::SolverDirect::AdditionalData(false, "Amesos_Mumps"));
    try
    {
      solver.initialize(matrix);
      solver.solve(solution, right_hand_side);
    }
    catch (const dealii::ExceptionBase &)
    {
      throw NumericalError("the direct solver could not factorise the tangent: it is singular");
    }
    return 1;
  }
  std::string name() const override { return "direct (MUMPS)"; }
};

/// The same matrix in PETSc's storage, on the same rows.
void copy(const dealii::TrilinosWrappers::SparseMatrix &matrix, dealii::PETScWrappers::MPI::SparseMatrix &copied)
{
  const dealii::IndexSet rows = matrix.locally_owned_range_indices();
  dealii::DynamicSparsityPattern pattern(matrix.m(), matrix.n(), rows);
  for (const auto row : rows)
    for (auto entry = matrix.begin(row); entry != matrix.end(row); ++entry)
      pattern.add(row, entry->column());
  copied.reinit(rows, rows, pattern, matrix.get_mpi_communicator());
  for (const auto row : rows)
    for (auto entry = matrix.begin(row); entry != matrix.end(row); ++entry)
      copied.set(row, entry->column(), entry->value());
  copied.compress(dealii::VectorOperation::insert);
}

class AmgSolver : public LinearSolver
{
public:
  AmgSolver(unsigned int n_displacement_components, double tolerance)
    : n_components(n_displacement_components)
    , relative_tolerance(tolerance)
  {}

  unsigned int solve(const dealii::TrilinosWrappers::SparseMatrix &matrix,
                     const dealii::TrilinosWrappers::MPI::Vector &right_hand_side,
                     dealii::TrilinosWrappers::MPI::Vector &solution) override
  {
    const MPI_Comm communicator = matrix.get_mpi_communicator();
    const dealii::IndexSet rows = matrix.locally_owned_range_indices();
    dealii::PETScWrappers::MPI::SparseMatrix system;
    copy(matrix, system);
    MatSetBlockSize(system, 1);
    dealii::PETScWrappers::MPI::Vector x(rows, communicator), b(rows, communicator);
    for (const auto row : rows)
      b[row] = right_hand_side[row];
    b.compress(dealii::VectorOperation::insert);

    dealii::PETScWrappers::PreconditionBoomerAMG::AdditionalData data;
    data.symmetric_operator = true;
    data.strong_threshold = n_components == 2 ? 0.25 : 0.5;
    data.aggressive_coarsening_num_levels = 0;
    dealii::SolverControl control(2000, relative_tolerance * b.l2_norm());
    dealii::PETScWrappers::SolverCG solver(control, communicator);
    try
    {
      dealii::PETScWrappers::PreconditionBoomerAMG preconditioner(system, data);
      solver.solve(system, x, b, preconditioner);
    }
    catch (const dealii::ExceptionBase &)
    {
      throw NumericalError("conjugate gradients did not reach their tolerance in " +
                           std::to_string(control.last_step()) + " iterations");
    }
    for (const auto row : rows)
      solution[row] = x[row];
    solution.compress(dealii::VectorOperation::insert);
    return control.last_step();
  }
  std::string name() const override { return "conjugate gradients with BoomerAMG"; }

private:
  unsigned int n_components;
  double relative_tolerance;
};
} // namespace

std::unique_ptr<LinearSolver> make_direct_solver()
{
  return std::make_unique<DirectSolver>();
}

std::unique_ptr<LinearSolver> make_amg_solver(unsigned int n_components, double relative_tolerance)
{
  return std::make_unique<AmgSolver>(n_components, relative_tolerance);
}
} // namespace signorini
