// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/solvers/linear_solver.h"

#include "signorini/base/exceptions.h"
#include "signorini/solvers/petsc_solver.h"

#include <deal.II/base/mpi.h>

#include <utility>
#include <vector>

namespace signorini
{
namespace
{
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
                                    const dealii::IndexSet & /*stiff_rows*/, double relative_tolerance,
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
                                    const dealii::IndexSet & /*stiff_rows*/, double relative_tolerance,
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
                                    const dealii::IndexSet &stiff_rows, double relative_tolerance,
                                    dealii::TrilinosWrappers::MPI::Vector &solution) override
  {
    if (is_too_hard)
      return fallback->solve(matrix, right_hand_side, stiff_rows, relative_tolerance, solution);
    split_off(stiff_rows, matrix);
    const KSPConvergedReason reason =
        run(matrix, right_hand_side, is_split ? share_of_soft_rows * relative_tolerance : relative_tolerance,
            max_iterations, solution);
    if (is_indefinite(reason))
      return {};
    if (is_solved(reason))
      return n_iterations;
    is_too_hard = true;
    PetscSolver::forget_pattern();
    return fallback->solve(matrix, right_hand_side, stiff_rows, relative_tolerance, solution);
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
    PC preconditioner = nullptr;
    KSPGetPC(solver, &preconditioner);
    const MPI_Comm communicator = PetscObjectComm(reinterpret_cast<PetscObject>(solver));
    const bool is_alone = dealii::Utilities::MPI::n_mpi_processes(communicator) == 1;
    const PCType schwarz = is_alone ? PCBJACOBI : PCASM;
    // PETSc complains of options that nothing reads.
    const auto set_option = [](const std::string &option, const char *value)
    { PetscOptionsSetValue(nullptr, option.c_str(), value); };
    if (!is_split)
      PCSetType(preconditioner, schwarz);
    else
    {
      PCSetType(preconditioner, PCFIELDSPLIT);
      PCFieldSplitSetType(preconditioner, PC_COMPOSITE_ADDITIVE);
      add_field(preconditioner, "contact", stiff);
      add_field(preconditioner, "elements", soft);
      set_option("-fieldsplit_contact_pc_type", PCCHOLESKY);
      set_option("-fieldsplit_contact_pc_factor_mat_solver_type", MATSOLVERMUMPS);
      set_option("-fieldsplit_elements_pc_type", schwarz);
    }
    const std::string prefix = is_split ? "-fieldsplit_elements_" : "-";
    set_option(prefix + "sub_pc_type", "icc");
    if (!is_alone)
      set_option(prefix + "pc_asm_type", "basic"); // the symmetric one
    PCSetFromOptions(preconditioner);
  }

  static void add_field(PC split, const char *name, const std::vector<PetscInt> &rows)
  {
    Owned<IS, ISDestroy> indices;
    ISCreateGeneral(PetscObjectComm(reinterpret_cast<PetscObject>(split)), static_cast<PetscInt>(rows.size()),
                    rows.data(), PETSC_COPY_VALUES, &indices);
    PCFieldSplitSetIS(split, name, indices);
  }

  /// Keeps the preconditioner where the stiff rows are those of before (collective).
  void split_off(const dealii::IndexSet &stiff_rows, const dealii::TrilinosWrappers::SparseMatrix &matrix)
  {
    const MPI_Comm communicator = matrix.get_mpi_communicator();
    const std::vector<PetscInt> stiff_before =
        std::exchange(stiff, std::vector<PetscInt>(stiff_rows.begin(), stiff_rows.end()));
    if (dealii::Utilities::MPI::max(stiff != stiff_before ? 1 : 0, communicator) == 0)
      return;
    forget_preconditioner();
    dealii::IndexSet others = matrix.locally_owned_range_indices();
    others.subtract_set(stiff_rows);
    soft.assign(others.begin(), others.end());
    is_split = dealii::Utilities::MPI::max(stiff.size(), communicator) > 0 &&
               dealii::Utilities::MPI::max(soft.size(), communicator) > 0;
  }

  /// The first iteration takes the stiff rows' share of the residual away, so that what is left of it says
  /// less of the others: without this, Newton's method takes a third more iterations.
  static constexpr double share_of_soft_rows = 0.2;

  std::unique_ptr<LinearSolver> fallback;
  const int max_iterations;
  bool is_too_hard = false;
  bool is_split = false;             ///< whether any rank has stiff rows
  std::vector<PetscInt> stiff, soft; ///< rows owned here
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
