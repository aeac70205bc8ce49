#include "reprise/query/body_joints.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "query/joint_names.h"
#include "query/posture_track.h"
#include "reprise/error.h"
#include "reprise/synth/library.h"

namespace reprise {
namespace {

namespace fs = std::filesystem;

Skeleton synthetic_skeleton(MotionFormat format) {
  SynthOptions options;
  options.takes = 1;
  options.seconds = 2;
  options.format = format;
  return *make_synthetic_library(options).takes[0].skeleton;
}

std::string matched(const Skeleton& skeleton, BodyJoint joint, const JointMap& map = {}) {
  const int found = match_body(skeleton, map).of(joint);
  return found < 0 ? "" : skeleton.joints[static_cast<std::size_t>(found)].name;
}

/// Renames the joints that `names` has.
Skeleton renamed(Skeleton skeleton, const std::map<std::string, std::string>& names) {
  for (Joint& joint : skeleton.joints) {
    const auto found = names.find(joint.name);
    if (found != names.end()) joint.name = found->second;
  }
  return skeleton;
}

TEST(BodyJoints, NamesOfExportersMeanTheSameJoints) {
  EXPECT_EQ(plain_name("mixamorig:LeftUpLeg"), "leftupleg");
  EXPECT_EQ(plain_name("CC_Base_L_Thigh"), "lthigh");
  EXPECT_EQ(plain_name("Bip01 R Forearm"), "rforearm");
  EXPECT_EQ(plain_name("UpperLeg_L"), "upperlegl");
  EXPECT_TRUE(is_called("lthigh", BodyJoint::hip_left, "thigh"));
  EXPECT_TRUE(is_called("leftthigh", BodyJoint::hip_left, "thigh"));
  EXPECT_TRUE(is_called("thighl", BodyJoint::hip_left, "thigh"));
  EXPECT_FALSE(is_called("rthigh", BodyJoint::hip_left, "thigh"));
  EXPECT_FALSE(is_called("lthightwist", BodyJoint::hip_left, "thigh"));
}

TEST(BodyJoints, BodiesOfBothFormatsAreMatched) {
  const Skeleton bvh = synthetic_skeleton(MotionFormat::bvh);
  EXPECT_TRUE(match_body(bvh).is_body());
  EXPECT_EQ(matched(bvh, BodyJoint::knee_left), "LeftLeg");
  EXPECT_EQ(matched(bvh, BodyJoint::shoulder_right), "RightArm");
  const Skeleton asf = synthetic_skeleton(MotionFormat::asf_amc);
  EXPECT_TRUE(match_body(asf).is_body());
  EXPECT_EQ(matched(asf, BodyJoint::knee_left), "lfemur");
  EXPECT_EQ(matched(asf, BodyJoint::hand_right).substr(0, 1), "r");
}

TEST(BodyJoints, TheHierarchyTellsWhatNamesDoNot) {
  const Skeleton skeleton = renamed(synthetic_skeleton(MotionFormat::bvh),
                                    {{"LeftLeg", "Gelenk7"}, {"RightForeArm", "Gelenk8"}});
  EXPECT_EQ(matched(skeleton, BodyJoint::knee_left), "Gelenk7");
  EXPECT_EQ(matched(skeleton, BodyJoint::elbow_right), "Gelenk8");
}

TEST(BodyJoints, AMapComesFirst) {
  const Skeleton skeleton =
      renamed(synthetic_skeleton(MotionFormat::bvh), {{"LeftUpLeg", "Gelenk1"}});
  EXPECT_FALSE(match_body(skeleton).is_body());
  const JointMap map = {{BodyJoint::hip_left, "Gelenk1"}, {BodyJoint::toe_left, ""}};
  EXPECT_TRUE(match_body(skeleton, map).is_body());
  EXPECT_EQ(matched(skeleton, BodyJoint::hip_left, map), "Gelenk1");
  EXPECT_EQ(matched(skeleton, BodyJoint::toe_left, map), "");
}

class JointMapFile : public testing::Test {
 protected:
  JointMapFile() : path_(fs::temp_directory_path() / ("joint_map_" + std::to_string(getpid()))) {}
  ~JointMapFile() override { fs::remove(path_); }
  JointMap read(const std::string& text) const {
    std::ofstream(path_) << text;
    return read_joint_map(path_);
  }
  fs::path path_;
};

TEST_F(JointMapFile, LinesNameJoints) {
  const JointMap map = read("# a comment\n\nhip_left = Left Thigh # of the rig\r\nhead=\n");
  EXPECT_EQ(map, (JointMap{{BodyJoint::hip_left, "Left Thigh"}, {BodyJoint::head, ""}}));
}

TEST_F(JointMapFile, OtherLinesAreRejectedWithTheirNumber) {
  for (const std::string line : {"hip_left", "tail = Tail", "= Hips", "hip_left LThigh"}) {
    try {
      read("head = Head\n" + line + "\n");
      ADD_FAILURE() << line;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::rejected_input);
      EXPECT_EQ(error.place().line, 2u) << line;
    }
  }
}

TEST(MeasuredBody, SkeletonsThatAreNoBodyArePlannedByTheirOwnBones) {
  Skeleton skeleton = synthetic_skeleton(MotionFormat::bvh);
  for (Joint& joint : skeleton.joints) {
    if (!joint.end_site) joint.name = "joint" + joint.name.substr(0, 1) + joint.name.substr(2);
  }
  const MeasuredBody body = measured_body(skeleton);
  EXPECT_NE(body.plan.id, 0u);
  EXPECT_EQ(body.plan, measured_body(skeleton).plan);
  for (int b = 0; b < plan_bones; ++b)
    EXPECT_LT(body.plan.parents[static_cast<std::size_t>(b)], std::max(b, 1));
  EXPECT_EQ(measured_body(synthetic_skeleton(MotionFormat::bvh)).plan.id, 0u);
}

}  // namespace
}  // namespace reprise
