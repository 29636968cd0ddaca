// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <memory>
#include <string>
#include <vector>

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

  /// Returns the number of iterations, 1 for direct solvers. Throws NumericalError if it fails (on all
  /// ranks).
  virtual unsigned int solve(const dealii::TrilinosWrappers::SparseMatrix &matrix,
                             const dealii::TrilinosWrappers::MPI::Vector &right_hand_side,
                             dealii::TrilinosWrappers::MPI::Vector &solution) = 0;
  virtual std::string name() const = 0;
};

/// Sparse factorisation by MUMPS, through PETSc: Cholesky's, or LU.
std::unique_ptr<LinearSolver> make_direct_solver(Symmetry symmetry);

/// Conjugate gradients, or GMRES, with hypre's BoomerAMG, whose iteration counts do not grow with the contact
/// stiffness. `n_components`: of the displacement, numbered together at each node.
std::unique_ptr<LinearSolver> make_amg_solver(unsigned int n_components, double relative_tolerance,
                                              Symmetry symmetry);
} // namespace signorini
