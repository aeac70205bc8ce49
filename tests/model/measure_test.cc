// Measures against small cases worked out by hand.
#include "reprise/model/measure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "edited_motion.h"
#include "reprise/error.h"
#include "reprise/formats/motion_file.h"

namespace reprise {
namespace {

/// Joints of the given names, without channels.
Skeleton skeleton_of(const std::vector<std::string>& names) {
  Skeleton skeleton;
  for (const std::string& name : names) {
    Joint joint;
    joint.name = name;
    skeleton.joints.push_back(joint);
  }
  return skeleton;
}

/// One joint that goes along x with the given speed (mm/s) at a height of `y`.
PositionMatrix sliding(long frames, double rate, double speed, double y = 0) {
  PositionMatrix positions = PositionMatrix::Zero(frames, 3);
  for (long f = 0; f < frames; ++f) {
    positions(f, 0) = speed * static_cast<double>(f) / rate;
    positions(f, 1) = y;
  }
  return positions;
}

TEST(PositionErrors, AreOverAllJointsAndFrames) {
  const PositionMatrix original = PositionMatrix::Zero(2, 6);
  PositionMatrix decoded = original;
  decoded.row(0) << 3, 4, 0, 0, 0, 0;  // 5 and 0
  decoded.row(1) << 0, 0, 1, 2, 2, 1;  // 1 and 3
  const PositionErrors errors = position_errors(original, decoded);
  EXPECT_NEAR(errors.mean, 9.0 / 4, 1e-6);
  EXPECT_NEAR(errors.rms, std::sqrt(35.0 / 4), 1e-6);
  EXPECT_NEAR(errors.max, 5.0, 1e-6);
  // At 0.99 * 3 = 2.97 of the sorted 0, 1, 3, 5.
  EXPECT_NEAR(errors.p99, 3 + 0.97 * 2, 1e-6);
}

TEST(PositionErrors, PercentileLiesBetweenNeighbours) {
  std::vector<float> distances;
  for (int i = 200; i >= 0; --i) distances.push_back(static_cast<float>(i));
  EXPECT_NEAR(summarise_distances(distances).p99, 198.0, 1e-9);
  distances = {7};
  EXPECT_EQ(summarise_distances(distances).p99, 7.0);
  distances.clear();
  EXPECT_EQ(summarise_distances(distances).max, 0.0);
}

TEST(PositionErrors, CompareTheFramesThatBothHave) {
  const PositionMatrix original = PositionMatrix::Zero(5, 3);
  const PositionMatrix decoded = PositionMatrix::Ones(3, 3);
  EXPECT_EQ(joint_distances(original, decoded).size(), 3u);
  EXPECT_NEAR(position_errors(original, decoded).max, std::sqrt(3.0), 1e-6);
}

/// One joint with an x channel of 1 mm a unit.
Take take_of(const std::string& rows, int frames) {
  return read_bvh("HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 1 Xposition\n}\nMOTION\nFrames: " +
                      std::to_string(frames) + "\nFrame Time: 0.01\n" + rows,
                  "a.bvh", 1.0);
}

// The original moves by -1, 0, 1 about its mean: sqrt(2). The difference is 0, 0, 1.
TEST(CompareTakes, DIsRelativeToTheMotion) {
  const Comparison comparison = compare_takes(take_of("4\n5\n6\n", 3), take_of("4\n5\n7\n", 3));
  EXPECT_NEAR(comparison.d_percent, 100 / std::sqrt(2.0), 1e-9);
  EXPECT_EQ(comparison.frames, 3);
  EXPECT_EQ(comparison.missing_frames, 0);
  EXPECT_FALSE(comparison.foot_skate.has_value());
}

TEST(CompareTakes, DIsZeroWhereNothingMoves) {
  const Take still = take_of("0.1\n0.1\n0.1\n", 3), other = take_of("0.2\n0.2\n0.2\n", 3);
  EXPECT_EQ(compare_takes(still, other).d_percent, 0.0);
}

TEST(CompareTakes, CountsMissingFramesOnEitherSide) {
  EXPECT_EQ(compare_takes(take_of("1\n2\n3\n", 3), take_of("1\n", 1)).missing_frames, 2);
  EXPECT_EQ(compare_takes(take_of("1\n", 1), take_of("1\n2\n3\n", 3)).missing_frames, 2);
}

TEST(CompareTakes, OtherSkeletonsCannotBeCompared) {
  const Take two = read_bvh(
      "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 1 Xposition\nEnd Site\n{\nOFFSET 0 1 0\n}\n}\n"
      "MOTION\nFrames: 1\nFrame Time: 0.01\n1\n",
      "b.bvh");
  EXPECT_THROW(compare_takes(two, take_of("1\n", 1)), Error);
}

TEST(CompareTakes, JointsThatHangElsewhereCannotBeCompared) {
  const auto joint = [](const std::string& inside, const char* name) {
    return std::string(name) + "\n{\nOFFSET 0 1 0\nCHANNELS 1 Zrotation\n" + inside + "}\n";
  };
  const auto take = [](const std::string& joints) {
    return read_bvh("HIERARCHY\n" + joints + "MOTION\nFrames: 1\nFrame Time: 0.01\n1 2 3\n",
                    "a.bvh");
  };
  const Take chain = take(joint(joint(joint("", "JOINT c"), "JOINT b"), "ROOT a"));
  const Take fork = take(joint(joint("", "JOINT b") + joint("", "JOINT c"), "ROOT a"));
  EXPECT_THROW(compare_takes(chain, fork), Error);
  EXPECT_EQ(compare_takes(chain, chain).errors.max, 0.0);
}

TEST(CompareTakes, NoFramesAreNoComparison) {
  EXPECT_THROW(compare_takes(take_of("1\n", 1), take_of("", 0)), Error);
  EXPECT_THROW(compare_takes(take_of("", 0), take_of("1\n", 1)), Error);
}

TEST(FootSkate, IsTheSpeedDuringContact) {
  const auto skate =
      foot_skate(skeleton_of({"LeftFoot"}), sliding(50, 100, 40), sliding(50, 100, 90), 100);
  ASSERT_TRUE(skate.has_value());
  EXPECT_NEAR(skate->original, 40, 1e-9);
  EXPECT_NEAR(skate->decoded, 90, 1e-9);
}

TEST(FootSkate, HeightIsNoSpeed) {
  PositionMatrix bouncing = sliding(50, 100, 0);
  for (long f = 0; f < 50; ++f) bouncing(f, 1) = static_cast<double>(f % 2);
  const auto skate = foot_skate(skeleton_of({"toes"}), bouncing, bouncing, 100);
  ASSERT_TRUE(skate.has_value());
  EXPECT_EQ(skate->original, 0.0);
}

TEST(FootSkate, NeedsSlowFeetNearTheFloor) {
  const Skeleton one = skeleton_of({"AnkleL"});
  EXPECT_FALSE(foot_skate(one, sliding(50, 100, 151), sliding(50, 100, 0), 100).has_value());
  EXPECT_TRUE(foot_skate(one, sliding(50, 100, 149), sliding(50, 100, 0), 100).has_value());
  // The floor is where the lower foot is: the one 60 mm higher does not count.
  PositionMatrix feet(50, 6);
  feet << sliding(50, 100, 10), sliding(50, 100, 100, 60);
  const auto skate = foot_skate(skeleton_of({"FootL", "FootR"}), feet, feet, 100);
  ASSERT_TRUE(skate.has_value());
  EXPECT_NEAR(skate->original, 10, 1e-9);
}

TEST(FootSkate, NeedsFeetAndFrames) {
  const PositionMatrix still = sliding(50, 100, 0);
  EXPECT_FALSE(foot_skate(skeleton_of({"Hand"}), still, still, 100).has_value());
  EXPECT_FALSE(
      foot_skate(skeleton_of({"Foot"}), sliding(7, 30, 0), sliding(7, 30, 0), 30).has_value());
  EXPECT_TRUE(
      foot_skate(skeleton_of({"Foot"}), sliding(8, 30, 0), sliding(8, 30, 0), 30).has_value());
}

// Half of the 50 ms are 2.5 frames at 100 Hz; halves go to the even number, so 2 to each side: one
// jump of 4 mm in the middle is seen by 4 of the 46 frames as 4 mm in 40 ms.
TEST(FootSkate, SpeedsSpanFiftyMilliseconds) {
  PositionMatrix jump = sliding(50, 100, 0);
  jump.col(0).tail(25).setConstant(4);
  const auto skate = foot_skate(skeleton_of({"foot"}), jump, jump, 100);
  ASSERT_TRUE(skate.has_value());
  EXPECT_NEAR(skate->original, 4 * 100.0 / 46, 1e-9);
}

TEST(FootSkate, IsTheSameWhicheverAxisPointsUp) {
  for (const MotionFormat format : {MotionFormat::bvh, MotionFormat::asf_amc}) {
    const Take take = edited::synthetic_takes(1, 4, format)[0];
    Take other = take;
    other.channels.array() += 0.3;
    const auto expected = compare_takes(take, other).foot_skate;
    ASSERT_TRUE(expected);
    for (const UpAxis up : edited::every_up) {
      const auto read = [&](const Take& written) {
        return edited::with_skeleton(edited::turned(written, up),
                                     [&](Skeleton& skeleton) { skeleton.up = up; });
      };
      const auto skate = compare_takes(read(take), read(other)).foot_skate;
      ASSERT_TRUE(skate) << up_axis_name(up);
      EXPECT_NEAR(skate->original, expected->original, 1e-6) << up_axis_name(up);
      EXPECT_NEAR(skate->decoded, expected->decoded, 1e-6) << up_axis_name(up);
    }
  }
}

}  // namespace
}  // namespace reprise
