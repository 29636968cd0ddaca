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

/// The same matrix in PETSc's storage, on the same rows.
void copy(const dealii::TrilinosWrappers::SparseMatrix &matrix, Symmetry symmetry, Mat *copied)
{
  const Epetra_CrsMatrix &epetra = matrix.trilinos_matrix();
  std::vector<PetscInt> row_starts{0}, columns;
  std::vector<PetscScalar> values;
  for (int row = 0; row < epetra.NumMyRows(); ++row)
  {
    int n_entries = 0, *local_columns = nullptr;
    double *row_values = nullptr;
    epetra.ExtractMyRowView(row, n_entries, row_values, local_columns);
    for (int i = 0; i < n_entries; ++i)
      columns.push_back(epetra.GCID(local_columns[i]));
    values.insert(values.end(), row_values, row_values + n_entries);
    row_starts.push_back(static_cast<PetscInt>(columns.size()));
  }
  const auto n = static_cast<PetscInt>(matrix.m());
  MatCreateMPIAIJWithArrays(matrix.get_mpi_communicator(), epetra.NumMyRows(), epetra.NumMyRows(), n, n,
                            row_starts.data(), columns.data(), values.data(), copied);
  if (symmetry == Symmetry::symmetric)
    MatSetOption(*copied, MAT_SPD, PETSC_TRUE);
}

bool is_solved(KSPConvergedReason reason)
{
  return reason > 0;
}

bool is_indefinite(KSPConvergedReason reason)
{
  return reason == KSP_DIVERGED_INDEFINITE_MAT || reason == KSP_DIVERGED_INDEFINITE_PC;
}

/// Solves with a PETSc solver that `configure(solver)` has set up. Returns why it ended.
template <typename Configure>
KSPConvergedReason solve_in_petsc(const dealii::TrilinosWrappers::SparseMatrix &matrix, Symmetry symmetry,
                                  const dealii::TrilinosWrappers::MPI::Vector &right_hand_side,
                                  dealii::TrilinosWrappers::MPI::Vector &solution, PetscInt &n_iterations,
                                  const Configure &configure)
{
  OwnedMatrix system;
  copy(matrix, symmetry, &system);
  OwnedVector x, b;
  MatCreateVecs(system, &x, &b);
  PetscScalar *entries = nullptr;
  VecGetArray(b, &entries);
  std::copy(right_hand_side.begin(), right_hand_side.end(), entries);
  VecRestoreArray(b, &entries);

  OwnedSolver solver;
  KSPCreate(matrix.get_mpi_communicator(), &solver);
  KSPSetOperators(solver, system, system);
  configure(static_cast<KSP>(solver));
  const bool is_run = KSPSolve(solver, b, x) == 0;
  KSPConvergedReason reason = KSP_DIVERGED_NULL;
  KSPGetConvergedReason(solver, &reason);
  KSPGetIterationNumber(solver, &n_iterations);
  VecGetArray(x, &entries);
  std::copy(entries, entries + (solution.end() - solution.begin()), solution.begin());
  VecRestoreArray(x, &entries);
  return is_run ? reason : KSP_DIVERGED_NULL;
}

class DirectSolver : public LinearSolver
{
public:
  explicit DirectSolver(Symmetry symmetry_of_matrix) : symmetry(symmetry_of_matrix) {}

  std::optional<unsigned int> solve(const dealii::TrilinosWrappers::SparseMatrix &matrix,
                                    const dealii::TrilinosWrappers::MPI::Vector &right_hand_side,
                                    double /*relative_tolerance*/,
                                    dealii::TrilinosWrappers::MPI::Vector &solution) override
  {
    PetscInt n_iterations = 0;
    if (!is_solved(solve_in_petsc(matrix, symmetry, right_hand_side, solution, n_iterations,
                                  [this](KSP solver)
                                  {
                                    PC factorisation = nullptr;
                                    KSPSetType(solver, KSPPREONLY);
                                    KSPGetPC(solver, &factorisation);
                                    PCSetType(factorisation,
                                              symmetry == Symmetry::symmetric ? PCCHOLESKY : PCLU);
                                    PCFactorSetMatSolverType(factorisation, MATSOLVERMUMPS);
                                  })))
      throw NumericalError("the direct solver could not factorise the tangent: it is singular");
    return 1;
  }
  std::string name() const override { return "direct (MUMPS)"; }

private:
  Symmetry symmetry;
};

