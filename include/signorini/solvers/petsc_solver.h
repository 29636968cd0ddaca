// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/solvers/linear_solver.h"

#include <petscksp.h>

namespace signorini
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
  static bool is_indefinite(KSPConvergedReason reason);

  /// Returns why it ended.
  KSPConvergedReason run(const dealii::TrilinosWrappers::SparseMatrix &matrix,
                         const dealii::TrilinosWrappers::MPI::Vector &right_hand_side,
                         double relative_tolerance, int max_iterations,
                         dealii::TrilinosWrappers::MPI::Vector &solution);

  /// Keeps the matrix.
  void forget_preconditioner();

  const Symmetry symmetry;
  const Storage storage;
  unsigned int n_iterations = 0; ///< of the last run

private:
  /// Sets up a new solver.
  virtual void configure(KSP solver) const = 0;

  void make_system(const dealii::TrilinosWrappers::SparseMatrix &matrix);
  void set_values(const dealii::TrilinosWrappers::SparseMatrix &matrix);

  std::unique_ptr<PetscSystem> system;
};
} // namespace signorini
