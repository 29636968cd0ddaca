// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/solvers/linear_solver.h"

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <petscsys.h>

#include <cmath>
#include <limits>
#include <vector>

namespace signorini
{
namespace
{
constexpr unsigned int n_unknowns = 900;

dealii::IndexSet owned_unknowns()
{
  return dealii::Utilities::MPI::create_evenly_distributed_partitioning(MPI_COMM_WORLD, n_unknowns);
}

/// `diagonal` on the diagonal, -1 beside it and at the distance `width` of it: so wide that factors fill in.
dealii::TrilinosWrappers::SparseMatrix make_matrix(double diagonal, int width)
{
  const dealii::IndexSet owned = owned_unknowns();
  dealii::TrilinosWrappers::SparsityPattern pattern(owned, owned, MPI_COMM_WORLD);
  const auto for_each_entry = [&](const auto &visit)
  {
    for (const auto i : owned)
      for (const int distance : {-width, -1, 0, 1, width})
        if (const int k = static_cast<int>(i) + distance; k >= 0 && k < static_cast<int>(n_unknowns))
          visit(i, k, distance == 0 ? diagonal : -1.);
  };
  for_each_entry([&](auto i, auto k, double) { pattern.add(i, k); });
  pattern.compress();
  dealii::TrilinosWrappers::SparseMatrix matrix;
  matrix.reinit(pattern);
  for_each_entry([&](auto i, auto k, double value) { matrix.set(i, k, value); });
  matrix.compress(dealii::VectorOperation::insert);
  return matrix;
}

/// Relative to the right hand side; NaN if the solver found the matrix not positive definite.
double residual_of(LinearSolver &solver, const dealii::TrilinosWrappers::SparseMatrix &matrix,
                   double tolerance = 1e-10)
{
  dealii::TrilinosWrappers::MPI::Vector b(owned_unknowns(), MPI_COMM_WORLD), x(b), rest(b);
  for (const auto i : owned_unknowns())
    b[i] = 1. + 0.1 * static_cast<double>(i % 7);
  b.compress(dealii::VectorOperation::insert);
  if (!solver.solve(matrix, b, tolerance, x))
    return std::numeric_limits<double>::quiet_NaN();
  return matrix.residual(rest, x, b) / b.l2_norm();
}

std::vector<std::unique_ptr<LinearSolver>> make_all()
{
  std::vector<std::unique_ptr<LinearSolver>> all;
  all.push_back(make_direct_solver(Symmetry::symmetric));
  all.push_back(make_direct_solver(Symmetry::unsymmetric));
  all.push_back(make_amg_solver(3, Symmetry::symmetric));
  all.push_back(make_amg_solver(3, Symmetry::unsymmetric));
  all.push_back(make_schwarz_solver(make_amg_solver(3, Symmetry::symmetric)));
  return all;
}

/// Counts what it is asked for.
struct CountingSolver : LinearSolver
{
  explicit CountingSolver(unsigned int &counter) : n_solves(counter) {}
  std::optional<unsigned int> solve(const dealii::TrilinosWrappers::SparseMatrix &matrix,
                                    const dealii::TrilinosWrappers::MPI::Vector &right_hand_side,
                                    double relative_tolerance,
                                    dealii::TrilinosWrappers::MPI::Vector &solution) override
  {
    ++n_solves;
    return direct->solve(matrix, right_hand_side, relative_tolerance, solution);
  }
  void forget_pattern() override { direct->forget_pattern(); }
  std::string name() const override { return "counting"; }

  unsigned int &n_solves;
  std::unique_ptr<LinearSolver> direct = make_direct_solver(Symmetry::symmetric);
};

/// Those by conjugate gradients.
std::vector<std::unique_ptr<LinearSolver>> make_gradient_solvers()
{
  std::vector<std::unique_ptr<LinearSolver>> some;
  some.push_back(make_amg_solver(3, Symmetry::symmetric));
  some.push_back(make_schwarz_solver(make_amg_solver(3, Symmetry::symmetric)));
  return some;
}

TEST(LinearSolver, OneSystemAfterAnotherOfTheSameAndOfOtherPatterns)
{
  for (const auto &solver : make_all())
  {
    EXPECT_LT(residual_of(*solver, make_matrix(4.5, 30)), 1e-9) << solver->name();
    EXPECT_LT(residual_of(*solver, make_matrix(7., 30)), 1e-9) << solver->name();
    solver->forget_pattern();
    EXPECT_LT(residual_of(*solver, make_matrix(5., 20)), 1e-9) << solver->name();
  }
}

TEST(LinearSolver, BlocksReadTheirOptions)
{
  const auto solver = make_schwarz_solver(make_direct_solver(Symmetry::symmetric));
  EXPECT_LT(residual_of(*solver, make_matrix(4.5, 30)), 1e-9);
  PetscBool is_read = PETSC_FALSE;
  PetscOptionsUsed(nullptr, "sub_pc_type", &is_read); // the name without the dash
  EXPECT_TRUE(is_read);
}

TEST(LinearSolver, AsExactAsIsAsked)
{
  for (const auto &solver : make_gradient_solvers())
  {
    const auto matrix = make_matrix(4.001, 30);
    const double coarse = residual_of(*solver, matrix, 0.1), fine = residual_of(*solver, matrix, 1e-12);
    EXPECT_GT(coarse, 1e3 * fine) << solver->name();
    EXPECT_LT(fine, 1e-10) << solver->name();
  }
}

TEST(LinearSolver, SaysWhereAMatrixIsNotPositiveDefinite)
{
  for (const auto &solver : make_gradient_solvers())
  {
    EXPECT_TRUE(std::isnan(residual_of(*solver, make_matrix(2., 30)))) << solver->name();
    EXPECT_LT(residual_of(*solver, make_matrix(4.5, 30)), 1e-9) << solver->name();
  }
}

TEST(LinearSolver, AfterTooManyIterationsAnotherTakesOver)
{
  unsigned int n_solves_of_other = 0;
  const auto solver = make_schwarz_solver(std::make_unique<CountingSolver>(n_solves_of_other), 30);
  EXPECT_LT(residual_of(*solver, make_matrix(4.5, 30)), 1e-9);
  EXPECT_EQ(n_solves_of_other, 0u);
  EXPECT_LT(residual_of(*solver, make_matrix(4.0001, 30)), 1e-9);
  EXPECT_EQ(n_solves_of_other, 1u);
  EXPECT_LT(residual_of(*solver, make_matrix(4.5, 30)), 1e-9) << "the other solves from then on";
  EXPECT_EQ(n_solves_of_other, 2u);
}
} // namespace
} // namespace signorini
