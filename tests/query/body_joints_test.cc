#include "reprise/query/body_joints.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "edited_motion.h"
#include "query/joint_names.h"
#include "query/posture_track.h"
#include "reprise/error.h"
#include "reprise/formats/motion_file.h"
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

/// A body whose feet do not say what is in front, so that its sides are known by names alone.
Skeleton without_feet(Skeleton skeleton) {
  for (Joint& joint : skeleton.joints) {
    if (joint.parent < 0) continue;
    const std::string& above = skeleton.joints[static_cast<std::size_t>(joint.parent)].name;
    if (above.ends_with("Foot") || above.ends_with("ToeBase")) joint.offset.setZero();
  }
  return skeleton;
}

/// Parts of bodies are kept, too: a neck alone, a hand on a foot.
TEST(BodyJoints, AnyTwoJointsAreNoBodyButNoHarm) {
  const std::vector<std::string> names = {"Hips",      "Spine",    "Neck",     "Head",
                                          "LeftUpLeg", "LeftLeg",  "LeftFoot", "LeftArm",
                                          "LeftHand",  "RightHand"};
  for (const std::string& root : names) {
    for (const std::string& child : names) {
      const std::string text =
          "HIERARCHY\nROOT " + root +
          "\n{\nOFFSET 0 0 0\nCHANNELS 3 Zrotation Xrotation Yrotation\nJOINT " + child +
          "\n{\nOFFSET 0 10 0\nCHANNELS 3 Zrotation Xrotation Yrotation\nEnd Site\n{\nOFFSET 0 10 "
          "0\n}\n}\n}\n";
      const Skeleton skeleton = read_bvh_skeleton(text, "part.bvh", 10);
      const BodyMatch match = match_body(skeleton, {});
      EXPECT_FALSE(match.is_body()) << root << ", " << child;
      for (const int joint : match.joints) EXPECT_LT(joint, 3) << root << ", " << child;
    }
  }
}

TEST(BodyJoints, AMapComesFirst) {
  const Skeleton skeleton =
      renamed(without_feet(synthetic_skeleton(MotionFormat::bvh)), {{"LeftUpLeg", "Gelenk1"}});
  EXPECT_FALSE(match_body(skeleton).is_body());
  const JointMap map = {{BodyJoint::hip_left, "Gelenk1"}, {BodyJoint::toe_left, ""}};
  const BodyMatch match = match_body(skeleton, map);
  EXPECT_TRUE(match.is_body());
  EXPECT_EQ(matched(skeleton, BodyJoint::hip_left, map), "Gelenk1");
  EXPECT_EQ(matched(skeleton, BodyJoint::toe_left, map), "");
  EXPECT_EQ(match.sources[static_cast<std::size_t>(BodyJoint::hip_left)], BodySource::map);
  EXPECT_EQ(match.sources[static_cast<std::size_t>(BodyJoint::hip_right)], BodySource::name);
}

TEST(BodyJoints, AMapKeepsTwoJointsInOnePlaceApart) {
  const Skeleton skeleton = synthetic_skeleton(MotionFormat::bvh);
  const JointMap map = {{BodyJoint::hip_left, "Hips"}, {BodyJoint::hip_right, "Hips"}};
  EXPECT_EQ(matched(skeleton, BodyJoint::hip_left, map), "Hips");
}

/// What a maker calls the joints of the synthetic body, from Hips on in its order.
struct Maker {
  const char* name;
  std::vector<std::string> joints;
};

const std::vector<std::string> synthetic_names = {
    "Hips",          "LeftUpLeg", "LeftLeg",      "LeftFoot", "LeftToeBase", "RightUpLeg",
    "RightLeg",      "RightFoot", "RightToeBase", "Spine",    "Spine1",      "Chest",
    "Neck",          "Head",      "LeftShoulder", "LeftArm",  "LeftForeArm", "LeftHand",
    "RightShoulder", "RightArm",  "RightForeArm", "RightHand"};

