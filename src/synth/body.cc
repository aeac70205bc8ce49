#include "synth/body.h"

#include <algorithm>
#include <cmath>

namespace reprise::synth {
namespace {

constexpr std::array<bool, 3> free_x = {true, false, false};
constexpr std::array<bool, 3> free_xz = {true, false, true};
constexpr std::array<bool, 3> free_yz = {false, true, true};
constexpr std::array<bool, 3> free_xyz = {true, true, true};
constexpr std::array<AngleLimits, 3> femur_limits = {{{-160, 45}, {-70, 70}, {-60, 60}}};
constexpr std::array<AngleLimits, 3> tibia_limits = {{{-10, 170}, {-15, 15}, {-15, 15}}};
constexpr std::array<AngleLimits, 3> foot_limits = {{{-70, 90}, {-60, 60}, {-60, 60}}};
constexpr std::array<AngleLimits, 3> toe_limits = {{{-90, 30}, {-15, 15}, {-15, 15}}};
constexpr std::array<AngleLimits, 3> back_limits = {{{-30, 50}, {-35, 35}, {-30, 30}}};
constexpr std::array<AngleLimits, 3> neck_limits = {{{-45, 50}, {-50, 50}, {-35, 35}}};
constexpr std::array<AngleLimits, 3> clavicle_limits = {{{-15, 15}, {-30, 30}, {-30, 30}}};
constexpr std::array<AngleLimits, 3> humerus_limits = {{{-110, 90}, {-130, 130}, {-110, 110}}};
constexpr std::array<AngleLimits, 3> radius_limits = {{{-10, 160}, {-15, 15}, {-15, 15}}};
constexpr std::array<AngleLimits, 3> hand_limits = {{{-90, 90}, {-15, 15}, {-80, 80}}};

const std::array<JointDescription, joint_count> descriptions = {{
    {"Hips", "root", -1, 0, free_xyz, {}},
    {"LeftUpLeg", "lfemur", hips, 0, free_xyz, femur_limits},
    {"LeftLeg", "ltibia", left_up_leg, 0, free_x, tibia_limits},
    {"LeftFoot", "lfoot", left_leg, 0, free_xyz, foot_limits},
    {"LeftToeBase", "ltoes", left_foot, 0, free_x, toe_limits},
    {"RightUpLeg", "rfemur", hips, 0, free_xyz, femur_limits},
    {"RightLeg", "rtibia", right_up_leg, 0, free_x, tibia_limits},
    {"RightFoot", "rfoot", right_leg, 0, free_xyz, foot_limits},
    {"RightToeBase", "rtoes", right_foot, 0, free_x, toe_limits},
    {"Spine", "lowerback", hips, 0, free_xyz, back_limits},
    {"Spine1", "upperback", spine, 0, free_xyz, back_limits},
    {"Chest", "thorax", spine1, 0, free_xyz, back_limits},
    {"Neck", "lowerneck", chest, 0, free_xyz, neck_limits},
    {"Head", "head", neck, 0, free_xyz, neck_limits},
    {"LeftShoulder", "lclavicle", chest, 0, free_yz, clavicle_limits},
    {"LeftArm", "lhumerus", left_shoulder, 0, free_xyz, humerus_limits},
    {"LeftForeArm", "lradius", left_arm, -90, free_x, radius_limits},
    {"LeftHand", "lhand", left_fore_arm, 0, free_xz, hand_limits},
    {"RightShoulder", "rclavicle", chest, 0, free_yz, clavicle_limits},
    {"RightArm", "rhumerus", right_shoulder, 0, free_xyz, humerus_limits},
    {"RightForeArm", "rradius", right_arm, 90, free_x, radius_limits},
    {"RightHand", "rhand", right_fore_arm, 0, free_xz, hand_limits},
}};

/// Sets both sides' offsets from the left one.
void set_pair(Proportions& body, int left, int right, const Eigen::Vector3d& offset) {
  body.offset[left] = offset;
  body.offset[right] = {-offset.x(), offset.y(), offset.z()};
}

void set_tip_pair(Proportions& body, int left, int right, const Eigen::Vector3d& tip) {
  body.tip[left] = tip;
  body.tip[right] = {-tip.x(), tip.y(), tip.z()};
}

/// A length that is `share` of the stature, a little more or less.
double vary(Random& random, double stature, double share) {
  return stature * share * random.uniform(0.97, 1.03);
}

}  // namespace

const JointDescription& describe(int joint) {
  return descriptions[static_cast<std::size_t>(joint)];
}

int bone_end(int joint) {
  if (joint == chest) return neck;
  const bool child_follows =
      joint != hips && joint + 1 < joint_count && describe(joint + 1).parent == joint;
  return child_follows ? joint + 1 : -1;
}

double Proportions::standing_height() const {
  return leg() + ankle_height - offset[left_up_leg].y();
}

Proportions random_proportions(Random random) {
  Proportions body;
  for (auto& offset : body.offset) offset.setZero();
  const double stature = random.uniform(1620, 1860);
  body.thigh = vary(random, stature, 0.245);
  body.shank = vary(random, stature, 0.246);
  body.ankle_height = vary(random, stature, 0.039);
  const double hip_half_width = vary(random, stature, 0.052);
  const double foot = vary(random, stature, 0.082);
  const double toes = vary(random, stature, 0.040);
  const double trunk = vary(random, stature, 0.288);
  const double neck_length = vary(random, stature, 0.060);
  const double head_length = vary(random, stature, 0.115);
  const double shoulder = vary(random, stature, 0.115);
  const double upper_arm = vary(random, stature, 0.186);
  const double fore_arm = vary(random, stature, 0.146);
  const double hand = vary(random, stature, 0.100);
  const double ball_height = 0.3 * body.ankle_height;

  set_pair(body, left_up_leg, right_up_leg, {hip_half_width, -0.018 * stature, 0});
  set_pair(body, left_leg, right_leg, {0, -body.thigh, 0});
  set_pair(body, left_foot, right_foot, {0, -body.shank, 0});
  set_pair(body, left_toe_base, right_toe_base, {0, ball_height - body.ankle_height, foot});
  set_tip_pair(body, left_toe_base, right_toe_base, {0, -0.5 * ball_height, toes});
  body.offset[spine] = {0, 0.16 * trunk, -0.01 * stature};
  body.offset[spine1] = {0, 0.26 * trunk, 0.005 * stature};
  body.offset[chest] = {0, 0.26 * trunk, -0.008 * stature};
  body.offset[neck] = {0, 0.32 * trunk, -0.006 * stature};
  body.offset[head] = {0, neck_length, 0.010 * stature};
  body.tip[head] = {0, head_length, 0.004 * stature};
  set_pair(body, left_shoulder, right_shoulder, body.offset[neck]);
  set_pair(body, left_arm, right_arm, {shoulder, -0.018 * stature, 0.002 * stature});
  set_pair(body, left_fore_arm, right_fore_arm, {upper_arm, 0, 0});
  set_pair(body, left_hand, right_hand, {fore_arm, 0, 0});
  set_tip_pair(body, left_hand, right_hand, {hand, 0, 0});
  for (int joint = 1; joint < joint_count; ++joint) {
    if (const int end = bone_end(joint); end >= 0) body.tip[joint] = body.offset[end];
  }
  body.tip[hips].setZero();
  return body;
}

Eigen::Matrix3d rotation_zyx(double x, double y, double z) {
  const double cx = std::cos(x * radians_per_degree), sx = std::sin(x * radians_per_degree);
  const double cy = std::cos(y * radians_per_degree), sy = std::sin(y * radians_per_degree);
  const double cz = std::cos(z * radians_per_degree), sz = std::sin(z * radians_per_degree);
  Eigen::Matrix3d rotation;
  rotation << cz * cy, cz * sy * sx - sz * cx, cz * sy * cx + sz * sx,  //
      sz * cy, sz * sy * sx + cz * cx, sz * sy * cx - cz * sx,          //
      -sy, cy * sx, cy * cx;
  return rotation;
}

Eigen::Matrix3d joint_rotation(int joint, const Eigen::Vector3d& angles) {
  const Eigen::Matrix3d turn = rotation_zyx(angles.x(), angles.y(), angles.z());
  const double axis_z = describe(joint).axis_z;
  if (axis_z == 0) return turn;
  const Eigen::Matrix3d axes = rotation_zyx(0, 0, axis_z);
  return axes * turn * axes.transpose();
}

Eigen::Vector3d angles_zyx(const Eigen::Matrix3d& r) {
  const double y = std::asin(std::clamp(-r(2, 0), -1.0, 1.0));
  const double x = std::atan2(r(2, 1), r(2, 2));
  const double z = std::atan2(r(1, 0), r(0, 0));
  return Eigen::Vector3d(x, y, z) / radians_per_degree;
}

}  // namespace reprise::synth
