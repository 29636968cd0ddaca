// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/solvers/petsc_solver.h"

#include <Epetra_CrsMatrix.h>

#include <vector>

namespace signorini
{
namespace
{
/// The rows of a matrix of Trilinos as PETSc takes them, with global columns.
class Rows
{
public:
  Rows(const dealii::TrilinosWrappers::SparseMatrix &matrix, Storage the_storage)
      : epetra(matrix.trilinos_matrix()), storage(the_storage)
  {
  }

  int size() const { return epetra.NumMyRows(); }

  /// Appends a row to `columns` and `values`.
  void append(int row, std::vector<PetscInt> &columns, std::vector<PetscScalar> &values) const
  {
    int n_entries = 0, *local_columns = nullptr;
    double *values_of_row = nullptr;
    epetra.ExtractMyRowView(row, n_entries, values_of_row, local_columns);
    const PetscInt first = storage == Storage::whole ? 0 : epetra.GRID(row);
    for (int i = 0; i < n_entries; ++i)
      if (const PetscInt column = epetra.GCID(local_columns[i]); column >= first)
      {
        columns.push_back(column);
        values.push_back(values_of_row[i]);
      }
  }

private:
  const Epetra_CrsMatrix &epetra;
  Storage storage;
};
} // namespace

bool PetscSolver::is_indefinite(KSPConvergedReason reason)
{
  return reason == KSP_DIVERGED_INDEFINITE_MAT || reason == KSP_DIVERGED_INDEFINITE_PC ||
         reason == KSP_DIVERGED_PC_FAILED;
}

KSPConvergedReason PetscSolver::run(const dealii::TrilinosWrappers::SparseMatrix &matrix,
                                    const dealii::TrilinosWrappers::MPI::Vector &right_hand_side,
                                    double relative_tolerance, int max_iterations,
                                    dealii::TrilinosWrappers::MPI::Vector &solution)
{
  if (!system)
    make_system(matrix);
  else
    set_values(matrix);
  if (!system->solver)
  {
    KSPCreate(matrix.get_mpi_communicator(), &system->solver);
    configure(system->solver);
  }
  PetscScalar *entries = nullptr;
  VecGetArray(system->b, &entries);
  std::copy(right_hand_side.begin(), right_hand_side.end(), entries);
  VecRestoreArray(system->b, &entries);
  KSPSetOperators(system->solver, system->matrix, system->matrix);
  KSPSetTolerances(system->solver, relative_tolerance, 0., PETSC_DEFAULT, max_iterations);
  const bool is_run = KSPSolve(system->solver, system->b, system->x) == 0;
  KSPConvergedReason reason = KSP_DIVERGED_NULL;
  KSPGetConvergedReason(system->solver, &reason);
  PetscInt n = 0;
  KSPGetIterationNumber(system->solver, &n);
  n_iterations = static_cast<unsigned int>(n);
  VecGetArray(system->x, &entries);
  std::copy(entries, entries + (solution.end() - solution.begin()), solution.begin());
  VecRestoreArray(system->x, &entries);
  return is_run ? reason : KSP_DIVERGED_NULL;
}

void PetscSolver::forget_preconditioner()
{
  if (system)
    KSPDestroy(&system->solver);
}

void PetscSolver::make_system(const dealii::TrilinosWrappers::SparseMatrix &matrix)
{
  system = std::make_unique<PetscSystem>();
  const Rows rows(matrix, storage);
  std::vector<PetscInt> row_starts{0}, columns;
  std::vector<PetscScalar> values;
  for (int row = 0; row < rows.size(); ++row)
  {
    rows.append(row, columns, values);
    row_starts.push_back(static_cast<PetscInt>(columns.size()));
  }
  const MPI_Comm communicator = matrix.get_mpi_communicator();
  const auto n = static_cast<PetscInt>(matrix.m());
  if (storage == Storage::whole)
    MatCreateMPIAIJWithArrays(communicator, rows.size(), rows.size(), n, n, row_starts.data(), columns.data(),
                              values.data(), &system->matrix);
  else
    MatCreateMPISBAIJWithArrays(communicator, 1, rows.size(), rows.size(), n, n, row_starts.data(),
                                columns.data(), values.data(), &system->matrix);
  if (symmetry == Symmetry::symmetric)
    MatSetOption(system->matrix, MAT_SPD, PETSC_TRUE);
  MatCreateVecs(system->matrix, &system->x, &system->b);
}

void PetscSolver::set_values(const dealii::TrilinosWrappers::SparseMatrix &matrix)
{
  const Rows rows(matrix, storage);
  PetscInt row = 0, end = 0;
  MatGetOwnershipRange(system->matrix, &row, &end);
  std::vector<PetscInt> columns;
  std::vector<PetscScalar> values;
  for (int i = 0; i < rows.size(); ++i, ++row)
  {
    columns.clear();
    values.clear();
    rows.append(i, columns, values);
    MatSetValues(system->matrix, 1, &row, static_cast<PetscInt>(columns.size()), columns.data(),
                 values.data(), INSERT_VALUES);
  }
  MatAssemblyBegin(system->matrix, MAT_FINAL_ASSEMBLY);
  MatAssemblyEnd(system->matrix, MAT_FINAL_ASSEMBLY);
}
} // namespace signorini
