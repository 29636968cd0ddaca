// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/solvers/linear_solver.h"

#include "signorini/base/exceptions.h"

#include <Epetra_CrsMatrix.h>
#include <petscksp.h>

#include <utility>
#include <vector>

namespace signorini
{
namespace
{
/// A PETSc object, destroyed at the end of its scope (collective).
template <typename Object, PetscErrorCode (*destroy)(Object *)>
struct Owned
{
  Object object = nullptr;
  Owned() = default;
  Owned(const Owned &) = delete;
  Owned &operator=(const Owned &) = delete;
  ~Owned() { destroy(&object); }
  operator Object() const { return object; }
  Object *operator&() { return &object; }
};

using OwnedMatrix = Owned<Mat, MatDestroy>;
using OwnedVector = Owned<Vec, VecDestroy>;
using OwnedSolver = Owned<KSP, KSPDestroy>;

/// A matrix in PETSc's storage, on the same rows, with the vectors and the solver that go with it.
struct PetscSystem
{
  OwnedMatrix matrix;
  OwnedVector x, b;
  OwnedSolver solver;
};

/// What of a matrix PETSc is given. Half of it halves what each iteration reads.
enum class Storage
{
  whole,
  upper_triangle
};

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

/// A solver of PETSc's. Keeps matrix, symbolic factorisations and memory from one system to the next of the
/// same pattern.
class PetscSolver : public LinearSolver
{
public:
  void forget_pattern() override { system.reset(); }

protected:
  PetscSolver(Symmetry symmetry_of_matrix, Storage storage_of_matrix)
      : symmetry(symmetry_of_matrix), storage(storage_of_matrix)
  {
  }

  static bool is_solved(KSPConvergedReason reason) { return reason > 0; }
  static bool is_indefinite(KSPConvergedReason reason)
  {
    return reason == KSP_DIVERGED_INDEFINITE_MAT || reason == KSP_DIVERGED_INDEFINITE_PC;
  }

  /// Returns why it ended.
  KSPConvergedReason run(const dealii::TrilinosWrappers::SparseMatrix &matrix,
                         const dealii::TrilinosWrappers::MPI::Vector &right_hand_side,
                         double relative_tolerance, int max_iterations,
                         dealii::TrilinosWrappers::MPI::Vector &solution)
  {
    if (!system)
      make_system(matrix);
    else
      set_values(matrix);
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

  const Symmetry symmetry;
  const Storage storage;
  unsigned int n_iterations = 0; ///< of the last run

private:
  /// Sets up a new solver.
  virtual void configure(KSP solver) const = 0;

  void make_system(const dealii::TrilinosWrappers::SparseMatrix &matrix)
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
      MatCreateMPIAIJWithArrays(communicator, rows.size(), rows.size(), n, n, row_starts.data(),
                                columns.data(), values.data(), &system->matrix);
    else
      MatCreateMPISBAIJWithArrays(communicator, 1, rows.size(), rows.size(), n, n, row_starts.data(),
                                  columns.data(), values.data(), &system->matrix);
    if (symmetry == Symmetry::symmetric)
      MatSetOption(system->matrix, MAT_SPD, PETSC_TRUE);
    MatCreateVecs(system->matrix, &system->x, &system->b);
    KSPCreate(communicator, &system->solver);
    configure(system->solver);
  }

  void set_values(const dealii::TrilinosWrappers::SparseMatrix &matrix)
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

  std::unique_ptr<PetscSystem> system;
};

class DirectSolver : public PetscSolver
{
public:
  explicit DirectSolver(Symmetry symmetry_of_matrix)
      : PetscSolver(symmetry_of_matrix,
                    symmetry_of_matrix == Symmetry::symmetric ? Storage::upper_triangle : Storage::whole)
  {
  }

  std::optional<unsigned int> solve(const dealii::TrilinosWrappers::SparseMatrix &matrix,
                                    const dealii::TrilinosWrappers::MPI::Vector &right_hand_side,
                                    double relative_tolerance,
                                    dealii::TrilinosWrappers::MPI::Vector &solution) override
  {
    if (!is_solved(run(matrix, right_hand_side, relative_tolerance, 1, solution)))
      throw NumericalError("the direct solver could not factorise the tangent: it is singular");
    return 1;
  }
  std::string name() const override { return "direct (MUMPS)"; }

private:
  void configure(KSP solver) const override
  {
    PC factorisation = nullptr;
    KSPSetType(solver, KSPPREONLY);
    KSPGetPC(solver, &factorisation);
    PCSetType(factorisation, symmetry == Symmetry::symmetric ? PCCHOLESKY : PCLU);
    PCFactorSetMatSolverType(factorisation, MATSOLVERMUMPS);
  }
};

class AmgSolver : public PetscSolver
{
public:
  AmgSolver(unsigned int n_displacement_components, Symmetry symmetry_of_matrix)
      : PetscSolver(symmetry_of_matrix, Storage::whole), n_components(n_displacement_components)
  {
  }

