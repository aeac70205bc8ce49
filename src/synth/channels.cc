#include "synth/channels.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "synth/skeleton_text.h"

namespace reprise::synth {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Angles about X, Y, Z of Rz Rx Ry, x within 90 degrees.
Vector3d angles_zxy(const Matrix3d& r) {
  const double x = std::asin(std::clamp(r(2, 1), -1.0, 1.0));
  const double y = std::atan2(-r(2, 0), r(2, 2));
  const double z = std::atan2(-r(0, 1), r(1, 1));
  return Vector3d(x, y, z) / radians_per_degree;
}

/// The angles, or the other ones of the same rotation, that are nearest to the last frame's.
/// `middle` is the axis in the middle of the order.
Vector3d follow(const Vector3d& angles, int middle, const Vector3d& last) {
  Vector3d others = angles.array() + 180;
  others[middle] = 180 - angles[middle];
  const auto near = [&](Vector3d value) {
    for (int axis = 0; axis < 3; ++axis)
      value[axis] -= 360 * std::round((value[axis] - last[axis]) / 360);
    return value;
  };
  const Vector3d a = near(angles), b = near(others);
  return (a - last).cwiseAbs().sum() <= (b - last).cwiseAbs().sum() ? a : b;
}

int body_joint(const Joint& joint, MotionFormat format) {
  if (joint.channels.empty()) return -1;
  for (int candidate = 0; candidate < joint_count; ++candidate) {
    const JointDescription& described = describe(candidate);
    const std::string_view name =
        format == MotionFormat::bvh ? described.bvh_name : described.asf_name;
    if (joint.name == name) return candidate;
  }
  return -1;
}

Matrix3d root_of(const PoseMatrix& poses, long frame) {
  return root_rotation(poses(frame, root_yaw), poses(frame, root_pitch), poses(frame, root_roll));
}

/// Angles about X, Y, Z of one joint in every frame, in the format's own order of turning.
Eigen::MatrixX3d format_angles(const PoseMatrix& poses, int joint, MotionFormat format) {
  const bool bvh = format == MotionFormat::bvh;
  Eigen::MatrixX3d result(poses.rows(), 3);
  Vector3d last = Vector3d::Zero();
  for (long i = 0; i < poses.rows(); ++i) {
    if (joint != hips && (!bvh || turns_zyx(joint))) {
      result.row(i) = poses.row(i).segment<3>(angle_column(joint));
      continue;
    }
    const Matrix3d turn =
        joint == hips
            ? root_of(poses, i)
            : joint_rotation(joint, poses.row(i).segment<3>(angle_column(joint)).transpose());
    last = bvh ? follow(angles_zxy(turn), 0, last) : follow(angles_zyx(turn), 1, last);
    result.row(i) = last.transpose();
  }
  return result;
}

double rounded(double value) {
  constexpr double scale = 1e4;  // 10^file_decimals
  static_assert(file_decimals == 4);
  return std::round(value * scale) / scale + 0.0;  // + 0.0: no negative zero
}

}  // namespace

ChannelMatrix make_channels(const PoseMatrix& poses, const Skeleton& skeleton) {
  ChannelMatrix channels = ChannelMatrix::Zero(poses.rows(), skeleton.channel_count);
  const double unit = skeleton.format == MotionFormat::bvh ? bvh_unit : asf_unit;
  for (const Joint& joint : skeleton.joints) {
    const int source = body_joint(joint, skeleton.format);
    if (source < 0) continue;
    const Eigen::MatrixX3d angles = format_angles(poses, source, skeleton.format);
    for (std::size_t c = 0; c < joint.channels.size(); ++c) {
      const int axis = axis_of(joint.channels[c]);
      const bool turns = is_rotation(joint.channels[c]);
      for (long i = 0; i < poses.rows(); ++i) {
        channels(i, joint.first_channel + static_cast<long>(c)) =
            rounded(turns ? angles(i, axis) : poses(i, root_x + axis) / unit);
      }
    }
  }
  return channels;
}

}  // namespace reprise::synth
