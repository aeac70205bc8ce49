#include "ingest/rotation_angles.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/SVD>
#include <numbers>
#include <random>

#include "reprise/model/kinematics.h"

namespace reprise {
namespace {

constexpr double pi = std::numbers::pi;

class AnglesOfAllOrders : public testing::TestWithParam<std::array<int, 3>> {
 protected:
  Eigen::Matrix3d product(const EulerAngles& angles) const {
    const auto& axes = GetParam();
    return axis_rotation(axes[0], angles[0]) * axis_rotation(axes[1], angles[1]) *
           axis_rotation(axes[2], angles[2]);
  }
};

TEST_P(AnglesOfAllOrders, BothWritingsAreTheRotation) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(-3 * pi, 3 * pi);
  for (int i = 0; i < 500; ++i) {
    const EulerAngles angles = {angle(random), angle(random), angle(random)};
    for (const EulerAngles& found : euler_angles(product(angles), GetParam(), {})) {
      ASSERT_LT((product(found) - product(angles)).norm(), 1e-9);
    }
  }
}

TEST_P(AnglesOfAllOrders, AnglesNextToThePreviousOnesAreFound) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> outer(-20, 20), middle(-1.4, 1.4), step(-0.05, 0.05);
  for (int i = 0; i < 500; ++i) {
    EulerAngles angles = {outer(random), middle(random), outer(random)};
    // The other writing has its middle angle beyond a right angle.
    if (i % 2 == 0) angles[1] = pi - angles[1];
    EulerAngles previous = angles;
    for (double& value : previous) value += step(random);
    const EulerAngles found = nearest_euler_angles(product(angles), GetParam(), previous);
    for (int k = 0; k < 3; ++k) ASSERT_NEAR(found[k], angles[k], 1e-6);
  }
}

TEST_P(AnglesOfAllOrders, ManyTurnsAreContinuous) {
  EulerAngles previous{};
  for (int f = 0; f < 2000; ++f) {
    const EulerAngles angles = {0.02 * f, 0.9 * std::sin(0.01 * f), -0.013 * f};
    previous = nearest_euler_angles(product(angles), GetParam(), previous);
    for (int k = 0; k < 3; ++k) ASSERT_NEAR(previous[k], angles[k], 1e-6) << f;
  }
}

TEST_P(AnglesOfAllOrders, GimbalLockStillGivesTheRotation) {
  for (const double off : {0.0, 1e-12, 1e-7, 1e-5, 1e-3}) {
    for (const double side : {-1.0, 1.0}) {
      const EulerAngles angles = {0.7, side * (pi / 2 - off), -1.9};
      const EulerAngles found =
          nearest_euler_angles(product(angles), GetParam(), {0.6, side * 1.5, -1.8});
      EXPECT_LT((product(found) - product(angles)).norm(), 1e-4) << off;
      EXPECT_NEAR(found[2], -1.9, 0.3);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Orders, AnglesOfAllOrders,
                         testing::Values(std::array{0, 1, 2}, std::array{0, 2, 1},
                                         std::array{1, 0, 2}, std::array{1, 2, 0},
                                         std::array{2, 0, 1}, std::array{2, 1, 0}));

Eigen::Matrix3d random_matrix(std::mt19937& random) {
  std::normal_distribution<double> number;
  Eigen::Matrix3d matrix;
  for (double& value : matrix.reshaped()) value = number(random);
  return matrix;
}

/// The largest trace that a proper rotation reaches, from the singular values.
double best_trace(const Eigen::Matrix3d& matrix) {
  const Eigen::Vector3d values = Eigen::JacobiSVD<Eigen::Matrix3d>(matrix).singularValues();
  return values[0] + values[1] + (matrix.determinant() < 0 ? -values[2] : values[2]);
}

void expect_nearest(const Eigen::Matrix3d& matrix) {
  const Eigen::Matrix3d found = nearest_rotation(matrix);
  ASSERT_LT((found.transpose() * found - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  ASSERT_GT(found.determinant(), 0);
  ASSERT_NEAR((found.transpose() * matrix).trace(), best_trace(matrix), 1e-9 * matrix.norm())
      << matrix;
}

TEST(NearestRotation, ReachesTheLargestTrace) {
  std::mt19937 random(3);
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Matrix3d matrix = random_matrix(random);
    expect_nearest(matrix);  // reflections among them
    expect_nearest(-matrix);
    expect_nearest(1e-6 * matrix);
    expect_nearest(1e6 * matrix);
  }
}

TEST(NearestRotation, TwoDirectionsAreEnough) {
  std::mt19937 random(4);
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Matrix3d from = random_matrix(random), to = random_matrix(random);
    expect_nearest(to.leftCols<2>() * from.leftCols<2>().transpose());
  }
}

TEST(NearestRotation, OneDirectionOrNoneStillGivesARotation) {
  std::mt19937 random(5);
  expect_nearest(Eigen::Matrix3d::Zero());
  expect_nearest(-Eigen::Matrix3d::Identity());
  for (int i = 0; i < 200; ++i) {
    const Eigen::Matrix3d from = random_matrix(random), to = random_matrix(random);
    expect_nearest(to.col(0) * from.col(0).transpose());
  }
}

}  // namespace
}  // namespace reprise