  std::optional<unsigned int> solve(const dealii::TrilinosWrappers::SparseMatrix &matrix,
                                    const dealii::TrilinosWrappers::MPI::Vector &right_hand_side,
                                    double relative_tolerance,
                                    dealii::TrilinosWrappers::MPI::Vector &solution) override
  {
    const KSPConvergedReason reason = run(matrix, right_hand_side, relative_tolerance, 2000, solution);
    if (is_indefinite(reason))
      return {};
    if (!is_solved(reason))
      throw NumericalError(name() + " did not reach the tolerance in " + std::to_string(n_iterations) +
                           " iterations");
    return n_iterations;
  }
  std::string name() const override
  {
    return symmetry == Symmetry::symmetric ? "conjugate gradients with BoomerAMG" : "GMRES with BoomerAMG";
  }

private:
  void configure(KSP solver) const override
  {
    PC multigrid = nullptr;
    KSPSetType(solver, symmetry == Symmetry::symmetric ? KSPCG : KSPFGMRES);
    KSPSetNormType(solver, KSP_NORM_UNPRECONDITIONED);
    KSPGetPC(solver, &multigrid);
    PCSetType(multigrid, PCHYPRE);
    PCHYPRESetType(multigrid, "boomeramg");
    set_multigrid_options();
    PCSetFromOptions(multigrid);
  }

  /// Sparse coarse levels: hypre's own defaults fill them up in 3-D, at six to nine times the cost of a
  /// cycle.
  void set_multigrid_options() const
  {
    const std::pair<const char *, const char *> options[] = {
        {"-pc_hypre_boomeramg_strong_threshold", n_components == 2 ? "0.25" : "0.5"},
        {"-pc_hypre_boomeramg_relax_type_all", "symmetric-SOR/Jacobi"},
        {"-pc_hypre_boomeramg_coarsen_type", "HMIS"},
        {"-pc_hypre_boomeramg_interp_type", "ext+i"},
        {"-pc_hypre_boomeramg_P_max", "4"},
        {"-pc_hypre_boomeramg_agg_nl", "1"}};
    for (const auto &[name, value] : options)
      PetscOptionsSetValue(nullptr, name, value);
  }

  unsigned int n_components;
};

class SchwarzSolver : public PetscSolver
{
public:
  SchwarzSolver(std::unique_ptr<LinearSolver> solver_of_hard_systems, int largest_number_of_iterations)
      : PetscSolver(Symmetry::symmetric, Storage::upper_triangle),
        fallback(std::move(solver_of_hard_systems)), max_iterations(largest_number_of_iterations)
  {
  }

  std::optional<unsigned int> solve(const dealii::TrilinosWrappers::SparseMatrix &matrix,
                                    const dealii::TrilinosWrappers::MPI::Vector &right_hand_side,
                                    double relative_tolerance,
                                    dealii::TrilinosWrappers::MPI::Vector &solution) override
  {
    if (is_too_hard)
      return fallback->solve(matrix, right_hand_side, relative_tolerance, solution);
    const KSPConvergedReason reason =
        run(matrix, right_hand_side, relative_tolerance, max_iterations, solution);
    if (is_indefinite(reason))
      return {};
    if (is_solved(reason))
      return n_iterations;
    is_too_hard = true;
    PetscSolver::forget_pattern();
    return fallback->solve(matrix, right_hand_side, relative_tolerance, solution);
  }
  void forget_pattern() override
  {
    PetscSolver::forget_pattern();
    fallback->forget_pattern();
  }
  std::string name() const override
  {
    return "conjugate gradients with incomplete factorisations, or else " + fallback->name();
  }

private:
  void configure(KSP solver) const override
  {
    KSPSetType(solver, KSPCG);
    // The energy of the error, not the norm of forces: those of stiff contact would hide all others.
    KSPSetNormType(solver, KSP_NORM_NATURAL);
    PC schwarz = nullptr;
    KSPGetPC(solver, &schwarz);
    PetscMPIInt n_ranks = 1;
    MPI_Comm_size(PetscObjectComm(reinterpret_cast<PetscObject>(solver)), &n_ranks);
    PCSetType(schwarz, n_ranks == 1 ? PCBJACOBI : PCASM);
    PCASMSetType(schwarz, PC_ASM_BASIC); // the symmetric one; for PCASM alone
    PetscOptionsSetValue(nullptr, "-sub_pc_type", "icc");
    PCSetFromOptions(schwarz); // or the blocks do not read it
  }

  std::unique_ptr<LinearSolver> fallback;
  const int max_iterations;
  bool is_too_hard = false;
};
} // namespace

std::unique_ptr<LinearSolver> make_direct_solver(Symmetry symmetry)
{
  return std::make_unique<DirectSolver>(symmetry);
}

std::unique_ptr<LinearSolver> make_amg_solver(unsigned int n_components, Symmetry symmetry)
{
  return std::make_unique<AmgSolver>(n_components, symmetry);
}

std::unique_ptr<LinearSolver> make_schwarz_solver(std::unique_ptr<LinearSolver> fallback, int max_iterations)
{
  return std::make_unique<SchwarzSolver>(std::move(fallback), max_iterations);
}
} // namespace signorini