/// Names made of a maker's words: %S stands for the side.
std::vector<std::string> names_of(const std::vector<std::string>& words, const std::string& left,
                                  const std::string& right) {
  std::vector<std::string> names;
  const auto side = [](std::string word, const std::string& text) {
    const std::size_t at = word.find("%S");
    return at == std::string::npos ? word : word.replace(at, 2, text);
  };
  // Words: hips, thigh, shin, foot, toe, three of the spine, neck, head, collar, arm, elbow, hand.
  names.push_back(words[0]);
  for (const std::string& text : {left, right}) {
    for (int i = 1; i <= 4; ++i) names.push_back(side(words[static_cast<std::size_t>(i)], text));
  }
  for (int i = 5; i <= 9; ++i) names.push_back(words[static_cast<std::size_t>(i)]);
  for (const std::string& text : {left, right}) {
    for (int i = 10; i <= 13; ++i) names.push_back(side(words[static_cast<std::size_t>(i)], text));
  }
  return names;
}

std::vector<Maker> makers() {
  return {
      {"DeepMotion",
       names_of({"hips_JNT", "%S_upleg_JNT", "%S_leg_JNT", "%S_foot_JNT", "%S_toebase_JNT",
                 "spine_JNT", "spine1_JNT", "spine2_JNT", "neck_JNT", "head_JNT", "%S_shoulder_JNT",
                 "%S_arm_JNT", "%S_forearm_JNT", "%S_hand_JNT"},
                "l", "r")},
      {"VRoid", names_of({"J_Bip_C_Hips", "J_Bip_%S_UpperLeg", "J_Bip_%S_LowerLeg", "J_Bip_%S_Foot",
                          "J_Bip_%S_ToeBase", "J_Bip_C_Spine", "J_Bip_C_Chest",
                          "J_Bip_C_UpperChest", "J_Bip_C_Neck", "J_Bip_C_Head", "J_Bip_%S_Shoulder",
                          "J_Bip_%S_UpperArm", "J_Bip_%S_LowerArm", "J_Bip_%S_Hand"},
                         "L", "R")},
      {"Axis Neuron",
       names_of({"Robot_Hips", "Robot_%SUpLeg", "Robot_%SLeg", "Robot_%SFoot", "Robot_%SToe",
                 "Robot_Spine", "Robot_Spine1", "Robot_Spine2", "Robot_Neck", "Robot_Head",
                 "Robot_%SShoulder", "Robot_%SArm", "Robot_%SForeArm", "Robot_%SHand"},
                "Left", "Right")},
      {"Second Life",
       names_of({"mPelvis", "mHip%S", "mKnee%S", "mAnkle%S", "mFoot%S", "mSpine1", "mTorso",
                 "mChest", "mNeck", "mHead", "mCollar%S", "mShoulder%S", "mElbow%S", "mWrist%S"},
                "Left", "Right")},
      {"Daz", names_of({"hip", "%SThighBend", "%SShin", "%SFoot", "%SToe", "abdomenLower",
                        "abdomenUpper", "chestLower", "neckLower", "head", "%SCollar",
                        "%SShldrBend", "%SForearmBend", "%SHand"},
                       "l", "r")},
      {"Poser", names_of({"hip", "%SThigh", "%SShin", "%SFoot", "%SToe", "abdomen", "abdomen2",
                          "chest", "neck", "head", "%SCollar", "%SShldr", "%SForeArm", "%SHand"},
                         "l", "r")},
      {"SMPL of Maya",
       names_of({"f_avg_Pelvis", "f_avg_%S_Hip", "f_avg_%S_Knee", "f_avg_%S_Ankle", "f_avg_%S_Foot",
                 "f_avg_Spine1", "f_avg_Spine2", "f_avg_Spine3", "f_avg_Neck", "f_avg_Head",
                 "f_avg_%S_Collar", "f_avg_%S_Shoulder", "f_avg_%S_Elbow", "f_avg_%S_Wrist"},
                "L", "R")},
      {"SMPL",
       names_of({"Pelvis", "%S_Hip", "%S_Knee", "%S_Ankle", "%S_Foot", "Spine1", "Spine2", "Spine3",
                 "Neck", "Head", "%S_Collar", "%S_Shoulder", "%S_Elbow", "%S_Wrist"},
                "L", "R")},
      {"an actor's own prefix",
       names_of({"Anna_Hips", "Anna_%SUpLeg", "Anna_%SLeg", "Anna_%SFoot", "Anna_%SToeBase",
                 "Anna_Spine", "Anna_Spine1", "Anna_Spine2", "Anna_Neck", "Anna_Head",
                 "Anna_%SShoulder", "Anna_%SArm", "Anna_%SForeArm", "Anna_%SHand"},
                "Left", "Right")},
      {"numbers after the side",
       names_of({"Hip", "Upperleg.%S 1", "Shin.%S.001", "Foot.%S 1", "Toe.%S", "Spine", "Spine1",
                 "Chest", "Neck", "Head", "Shoulder.%S", "Upperarm.%S", "Forearm.%S", "Hand.%S 1"},
                "L", "R")}};
}

