// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/solvers/largest_eigenvalue.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

namespace signorini
{
namespace
{
void expect_largest(const Eigen::MatrixXd &matrix)
{
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> all(matrix, Eigen::EigenvaluesOnly);
  EXPECT_NEAR(find_largest_eigenvalue(matrix), all.eigenvalues()[matrix.rows() - 1], 1e-13 * matrix.norm());
}

TEST(LargestEigenvalue, OfAnyMatrix)
{
  for (const Eigen::Index n : {1, 2, 3, 8, 24, 81})
    for (int k = 0; k < 20; ++k)
    {
      const Eigen::MatrixXd root = Eigen::MatrixXd::Random(n, n);
      expect_largest(root * root.transpose());
      expect_largest(1e12 * (root + root.transpose()));
      expect_largest(-root * root.transpose());
    }
}

TEST(LargestEigenvalue, OfThoseThatCoincideOrVanish)
{
  for (const Eigen::Index n : {1, 2, 24})
  {
    expect_largest(3. * Eigen::MatrixXd::Identity(n, n));
    expect_largest(Eigen::MatrixXd::Zero(n, n));
    expect_largest(Eigen::VectorXd::LinSpaced(n, -5., -1.).asDiagonal());
    expect_largest(1e-9 * Eigen::MatrixXd::Ones(n, n)); // all others are 0
  }
}
} // namespace
} // namespace signorini