class AmgSolver : public LinearSolver
{
public:
  AmgSolver(unsigned int n_displacement_components, Symmetry symmetry_of_matrix)
      : n_components(n_displacement_components), symmetry(symmetry_of_matrix)
  {
  }

  std::optional<unsigned int> solve(const dealii::TrilinosWrappers::SparseMatrix &matrix,
                                    const dealii::TrilinosWrappers::MPI::Vector &right_hand_side,
                                    double relative_tolerance,
                                    dealii::TrilinosWrappers::MPI::Vector &solution) override
  {
    PetscInt n_iterations = 0;
    const KSPConvergedReason reason =
        solve_in_petsc(matrix, symmetry, right_hand_side, solution, n_iterations,
                       [&](KSP solver)
                       {
                         PC multigrid = nullptr;
                         KSPSetType(solver, symmetry == Symmetry::symmetric ? KSPCG : KSPFGMRES);
                         KSPSetNormType(solver, KSP_NORM_UNPRECONDITIONED);
                         KSPSetTolerances(solver, relative_tolerance, 0., PETSC_DEFAULT, 2000);
                         KSPGetPC(solver, &multigrid);
                         PCSetType(multigrid, PCHYPRE);
                         PCHYPRESetType(multigrid, "boomeramg");
                         set_multigrid_options();
                         PCSetFromOptions(multigrid);
                       });
    if (is_indefinite(reason))
      return {};
    if (!is_solved(reason))
      throw NumericalError(name() + " did not reach the tolerance in " + std::to_string(n_iterations) +
                           " iterations");
    return static_cast<unsigned int>(n_iterations);
  }
  std::string name() const override
  {
    return symmetry == Symmetry::symmetric ? "conjugate gradients with BoomerAMG" : "GMRES with BoomerAMG";
  }

private:
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
  Symmetry symmetry;
};

class SchwarzSolver : public LinearSolver
{
public:
  explicit SchwarzSolver(std::unique_ptr<LinearSolver> solver_of_hard_systems)
      : fallback(std::move(solver_of_hard_systems))
  {
  }

  std::optional<unsigned int> solve(const dealii::TrilinosWrappers::SparseMatrix &matrix,
                                    const dealii::TrilinosWrappers::MPI::Vector &right_hand_side,
                                    double relative_tolerance,
                                    dealii::TrilinosWrappers::MPI::Vector &solution) override
  {
    if (is_too_hard)
      return fallback->solve(matrix, right_hand_side, relative_tolerance, solution);
    PetscInt n_iterations = 0;
    const KSPConvergedReason reason =
        solve_in_petsc(matrix, Symmetry::symmetric, right_hand_side, solution, n_iterations,
                       [&](KSP solver)
                       {
                         PC schwarz = nullptr;
                         KSPSetType(solver, KSPCG);
                         KSPSetNormType(solver, KSP_NORM_UNPRECONDITIONED);
                         KSPSetTolerances(solver, relative_tolerance, 0., PETSC_DEFAULT, max_iterations);
                         KSPGetPC(solver, &schwarz);
                         PCSetType(schwarz, PCASM);
                         PCASMSetType(schwarz, PC_ASM_BASIC); // the symmetric one
                         PetscOptionsSetValue(nullptr, "-sub_pc_type", "icc");
                       });
    if (is_indefinite(reason))
      return {};
    if (is_solved(reason))
      return static_cast<unsigned int>(n_iterations);
    is_too_hard = true;
    const std::optional<unsigned int> more =
        fallback->solve(matrix, right_hand_side, relative_tolerance, solution);
    return more ? std::optional(static_cast<unsigned int>(n_iterations) + *more) : more;
  }
  std::string name() const override
  {
    return "conjugate gradients with incomplete factorisations, or else " + fallback->name();
  }

private:
  /// As many as cost about what multigrid does: one of its iterations costs five of these.
  static constexpr int max_iterations = 500;

  std::unique_ptr<LinearSolver> fallback;
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

std::unique_ptr<LinearSolver> make_schwarz_solver(std::unique_ptr<LinearSolver> fallback)
{
  return std::make_unique<SchwarzSolver>(std::move(fallback));
}
} // namespace signorini