TEST(BodyJoints, EveryMakersNamesSayAWholeBody) {
  const Skeleton skeleton = synthetic_skeleton(MotionFormat::bvh);
  const BodyMatch known = match_body(skeleton);
  for (const Maker& maker : makers()) {
    ASSERT_EQ(maker.joints.size(), synthetic_names.size());
    std::map<std::string, std::string> names;
    for (std::size_t i = 0; i < synthetic_names.size(); ++i) {
      names[synthetic_names[i]] = maker.joints[i];
    }
    const BodyMatch match = match_body(renamed(skeleton, names));
    EXPECT_TRUE(match.is_body()) << maker.name;
    for (std::size_t i = 0; i < body_joint_count; ++i) {
      const auto joint = static_cast<BodyJoint>(i);
      // Any joint of the spine will do.
      if (joint != BodyJoint::chest) {
        EXPECT_EQ(match.joints[i], known.joints[i]) << maker.name << " " << body_joint_name(joint);
      }
      EXPECT_EQ(match.sources[i], BodySource::name) << maker.name << " " << body_joint_name(joint);
    }
  }
}

TEST(BodyJoints, APrefixEndsWhereAWordDoes) {
  EXPECT_EQ(plain_name("RLowerArm"), "rlowerarm");
  EXPECT_EQ(plain_name("R_LowerLeg"), "rlowerleg");
  EXPECT_EQ(plain_name("RL_BoneRoot"), "boneroot");
  EXPECT_EQ(plain_name("mixamorig9_LeftHand"), "lefthand");
}

/// Names that say nothing.
Skeleton nameless(Skeleton skeleton) {
  int number = 0;
  for (Joint& joint : skeleton.joints) {
    if (!joint.end_site) joint.name = "Gelenk" + std::to_string(number++);
  }
  return skeleton;
}

TEST(BodyJoints, ABodyWithoutNamesIsKnownByItsRestPose) {
  for (const MotionFormat format : {MotionFormat::bvh, MotionFormat::asf_amc}) {
    const Take take = edited::synthetic_takes(1, 2, format)[0];
    const BodyMatch known = match_body(*take.skeleton);
    for (const UpAxis up : edited::every_up) {
      const BodyMatch match = match_body(nameless(*edited::turned(take, up).skeleton));
      EXPECT_TRUE(match.is_body());
      for (std::size_t i = 0; i < body_joint_count; ++i) {
        const auto joint = static_cast<BodyJoint>(i);
        // The spine, and an ASF's bones of neck and shoulders, have no one right joint.
        const bool of_the_middle =
            joint == BodyJoint::chest || joint == BodyJoint::neck || joint == BodyJoint::head;
        if (!of_the_middle) EXPECT_EQ(match.joints[i], known.joints[i]) << body_joint_name(joint);
        EXPECT_EQ(match.sources[i], BodySource::hierarchy) << body_joint_name(joint);
      }
    }
  }
}

