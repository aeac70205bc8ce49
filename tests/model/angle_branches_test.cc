#include "model/angle_branches.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "model/rotation_distance.h"
#include "reprise/formats/motion_file.h"
#include "reprise/model/kinematics.h"

namespace reprise {
namespace {

/// One joint with the three rotations in some order.
std::shared_ptr<const Skeleton> one_joint(const std::string& rotations) {
  const std::string text = "HIERARCHY\nROOT body\n{\nOFFSET 0 0 0\nCHANNELS 3 " + rotations +
                           "\nEnd Site\n{\nOFFSET 0 20 0\n}\n}\n";
  return std::make_shared<Skeleton>(read_bvh_skeleton(text, "joint.bvh", 10));
}

double greatest_step(const ChannelMatrix& channels) {
  if (channels.rows() < 2) return 0;
  const auto rows = channels.rows() - 1;
  return (channels.bottomRows(rows) - channels.topRows(rows)).cwiseAbs().maxCoeff();
}

/// Smooth angles are the same rotations, and come back as they were.
std::vector<AngleBranch> expect_round_trip(const Skeleton& skeleton, const ChannelMatrix& source) {
  ChannelMatrix channels = source;
  const ChannelConstants constants = find_constants(skeleton, source);
  const std::vector<AngleBranch> branches = smooth_angles(skeleton, constants, channels);
  for (Eigen::Index f = 0; f < source.rows(); ++f) {
    const auto turn = [&](const ChannelMatrix& of) {
      return local_rotation(skeleton.joints.front(),
                            {of.row(f).data(), static_cast<std::size_t>(of.cols())});
    };
    EXPECT_LT(degrees_between(turn(source), turn(channels)), 1e-5) << "frame " << f;
  }
  restore_angles(skeleton, branches, channels);
  EXPECT_LT((channels - source).cwiseAbs().maxCoeff(), 1e-9);
  return branches;
}

TEST(AngleBranches, ATurnThatWrapsIsSmooth) {
  const auto skeleton = one_joint("Zrotation Xrotation Yrotation");
  for (int axis = 0; axis < 3; ++axis) {
    ChannelMatrix wrapped = ChannelMatrix::Zero(400, 3);
    for (Eigen::Index f = 0; f < 400; ++f) {
      const double angle = 5.0 * static_cast<double>(f);
      wrapped(f, axis) = angle - 360 * std::round(angle / 360);
    }
    ChannelMatrix smooth = wrapped;
    smooth_angles(*skeleton, find_constants(*skeleton, wrapped), smooth);
    EXPECT_LT(greatest_step(smooth), 5.001);
    EXPECT_EQ(expect_round_trip(*skeleton, wrapped).size(), 6u);
  }
}

/// Angles whose middle one is kept within a quarter turn jump where the rotation passes it.
TEST(AngleBranches, APassageThroughGimbalLockIsSmooth) {
  for (const char* order : {"Zrotation Xrotation Yrotation", "Xrotation Yrotation Zrotation"}) {
    const auto skeleton = one_joint(order);
    ChannelMatrix channels(200, 3);
    for (Eigen::Index f = 0; f < 200; ++f) {
      const double middle = static_cast<double>(f);
      channels.row(f) << 10, middle, -20;
      if (middle > 90) channels.row(f) << -170, 180 - middle, 160;
    }
    ChannelMatrix smooth = channels;
    smooth_angles(*skeleton, find_constants(*skeleton, channels), smooth);
    EXPECT_LT(greatest_step(smooth), 1.001) << order;
    EXPECT_EQ(expect_round_trip(*skeleton, channels).size(), 1u);
  }
}

TEST(AngleBranches, MotionIsLeftAlone) {
  const auto skeleton = one_joint("Zrotation Xrotation Yrotation");
  std::mt19937 random(4);
  std::normal_distribution<double> step(0, 10);
  ChannelMatrix channels = ChannelMatrix::Zero(500, 3);
  for (Eigen::Index f = 1; f < 500; ++f) {
    for (int c = 0; c < 3; ++c) channels(f, c) = channels(f - 1, c) + step(random);
  }
  EXPECT_TRUE(expect_round_trip(*skeleton, channels).empty());
}

TEST(AngleBranches, NoiseKeepsItsAngles) {
  const auto skeleton = one_joint("Zrotation Xrotation Yrotation");
  std::mt19937 random(4);
  std::uniform_real_distribution<double> any(-180, 180);
  ChannelMatrix channels(300, 3);
  for (double& value : channels.reshaped()) value = any(random);
  ChannelMatrix smooth = channels;
  EXPECT_TRUE(smooth_angles(*skeleton, find_constants(*skeleton, channels), smooth).empty());
  EXPECT_TRUE(smooth == channels);
}

TEST(AngleBranches, AConstantAngleStaysConstant) {
  const auto skeleton = one_joint("Zrotation Xrotation Yrotation");
  ChannelMatrix channels(100, 3);
  for (Eigen::Index f = 0; f < 100; ++f) {
    const double turn = 7.0 * static_cast<double>(f);
    channels.row(f) << 30, f < 50 ? 0 : 180, turn - 360 * std::round(turn / 360);
  }
  ChannelMatrix smooth = channels;
  smooth_angles(*skeleton, find_constants(*skeleton, channels), smooth);
  EXPECT_TRUE((smooth.col(0).array() == 30).all());
}

}  // namespace
}  // namespace reprise
