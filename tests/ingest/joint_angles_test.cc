#include "ingest/joint_angles.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace reprise
