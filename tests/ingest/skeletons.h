// Skeletons of every kind, for tests.
#pragma once

#include <memory>
#include <random>
#include <string>

#include "ingest/marker_layout.h"
#include "reprise/formats/motion_file.h"

namespace reprise::testing_skeletons {

inline std::shared_ptr<const Skeleton> bvh(const std::string& hierarchy) {
  return std::make_shared<Skeleton>(read_bvh_skeleton("HIERARCHY\n" + hierarchy, "test.bvh"));
}

inline std::string joint(const std::string& name, const std::string& offset,
                         const std::string& channels, const std::string& children) {
  return "JOINT " + name + "\n{\nOFFSET " + offset + "\nCHANNELS " + channels + "\n" + children +
         "}\n";
}

inline std::string end_site(const std::string& offset) {
  return "End Site\n{\nOFFSET " + offset + "\n}\n";
}

inline std::string root(const std::string& channels, const std::string& children) {
  return "ROOT hips\n{\nOFFSET 0 0 0\nCHANNELS " + channels + "\n" + children + "}\n";
}

constexpr const char* six = "6 Xposition Yposition Zposition Zrotation Xrotation Yrotation";
constexpr const char* zxy = "3 Zrotation Xrotation Yrotation";

/// One child after another.
inline auto chain() {
  return bvh(root(six, joint("a", "0 10 0", zxy,
                             joint("b", "3 12 0", "3 Xrotation Yrotation Zrotation",
                                   joint("c", "0 9 4", "3 Yrotation Zrotation Xrotation",
                                         end_site("0 6 0"))))));
}

/// Hips, spine, and limbs with joints of one and two degrees of freedom.
inline auto branches() {
  const std::string leg =
      joint("knee", "0 -40 0", "1 Xrotation",
            joint("ankle", "0 -38 2", "2 Xrotation Zrotation", end_site("0 -3 12")));
  return bvh(root(
      six, joint("spine", "0 15 0", zxy,
                 joint("neck", "0 30 0", zxy, end_site("0 20 0")) +
                     joint("shoulder", "18 25 0", zxy,
                           joint("elbow", "28 0 0", "1 Yrotation",
                                 joint("wrist", "25 0 0", "1 Xrotation", end_site("8 0 0"))))) +
               joint("left_hip", "9 -5 0", zxy, leg) + joint("right_hip", "-9 -5 0", zxy, leg)));
}

/// Joints whose bones have no length, and one with no end at all.
inline auto without_lengths() {
  return bvh(
      root(six, joint("a", "0 0 0", zxy,
                      joint("b", "0 10 0", zxy, joint("c", "0 0 0", zxy, end_site("0 0 0")))) +
                    joint("d", "5 0 0", zxy, "")));
}

/// The motion of the root sits in the second joint, and every joint has positions.
inline auto positions_everywhere() {
  return bvh(
      root(six, joint("pelvis", "0 90 0", six,
                      joint("a", "16 0 0", six, joint("b", "20 0 1", six, end_site("7 0 0"))) +
                          joint("c", "0 -9 9", six, end_site("0 -40 0")))));
}

/// Fingers: many joints with short bones.
inline auto fingers() {
  std::string hand;
  for (int f = 0; f < 5; ++f) {
    const std::string z = std::to_string(2 * f - 4);
    hand += joint(
        "finger" + z, "8 0 " + z, zxy,
        joint("middle" + z, "3 0 0", zxy, joint("tip" + z, "2 0 0", zxy, end_site("1.6 0 0"))));
  }
  return bvh(root(six, joint("arm", "20 40 0", zxy, joint("hand", "25 0 0", zxy, hand))));
}

/// A root that turns but does not move, and one that only rises.
inline auto poor_root() {
  return bvh(root("2 Yposition Yrotation", joint("a", "0 10 0", zxy, end_site("0 10 0"))));
}

/// Rotation axes that repeat.
inline auto repeated_axes() {
  return bvh(root(
      six, joint("a", "0 20 0", "3 Xrotation Yrotation Xrotation",
                 joint("b", "0 20 0", "3 Zrotation Xrotation Zrotation", end_site("0 20 0")))));
}

inline auto asf() {
  const std::string text =
      ":version 1.10\n:units\n mass 1\n length 0.45\n angle deg\n:root\n order TX TY TZ RX RY RZ\n "
      "axis XYZ\n"
      " position 0 0 0\n orientation 0 0 0\n:bonedata\n"
      " begin\n id 1\n name hip\n direction 0.6 -0.7 0.2\n length 2.5\n axis 0 0 0 XYZ\n end\n"
      " begin\n id 2\n name other\n direction -0.6 -0.7 0.2\n length 2.5\n axis 0 0 0 XYZ\n end\n"
      " begin\n id 3\n name femur\n direction 0.34 -0.94 0\n length 7.5\n axis 0 0 20 XYZ\n dof rx "
      "ry rz\n"
      " limits (-160 20)\n (-70 70)\n (-60 70)\n end\n"
      " begin\n id 4\n name tibia\n direction 0.34 -0.94 0\n length 7.2\n axis 0 0 20 XYZ\n dof "
      "rx\n end\n"
      " begin\n id 5\n name foot\n direction 0.1 -0.2 0.97\n length 2.2\n axis -90 0 20 XYZ\n dof "
      "rx rz\n end\n"
      " begin\n id 6\n name back\n direction 0 1 -0.1\n length 4\n axis 0 0 0 XYZ\n dof rx ry rz\n "
      "end\n"
      ":hierarchy\n begin\n root hip other back\n hip femur\n femur tibia\n tibia foot\n end\n";
  return std::make_shared<const Skeleton>(read_asf(text, "test.asf"));
}

/// Smooth motion: angles swing about their centres, the root walks and turns. Away from gimbal
/// lock, since there angles are not unique; positions of joints below the root keep their offsets.
inline Take swinging_take(std::shared_ptr<const Skeleton> skeleton, long frames,
                          double swing_degrees, unsigned seed, int root_joint = 0) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> part(0, 1);
  Take take;
  take.frame_rate = 60;
  take.layout.frame_time_text = "0.0166667";
  take.channels = ChannelMatrix::Zero(frames, skeleton->channel_count);
  for (std::size_t j = 0; j < skeleton->joints.size(); ++j) {
    const Joint& joint = skeleton->joints[j];
    for (std::size_t c = 0; c < joint.channels.size(); ++c) {
      const double phase = 6.28 * part(random), speed = 0.02 + 0.05 * part(random);
      const double centre = 10 * part(random) - 5,
                   swing = swing_degrees * (0.5 + 0.5 * part(random));
      const bool root = static_cast<int>(j) == root_joint;
      for (long f = 0; f < frames; ++f) {
        double& value = take.channels(f, joint.first_channel + static_cast<Eigen::Index>(c));
        const double wave = std::sin(phase + speed * static_cast<double>(f));
        if (is_rotation(joint.channels[c])) {
          value = static_cast<int>(j) < root_joint ? 0 : centre + swing * wave;
        } else if (root) {
          value = 50 * wave + 0.3 * static_cast<double>(f);
        } else if (static_cast<int>(j) > root_joint) {
          value = joint.offset[axis_of(joint.channels[c])];
        }
      }
    }
  }
  take.skeleton = std::move(skeleton);
  return take;
}

}  // namespace reprise::testing_skeletons
