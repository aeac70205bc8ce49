#include "reprise/model/kinematics.h"

#include <cassert>
#include <cmath>
#include <numbers>

namespace reprise {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

/// Turns `rotation` further about one of its own axes: two columns are mixed.
void turn(Matrix3d& rotation, int axis, double radians) {
  const double c = std::cos(radians), s = std::sin(radians);
  const int j = (axis + 1) % 3, k = (axis + 2) % 3;
  const Vector3d old_j = rotation.col(j);
  rotation.col(j) = c * old_j + s * rotation.col(k);
  rotation.col(k) = c * rotation.col(k) - s * old_j;
}

/// Position channels of a frame, as a vector; components without a channel are those of
/// `otherwise`.
Vector3d translation(const Joint& joint, std::span<const double> channels, Vector3d otherwise) {
  for (std::size_t c = 0; c < joint.channels.size(); ++c) {
    if (is_position(joint.channels[c])) {
      otherwise[axis_of(joint.channels[c])] = channels[joint.first_channel + c];
    }
  }
  return otherwise;
}

double stretch(const Joint& joint, std::span<const double> channels) {
  for (std::size_t c = 0; c < joint.channels.size(); ++c) {
    if (joint.channels[c] == Channel::length) return channels[joint.first_channel + c];
  }
  return 0;
}

}  // namespace

Matrix3d axis_rotation(int axis, double radians) {
  Matrix3d rotation = Matrix3d::Identity();
  turn(rotation, axis, radians);
  return rotation;
}

Matrix3d turn_to_y(UpAxis axis) {
  const double sign = static_cast<int>(axis) < 3 ? 1 : -1;
  Matrix3d turn;
  switch (static_cast<int>(axis) % 3) {
    case 0:
      turn << 0, -sign, 0, sign, 0, 0, 0, 0, 1;
      break;
    case 1:
      turn << sign, 0, 0, 0, sign, 0, 0, 0, 1;
      break;
    default:
      turn << 1, 0, 0, 0, 0, sign, 0, -sign, 0;
  }
  return turn;
}

ChannelMatrix rest_channels(const Skeleton& skeleton) {
  ChannelMatrix channels = ChannelMatrix::Zero(1, skeleton.channel_count);
  if (skeleton.format != MotionFormat::bvh) return channels;
  for (const Joint& joint : skeleton.joints) {
    for (std::size_t c = 0; c < joint.channels.size(); ++c) {
      if (!is_position(joint.channels[c])) continue;
      channels(0, joint.first_channel + static_cast<Eigen::Index>(c)) =
          joint.offset[axis_of(joint.channels[c])];
    }
  }
  return channels;
}

Matrix3d local_rotation(const Joint& joint, std::span<const double> channels) {
  Matrix3d rotation = Matrix3d::Identity();
  for (std::size_t k = 0; k < joint.rotation_order.size(); ++k) {
    const double degrees = channels[joint.first_channel + joint.rotation_slots[k]];
    turn(rotation, joint.rotation_order[k], degrees * std::numbers::pi / 180.0);
  }
  return rotation;
}

JointFrame place_joint(const Skeleton& skeleton, const Joint& joint,
                       std::span<const double> channels, const JointFrame& parent,
                       std::span<Vector3d> axes) {
  const bool bvh = skeleton.format == MotionFormat::bvh;
  const double scale = skeleton.millimetres_per_unit;
  const Matrix3d own_axes = bvh ? parent.rotation : Matrix3d(parent.rotation * joint.axis);
  JointFrame frame;
  frame.rotation = own_axes;
  for (std::size_t k = 0; k < joint.rotation_order.size(); ++k) {
    const int axis = joint.rotation_order[k];
    if (!axes.empty()) axes[k] = frame.rotation.col(axis);
    const double degrees = channels[joint.first_channel + joint.rotation_slots[k]];
    turn(frame.rotation, axis, degrees * std::numbers::pi / 180.0);
  }
  if (bvh) {
    frame.position =
        parent.position + scale * (parent.rotation * translation(joint, channels, joint.offset));
    return frame;
  }
  frame.rotation = joint.rotation_order.empty() ? parent.rotation
                                                : Matrix3d(frame.rotation * joint.axis.transpose());
  const Vector3d moved = own_axes * translation(joint, channels, Vector3d::Zero());
  Vector3d bone = joint.offset;
  const double longer = stretch(joint, channels);
  if (longer != 0 && bone.norm() > 0) bone += longer * bone.normalized();
  frame.position = parent.position +
                   scale * (moved + (joint.parent < 0 ? bone : Vector3d(frame.rotation * bone)));
  return frame;
}

void forward_kinematics(const Skeleton& skeleton, std::span<const double> channels,
                        std::span<JointFrame> joints) {
  assert(channels.size() == static_cast<std::size_t>(skeleton.channel_count));
  assert(joints.size() == skeleton.joints.size());
  const JointFrame world;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const Joint& joint = skeleton.joints[j];
    joints[j] =
        place_joint(skeleton, joint, channels, joint.parent < 0 ? world : joints[joint.parent]);
  }
}

PositionMatrix joint_positions(const Skeleton& skeleton, const ChannelMatrix& channels) {
  PositionMatrix positions(channels.rows(), 3 * static_cast<Eigen::Index>(skeleton.joints.size()));
  std::vector<JointFrame> joints(skeleton.joints.size());
  for (Eigen::Index f = 0; f < channels.rows(); ++f) {
    forward_kinematics(skeleton,
                       {channels.row(f).data(), static_cast<std::size_t>(channels.cols())}, joints);
    for (std::size_t j = 0; j < joints.size(); ++j) {
      positions.row(f).segment<3>(3 * static_cast<Eigen::Index>(j)) =
          joints[j].position.transpose();
    }
  }
  return positions;
}

}  // namespace reprise