TEST(BodyJoints, TwoJointsInOnePlaceAreNoPair) {
  Skeleton skeleton = synthetic_skeleton(MotionFormat::bvh);
  const BodyMatch known = match_body(skeleton);
  // A helper without a length before each leg and arm, under the surest name.
  for (const std::string name : {"LeftUpLeg", "RightUpLeg", "LeftArm", "RightArm"}) {
    const bool leg = name.ends_with("Leg");
    const auto limb = std::ranges::find(skeleton.joints, name, &Joint::name);
    const int at = static_cast<int>(limb - skeleton.joints.begin());
    Joint helper = *limb;
    limb->name = name.substr(0, name.find(leg ? "UpLeg" : "Arm")) + (leg ? "Hip" : "Shoulder2");
    helper.offset.setZero();
    if (!leg) {
      // Both collars begin in the middle, too.
      helper.parent = skeleton.joints[static_cast<std::size_t>(helper.parent)].parent;
    }
    for (Joint& joint : skeleton.joints) {
      if (joint.parent >= at) ++joint.parent;
    }
    limb->parent = at;
    skeleton.joints.insert(skeleton.joints.begin() + at, helper);
    if (!leg) skeleton.joints[static_cast<std::size_t>(at) + 1].offset.x() *= 2;
  }
  const BodyMatch match = match_body(skeleton);
  EXPECT_TRUE(match.is_body());
  const auto name = [&](BodyJoint joint) {
    return skeleton.joints[static_cast<std::size_t>(match.of(joint))].name;
  };
  EXPECT_EQ(name(BodyJoint::hip_left), "LeftHip");
  EXPECT_EQ(name(BodyJoint::hip_right), "RightHip");
  EXPECT_EQ(name(BodyJoint::shoulder_left), "LeftShoulder2");
  EXPECT_EQ(name(BodyJoint::shoulder_right), "RightShoulder2");
  EXPECT_EQ(name(BodyJoint::knee_left),
            synthetic_skeleton(MotionFormat::bvh)
                .joints[static_cast<std::size_t>(known.of(BodyJoint::knee_left))]
                .name);
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

/// What goes on four feet: its torso lies before its hips.
Skeleton four_legged() {
  Skeleton skeleton = nameless(synthetic_skeleton(MotionFormat::bvh));
  const BodyMatch match = match_body(synthetic_skeleton(MotionFormat::bvh));
  std::vector<bool> torso(skeleton.joints.size(), false);
  for (std::size_t j = 1; j < skeleton.joints.size(); ++j) {
    Joint& joint = skeleton.joints[j];
    const int left = match.of(BodyJoint::hip_left), right = match.of(BodyJoint::hip_right);
    const bool leg = static_cast<int>(j) == left || static_cast<int>(j) == right;
    torso[j] = (joint.parent == 0 && !leg) || torso[static_cast<std::size_t>(joint.parent)];
    if (torso[j]) joint.offset = axis_rotation(0, 1.5) * joint.offset;
  }
  return skeleton;
}

TEST(MeasuredBody, SkeletonsThatAreNoBodyArePlannedByTheirOwnBones) {
  const Skeleton skeleton = four_legged();
  const MeasuredBody body = measured_body(skeleton);
  EXPECT_NE(body.plan.id, 0u);
  EXPECT_EQ(body.plan, measured_body(skeleton).plan);
  for (int b = 0; b < plan_bones; ++b)
    EXPECT_LT(body.plan.parents[static_cast<std::size_t>(b)], std::max(b, 1));
  EXPECT_EQ(measured_body(synthetic_skeleton(MotionFormat::bvh)).plan.id, 0u);
}

TEST(PostureTracks, AreTheSameWhicheverAxisPointsUp) {
  for (const MotionFormat format : {MotionFormat::bvh, MotionFormat::asf_amc}) {
    for (const bool body : {true, false}) {
      Take take = edited::synthetic_takes(1, 3, format)[0];
      if (!body) {
        if (format != MotionFormat::bvh) continue;
        auto animal = std::make_shared<Skeleton>(four_legged());
        take.skeleton = animal;
      }
      const PostureTrack expected = posture_track(take);
      for (const UpAxis up : edited::every_up) {
        Take turned = edited::turned(take, up);
        turned.skeleton = std::make_shared<Skeleton>([&] {
          Skeleton skeleton = *turned.skeleton;
          skeleton.up = up;
          return skeleton;
        }());
        const PostureTrack track = posture_track(turned);
        ASSERT_EQ(track.directions.size(), expected.directions.size());
        for (std::size_t i = 0; i < track.directions.size(); ++i) {
          ASSERT_NEAR(track.directions[i], expected.directions[i], 1) << up_axis_name(up);
        }
        for (std::size_t i = 0; i < track.speeds.size(); ++i) {
          ASSERT_NEAR(track.speeds[i], expected.speeds[i], 1) << up_axis_name(up);
        }
      }
    }
  }
}

}  // namespace
}  // namespace reprise
