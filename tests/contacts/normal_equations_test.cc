// Small systems against Eigen's solution of the same least squares.
#include "contacts/normal_equations.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <vector>

namespace reprise {
namespace {

using Eigen::Vector3d;

TEST(NormalEquations, AgreeWithEigenForAnySize) {
  std::srand(5);
  for (std::size_t unknowns = 1; unknowns <= NormalEquations::most_unknowns; ++unknowns) {
    NormalEquations equations(unknowns);
    const auto count = static_cast<Eigen::Index>(unknowns);
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(count, count);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
    for (std::size_t i = 0; i < unknowns; ++i) {
      equations.add(i, 0.5, static_cast<double>(i));
      matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i)) += 0.5;
      right[static_cast<Eigen::Index>(i)] += 0.5 * static_cast<double>(i);
    }
    // The second vector equation is of every other unknown.
    for (const std::size_t step : {1u, 2u}) {
      const double weight = 3.0 / static_cast<double>(step);
      const Vector3d value = Vector3d::Random();
      std::vector<std::size_t> members;
      std::vector<Vector3d> columns;
      Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(3, count);
      for (std::size_t i = 0; i < unknowns; i += step) {
        members.push_back(i);
        columns.emplace_back(Vector3d::Random());
        jacobian.col(static_cast<Eigen::Index>(i)) = columns.back();
      }
      equations.add<Vector3d>(members, columns, weight, value);
      matrix += weight * jacobian.transpose() * jacobian;
      right += weight * jacobian.transpose() * value;
    }
    const Eigen::VectorXd expected = matrix.ldlt().solve(right);
    const auto found = equations.solve();
    for (std::size_t i = 0; i < unknowns; ++i)
      EXPECT_NEAR(found[i], expected[static_cast<Eigen::Index>(i)], 1e-10) << unknowns;
  }
}

}  // namespace
}  // namespace reprise
