// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <deal.II/base/index_set.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <memory>
#include <optional>
#include <string>

namespace signorini
{
/// Whether a matrix is its own transpose.
enum class Symmetry
{
  symmetric,
  unsymmetric
};

/// Solves A x = b.
class LinearSolver
{
public:
  virtual ~LinearSolver() = default;

  /// Solves until the residual r = b − A x has fallen to `relative_tolerance` of that of x = 0, in the norm
  /// that the solver measures it in; factorisations to round-off. Returns the number of iterations, 1 for
  /// factorisations; nothing where conjugate gradients met a direction in which a matrix said to be symmetric
  /// is not positive definite (on all ranks). Throws NumericalError if it fails (on all ranks).
  /// `stiff_rows`: those owned here that contact makes stiffer than the elements do; a matter of speed alone.
  virtual std::optional<unsigned int> solve(const dealii::TrilinosWrappers::SparseMatrix &matrix,
                                            const dealii::TrilinosWrappers::MPI::Vector &right_hand_side,
                                            const dealii::IndexSet &stiff_rows, double relative_tolerance,
                                            dealii::TrilinosWrappers::MPI::Vector &solution) = 0;

  /// Must be called before a matrix with another sparsity pattern is solved with.
  virtual void forget_pattern() = 0;

  virtual std::string name() const = 0;
};

/// Sparse factorisation by MUMPS, through PETSc: Cholesky's, or LU.
std::unique_ptr<LinearSolver> make_direct_solver(Symmetry symmetry);

/// Conjugate gradients, or GMRES, with hypre's BoomerAMG, whose iteration counts do not grow with the contact
/// stiffness. `n_components`: of the displacement, numbered together at each node.
std::unique_ptr<LinearSolver> make_amg_solver(unsigned int n_components, Symmetry symmetry);

/// Conjugate gradients, until (rᵀ M⁻¹ r)^½ is small, with incomplete factorisations M (Cholesky's, no fill)
/// of the ranks' parts of the matrix, which overlap by one layer; where there are stiff rows, of the others,
/// beside MUMPS's factorisation of the stiff ones (doc/theory.md, section 9). Three to five times faster than
/// multigrid for contact of bulky bodies of up to 100 000 unknowns (doc/theory.md, section 9). From the first
/// system on that takes more than `max_iterations`, as of slender bodies, `fallback` solves in its place. 500
/// of them cost about what sixty of multigrid's do, as many as it takes for contact of bulky bodies.
std::unique_ptr<LinearSolver> make_schwarz_solver(std::unique_ptr<LinearSolver> fallback,
                                                  int max_iterations = 500);
} // namespace signorini
