// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/solvers/linear_solver.h"

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <petscsys.h>

#include <cmath>
#include <limits>
#include <tuple>
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
                   double tolerance = 1e-10,
                   const dealii::IndexSet &stiff_rows = dealii::IndexSet(n_unknowns),
                   unsigned int *n_iterations = nullptr)
{
  dealii::TrilinosWrappers::MPI::Vector b(owned_unknowns(), MPI_COMM_WORLD), x(b), rest(b);
  for (const auto i : owned_unknowns())
    b[i] = 1. + 0.1 * static_cast<double>(i % 7);
  b.compress(dealii::VectorOperation::insert);
  const std::optional<unsigned int> n = solver.solve(matrix, b, stiff_rows, tolerance, x);
  if (!n)
    return std::numeric_limits<double>::quiet_NaN();
  if (n_iterations)
    *n_iterations = *n;
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
                                    const dealii::IndexSet &stiff_rows, double relative_tolerance,
                                    dealii::TrilinosWrappers::MPI::Vector &solution) override
  {
    ++n_solves;
    return direct->solve(matrix, right_hand_side, stiff_rows, relative_tolerance, solution);
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

/// As contact between distant rows: springs of `stiffness` tie each row from `begin` to `end` to three
/// others.
dealii::TrilinosWrappers::SparseMatrix make_tied_matrix(unsigned int begin, unsigned int end,
                                                        double stiffness)
{
  const dealii::IndexSet owned = owned_unknowns();
  const auto for_each_entry = [&](const auto &visit)
  {
    for (int i = 0; i < static_cast<int>(n_unknowns); ++i)
      for (const int k : {i - 30, i - 1, i, i + 1, i + 30})
        if (k >= 0 && k < static_cast<int>(n_unknowns))
          visit(i, k, i == k ? 4.01 : -1.);
    for (unsigned int i = begin; i < end; ++i)
      for (const unsigned int distance : {0, 1, 2})
      {
        const unsigned int k = n_unknowns - 1 - begin - (i - begin + distance) % (end - begin);
        for (const auto &[row, column, sign] : {std::make_tuple(i, i, 1.), std::make_tuple(k, k, 1.),
                                                std::make_tuple(i, k, -1.), std::make_tuple(k, i, -1.)})
          visit(row, column, sign * stiffness * (1. + 0.1 * distance));
      }
  };
  dealii::TrilinosWrappers::SparsityPattern pattern(owned, owned, MPI_COMM_WORLD);
  for_each_entry(
      [&](auto i, auto k, double)
      {
        if (owned.is_element(i))
          pattern.add(i, k);
      });
  pattern.compress();
  dealii::TrilinosWrappers::SparseMatrix matrix;
  matrix.reinit(pattern);
  for_each_entry(
      [&](auto i, auto k, double value)
      {
        if (owned.is_element(i))
          matrix.add(i, k, value);
      });
  matrix.compress(dealii::VectorOperation::add);
  return matrix;
}

TEST(LinearSolver, FactorsOfStiffRowsMakeStiffnessCheap)
{
  // Rows at both ends: with three ranks, 400 are all that the first and the last one own.
  unsigned int n_solves_of_other = 0;
  const auto solver = make_schwarz_solver(std::make_unique<CountingSolver>(n_solves_of_other), 75);
  const auto n_iterations = [&](unsigned int end, double stiffness, bool are_stiff_rows_told)
  {
    dealii::IndexSet stiff_rows(n_unknowns);
    if (are_stiff_rows_told)
    {
      stiff_rows.add_range(0, end);
      stiff_rows.add_range(n_unknowns - end, n_unknowns);
    }
    unsigned int n = 0;
    solver->forget_pattern();
    EXPECT_LT(
        residual_of(*solver, make_tied_matrix(0, end, stiffness), 1e-12, stiff_rows & owned_unknowns(), &n),
        1e-8 * stiffness)
        << end << " rows, stiffness " << stiffness;
    return n;
  };
  for (const unsigned int end : {100u, 400u})
  {
    const unsigned int n_soft = n_iterations(end, 1., true);
    EXPECT_LT(n_iterations(end, 1e6, true), 2 * n_soft + 10) << end << " rows";
  }
  EXPECT_EQ(n_solves_of_other, 0u);
  n_iterations(100, 1e6, false);
  EXPECT_EQ(n_solves_of_other, 1u) << "incomplete factors alone do not solve such a system";
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
