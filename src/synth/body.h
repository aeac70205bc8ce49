// The body that all synthetic subjects share: joints, degrees of freedom and limits; proportions
// vary.
#pragma once

#include <Eigen/Core>
#include <array>

#include "synth/random.h"

namespace reprise::synth {

constexpr double pi = 3.14159265358979323846;
constexpr double radians_per_degree = pi / 180;

/// Joints in file order, depth first. The body stands in a T pose: Y up, facing +Z, left is +X.
enum BodyJoint : int {
  hips,
  left_up_leg,
  left_leg,
  left_foot,
  left_toe_base,
  right_up_leg,
  right_leg,
  right_foot,
  right_toe_base,
  spine,
  spine1,
  chest,
  neck,
  head,
  left_shoulder,
  left_arm,
  left_fore_arm,
  left_hand,
  right_shoulder,
  right_arm,
  right_fore_arm,
  right_hand,
  joint_count
};

enum class Side : int { left = 0, right = 1 };
constexpr Side other(Side side) { return side == Side::left ? Side::right : Side::left; }
/// 1 for the left, which is +X.
constexpr double sign_of(Side side) { return side == Side::left ? 1 : -1; }

/// A range of one angle in degrees.
struct AngleLimits {
  double low = 0;
  double high = 0;
};

/// A joint turns by A Rz(z) Ry(y) Rx(x) A^T with A a turn of `axis_z` degrees about Z.
struct JointDescription {
  const char* bvh_name;
  const char* asf_name;
  int parent;
  double axis_z;
  std::array<bool, 3> free;  ///< degrees of freedom x, y, z of the ASF bone
  std::array<AngleLimits, 3> limits;
};

const JointDescription& describe(int joint);
/// True where a BVH joint turns Z, Y, X, so that its angles are the body's own; the hips and elbows
/// turn Z, X, Y, which keeps them off the pole in the middle axis.
constexpr bool turns_zyx(int joint) {
  return joint != hips && joint != left_fore_arm && joint != right_fore_arm;
}
/// The joint that the bone of `joint` ends in, or -1 where it ends in an end site.
int bone_end(int joint);

/// Lengths of one subject in millimetres.
struct Proportions {
  std::array<Eigen::Vector3d, joint_count> offset;  ///< from the parent joint; zero for the hips
  std::array<Eigen::Vector3d, joint_count> tip;     ///< end of the bone, from the joint
  double thigh = 0;
  double shank = 0;
  double ankle_height = 0;  ///< of a foot that stands flat

  double leg() const { return thigh + shank; }
  /// Height of the hips' origin over straight legs.
  double standing_height() const;
};

/// A person of 1.62 to 1.86 m. Segment lengths are shares of the stature (Drillis and Contini 1966,
/// as in Winter, Biomechanics and Motor Control of Human Movement, table 4.1), each 3 % longer or
/// shorter.
Proportions random_proportions(Random random);

/// Rz(z) Ry(y) Rx(x), angles in degrees.
Eigen::Matrix3d rotation_zyx(double x, double y, double z);
/// The local rotation of a joint by its three angles in degrees.
Eigen::Matrix3d joint_rotation(int joint, const Eigen::Vector3d& angles);
/// Angles x, y, z in degrees of Rz(z) Ry(y) Rx(x), y within 90 degrees.
Eigen::Vector3d angles_zyx(const Eigen::Matrix3d& rotation);

}  // namespace reprise::synth
