// Facts that other readers of these formats learned the hard way.
#include <gtest/gtest.h>

#include "formats/samples.h"
#include "reprise/error.h"
#include "reprise/formats/motion_file.h"
#include "reprise/model/kinematics.h"

namespace reprise {
namespace {

Take sample() { return read_bvh(plain_bvh(), "sample.bvh"); }

Take asf_sample() {
  return read_amc(plain_amc(), "s.amc", std::make_shared<Skeleton>(read_asf(plain_asf(), "s.asf")));
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST(Facts, ChannelCountsDifferAndPositionsOfInnerJointsCount) {
  const Take take = sample();
  const auto& joints = take.skeleton->joints;
  ASSERT_EQ(joints.size(), 4u);
  EXPECT_EQ(joints[1].channels.size(), 3u);
  EXPECT_EQ(joints[3].channels.size(), 6u);
  const PositionMatrix places = joint_positions(*take.skeleton, take.channels);
  Take moved = take;
  moved.channels(1, joints[3].first_channel) += 1;
  EXPECT_NEAR((joint_positions(*moved.skeleton, moved.channels) - places).row(1).norm(), 10.0,
              1e-9);
}

TEST(Facts, RotationOrderIsEachJointsOwn) {
  const Take take = sample();
  EXPECT_EQ(take.skeleton->joints[0].rotation_order, (std::vector<int>{2, 0, 1}));
  EXPECT_EQ(take.skeleton->joints[1].rotation_order, (std::vector<int>{2, 1, 0}));
}

TEST(Facts, OrderOfRotationsChangesWhereJointsAre) {
  const std::string other = replaced(plain_bvh(), "CHANNELS 3 Zrotation Yrotation Xrotation",
                                     "CHANNELS 3 Xrotation Yrotation Zrotation");
  const Take one = sample(), two = read_bvh(other, "other.bvh");
  EXPECT_GT(
      (joint_positions(*one.skeleton, one.channels) - joint_positions(*two.skeleton, two.channels))
          .norm(),
      1.0);
}

TEST(Facts, FrameRateIsRead) {
  EXPECT_NEAR(sample().frame_rate, 120.0, 0.001);
  EXPECT_FALSE(sample().frame_rate_assumed);
  const Take slow = read_bvh(replaced(plain_bvh(), "0.0083333", "0.04"), "s.bvh");
  EXPECT_NEAR(slow.frame_rate, 25.0, 1e-9);
}

TEST(Facts, AmcHasNoFrameRate) {
  const auto skeleton = std::make_shared<Skeleton>(read_asf(plain_asf(), "s.asf"));
  const Take assumed = read_amc(plain_amc(), "s.amc", skeleton);
  EXPECT_EQ(assumed.frame_rate, 120.0);
  EXPECT_TRUE(assumed.frame_rate_assumed);
  const Take told = read_amc(plain_amc(), "s.amc", skeleton, 60.0);
  EXPECT_EQ(told.frame_rate, 60.0);
  EXPECT_FALSE(told.frame_rate_assumed);
}

TEST(Facts, AsfSectionsAndOrdersAreFree) {
  const std::string text = plain_asf();
  const std::size_t root = text.find(":root"), bones = text.find(":bonedata"),
                    tree = text.find(":hierarchy");
  const std::string shuffled = text.substr(0, root) + text.substr(bones, tree - bones) +
                               text.substr(root, bones - root) + text.substr(tree);
  EXPECT_TRUE(same_structure(read_asf(text, "a"), read_asf(shuffled, "b")));
  const Take take = asf_sample();
  // `axis` says how axes are turned, `dof` in which order values come.
  EXPECT_EQ(take.skeleton->joints[0].rotation_order, (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(take.skeleton->joints[1].rotation_order, (std::vector<int>{2, 1, 0}));
  EXPECT_EQ(take.skeleton->joints[1].channels[0], Channel::y_rotation);
}

TEST(Facts, BonesEndWhereDirectionAndLengthSay) {
  Take take = asf_sample();
  take.channels.setZero();
  const PositionMatrix places = joint_positions(*take.skeleton, take.channels);
  const double mm = 25.4 / 0.45;
  EXPECT_NEAR(places(0, 0), 1 * mm, 1e-9);
  EXPECT_NEAR(places(0, 3), (1 + 0.34 * 7.5) * mm, 1e-9);
  EXPECT_NEAR(places(0, 4), (2 - 0.94 * 7.5) * mm, 1e-9);
}

TEST(Facts, DegreesAndUnitsNeedNotBeSaid) {
  const auto skeleton = std::make_shared<Skeleton>(read_asf(plain_asf(), "s.asf"));
  const Take bare = read_amc(replaced(plain_amc(), ":DEGREES\n", ""), "s.amc", skeleton);
  EXPECT_EQ(bare.channels, asf_sample().channels);
  EXPECT_EQ(read_asf(odd_asf(), "s.asf").millimetres_per_unit, 25.4);
}

TEST(Facts, LimitsOfBonesGoOnOverLines) {
  const Skeleton skeleton = read_asf(plain_asf(), "s.asf");
  ASSERT_EQ(skeleton.joints.size(), 5u);
  EXPECT_EQ(skeleton.joints[1].name, "femur");
  EXPECT_EQ(skeleton.joints[1].channels.size(), 3u);
}

TEST(Facts, RootOfAnAsfStartsWhereItSays) {
  const std::string turned = replaced(plain_asf(), "orientation 0 0 0", "orientation 0 0 90");
  const Skeleton skeleton = read_asf(turned, "s.asf");
  EXPECT_EQ(skeleton.joints[0].offset, Eigen::Vector3d(1, 2, 3));
  EXPECT_NEAR((skeleton.joints[0].axis.col(0) - Eigen::Vector3d::UnitY()).norm(), 0, 1e-12);
}

TEST(Facts, FrameTimeMayHaveTabs) {
  const std::string tabs = replaced(plain_bvh(), "Frame Time: ", "Frame\tTime:\t");
  EXPECT_EQ(read_bvh(tabs, "s").frame_rate, sample().frame_rate);
}

TEST(Facts, FrameTimeKeepsItsText) {
  EXPECT_NE(write_motion(sample()).find("Frame Time: 0.0083333\n"), std::string::npos);
  const std::string exact = replaced(plain_bvh(), "0.0083333", "8.333333333e-3");
  EXPECT_NE(write_motion(read_bvh(exact, "s")).find("Frame Time: 8.333333333e-3\n"),
            std::string::npos);
}

TEST(Facts, MillisecondsAreNoSeconds) {
  EXPECT_EQ(read_bvh(replaced(plain_bvh(), "0.0083333", "1"), "s").frame_rate, 1.0);
  for (const char* milliseconds : {"4.1667", "8.3333", "33.3333"}) {
    EXPECT_THROW(read_bvh(replaced(plain_bvh(), "0.0083333", milliseconds), "s"), Error);
  }
}

TEST(Facts, AnAmcMaySayItsRate) {
  const auto skeleton = std::make_shared<Skeleton>(read_asf(plain_asf(), "s.asf"));
  const std::string text = replaced(plain_amc(), ":DEGREES", ":DEGREES\n:SAMPLES-PER-SECOND 60");
  const Take said = read_amc(text, "s.amc", skeleton);
  EXPECT_EQ(said.frame_rate, 60.0);
  EXPECT_FALSE(said.frame_rate_assumed);
  EXPECT_EQ(read_amc(text, "s.amc", skeleton, 30.0).frame_rate, 30.0);
  EXPECT_TRUE(asf_sample().frame_rate_assumed);
  const std::string odd = replaced(text, "SECOND 60", "SECOND -1");
  EXPECT_THROW(read_amc(odd, "s.amc", skeleton), Error);
  EXPECT_EQ(read_amc(odd, "s.amc", skeleton, 30.0).frame_rate, 30.0);
}

TEST(Facts, UnitsMayStandOnOneLine) {
  const Skeleton usual = read_asf(plain_asf(), "s.asf");
  const std::string lines = ":units\n  mass 1\n  length 0.45\n  angle deg\n";
  for (const char* line :
       {":units mass 1 length 0.45 angle deg\n", ":units\n mass 1 length 0.45 angle deg\n"}) {
    const Skeleton skeleton = read_asf(replaced(plain_asf(), lines, line), "s.asf");
    EXPECT_EQ(skeleton.millimetres_per_unit, usual.millimetres_per_unit);
  }
}

// Six decimals of a kilometre are a millimetre, and of a radian 0.00006 degrees.
TEST(Facts, LargeUnitsAndRadiansHaveMoreDecimals) {
  Take take = read_bvh(plain_bvh(), "s.bvh", 1e6);
  take.channels.array() += 1.0 / 3;
  const Take again = read_bvh(write_bvh(take), "s.bvh", 1e6);
  EXPECT_LT((again.channels - take.channels).cwiseAbs().maxCoeff() * 1e6, 1e-3 / 15);
  EXPECT_NE(write_bvh(sample()).find(" -179.500000 "), std::string::npos);

  Take radians = asf_sample();
  radians.layout.radians = true;
  radians.layout.amc_header = ":RADIANS\n";
  for (const int joint : radians.layout.amc_joints) {
    const Joint& written = radians.skeleton->joints[static_cast<std::size_t>(joint)];
    radians.channels
        .middleCols(written.first_channel, static_cast<Eigen::Index>(written.channels.size()))
        .array() += 1.0 / 3;
  }
  const Take read = read_amc(write_amc(radians), "s.amc", radians.skeleton);
  EXPECT_LT((read.channels - radians.channels).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(Facts, LineEndsNamesAndEmptyJoints) {
  for (const char* end : {"\n", "\r\n", "\r"}) {
    const Take take = read_bvh(with_line_ends(plain_bvh(), end), "s.bvh");
    EXPECT_EQ(take.frames(), 3);
    EXPECT_EQ(take.skeleton->joints[1].name, "Left Up Leg");
    EXPECT_TRUE(take.skeleton->joints[2].end_site);
    EXPECT_EQ(take.skeleton->joints[3].name, "empty");
  }
}

TEST(Facts, NamesMayRepeatAndStatementsShareALine) {
  const Take take = read_bvh(odd_bvh(), "odd.bvh");
  const auto& joints = take.skeleton->joints;
  ASSERT_EQ(joints.size(), 4u);
  EXPECT_EQ(joints[0].name, "a b");
  EXPECT_EQ(joints[1].name, "twin");
  EXPECT_TRUE(joints[2].end_site);
  EXPECT_EQ(joints[3].name, "twin");
  EXPECT_EQ(joints[3].parent, 0);
  EXPECT_EQ(joints[0].offset, Eigen::Vector3d(0, 5, -0.25));
  EXPECT_EQ(joints[3].rotation_order, (std::vector<int>{2, 1, 0}));
  EXPECT_EQ(take.channels(1, 17), 18.5);
}

TEST(Facts, FramesThatAreMissingAreNotInvented) {
  EXPECT_THROW(read_bvh(replaced(plain_bvh(), "Frames: 3", "Frames: 4"), "s.bvh"), Error);
  for (const char* count : {"Frames: 2", "Frames: 0"}) {
    EXPECT_EQ(read_bvh(replaced(plain_bvh(), "Frames: 3", count), "s.bvh").frames(), 3) << count;
  }
}

TEST(Facts, NumbersOfEveryStyle) {
  const Take take = sample();
  EXPECT_EQ(take.channels(0, 0), 0.34);
  EXPECT_EQ(take.channels(0, 1), 4.56e-2);
  EXPECT_EQ(take.channels(0, 2), 1e5);
  EXPECT_EQ(take.channels(0, 4), 1.0);
  EXPECT_EQ(asf_sample().channels(0, 10), 0.5);
}

TEST(Facts, StrictReadersTakeWhatIsWritten) {
  const std::string text = write_motion(sample());
  // One line a frame, one space between numbers, none at the ends, no empty line.
  EXPECT_EQ(text.find("\n\n"), std::string::npos);
  const std::string rows = text.substr(text.find("Frame Time"));
  EXPECT_EQ(rows.find(" \n"), std::string::npos);
  EXPECT_EQ(rows.find("  "), std::string::npos);
  EXPECT_NE(text.find("MOTION\nFrames: 3\n"), std::string::npos);
}

TEST(Facts, ErrorsPointAtTheirLine) {
  try {
    read_bvh(replaced(plain_bvh(), "1 2 3 4 5 6 7 8 9 10 11 12 13 14 15", "1 2 3"), "s.bvh");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.place().line, 25u);
  }
}

TEST(Facts, FrameTimeOfZeroIsAssumed) {
  const Take take = read_bvh(replaced(plain_bvh(), "0.0083333", "0"), "s.bvh");
  EXPECT_EQ(take.frame_rate, 60.0);
  EXPECT_TRUE(take.frame_rate_assumed);
  EXPECT_EQ(take.layout.frame_time_text, "0");
}

TEST(Facts, ClaimsAreNotAllocated) {
  EXPECT_THROW(read_bvh(replaced(plain_bvh(), "Frames: 3", "Frames: 999999999999"), "s.bvh"),
               Error);
}

TEST(Facts, NestingHasALimitAndNeedsNoStack) {
  std::string deep = "HIERARCHY\nROOT a\n{\n";
  for (int i = 0; i < 200000; ++i) deep += "JOINT b\n{\n";
  EXPECT_THROW(read_bvh(deep, "deep.bvh"), Error);
}

TEST(Facts, KeywordsMayBeOfAnyCase) {
  const std::string text =
      replaced(replaced(plain_bvh(), "HIERARCHY", "hierarchy"), "ROOT", "Root");
  EXPECT_EQ(read_bvh(replaced(text, "MOTION", "Motion"), "s.bvh").frames(), 3);
}

TEST(Facts, RadiansAreDegreesInside) {
  std::string text = plain_amc();
  text = replaced(text, ":DEGREES", ":RADIANS");
  const Take take =
      read_amc(text, "s.amc", std::make_shared<Skeleton>(read_asf(plain_asf(), "s.asf")));
  EXPECT_NEAR(take.channels(0, 3), 4 * 57.29577951308232, 1e-9);
  EXPECT_EQ(take.channels(0, 0), 1.0);
}

}  // namespace
}  // namespace reprise
