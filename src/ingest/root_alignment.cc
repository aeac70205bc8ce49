#include "ingest/root_alignment.h"

#include <cassert>
#include <cmath>
#include <numbers>

#include "ingest/rotation_angles.h"

namespace reprise {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace {

Matrix3d about_vertical(double radians) { return axis_rotation(1, radians); }

/// World frame of the joint above the root joint, of one frame of channels.
JointFrame frame_above(const Skeleton& skeleton, int root_joint, std::span<const double> channels) {
  const int above = skeleton.joints[root_joint].parent;
  if (above < 0) return {Matrix3d::Identity(), Vector3d::Zero()};
  std::vector<JointFrame> frames(skeleton.joints.size());
  forward_kinematics(skeleton, channels, frames);
  return frames[above];
}

}  // namespace

Matrix3d home_orientation(int up_axis) { return turn_to_y(static_cast<UpAxis>(up_axis)); }

Matrix3d from_home_orientation(int up_axis, UpAxis world_up) {
  return (home_orientation(up_axis) * turn_to_y(world_up)).transpose();
}

double heading_of(const Matrix3d& rotation) {
  // Twist about Y of the unit quaternion (x, y, z, w): 2 atan2(y, w).
  return std::atan2(rotation(0, 2) - rotation(2, 0), rotation(0, 0) + rotation(2, 2));
}

AlignedRoot align_root(const MarkerLayout& layout, const Take& take) {
  const Skeleton& skeleton = *take.skeleton;
  const long count = take.frames();
  AlignedRoot result;
  result.aligned.assign(count, Matrix3d::Identity());
  if (!layout.root_aligned) return result;
  RootTrack& track = result.track;
  track.place.resize(count, 3);
  track.heading.resize(count);
  std::vector<JointFrame> frames(skeleton.joints.size());
  std::vector<Matrix3d> world(count);
  const Matrix3d to_y = turn_to_y(skeleton.up);
  const Matrix3d from_home = from_home_orientation(layout.choices.up_axis, skeleton.up);
  for (long f = 0; f < count; ++f) {
    forward_kinematics(skeleton, {take.channels.row(f).data(), std::size_t(skeleton.channel_count)},
                       frames);
    const JointFrame& root = frames[layout.choices.root_joint];
    world[f] = to_y * root.rotation;
    track.place.row(f) = (to_y * root.position).transpose();
    const Quaterniond q(Matrix3d(world[f] * from_home));
    track.tumbles |= std::hypot(q.y(), q.w()) < AlignmentConstants::least_upright_cosine;
  }
  if (track.tumbles) {
    track.heading.resize(0);
    track.orientation.resize(count, 4);
    Quaterniond previous = Quaterniond::Identity();
    for (long f = 0; f < count; ++f) {
      Quaterniond q(world[f]);
      if (q.dot(previous) < 0) q.coeffs() = -q.coeffs();
      track.orientation.row(f) = q.coeffs().transpose();
      previous = q;
    }
    return result;
  }
  double previous = 0;
  for (long f = 0; f < count; ++f) {
    double heading = heading_of(world[f] * from_home);
    heading += 2 * std::numbers::pi * std::round((previous - heading) / (2 * std::numbers::pi));
    track.heading[f] = previous = heading;
    result.aligned[f] = about_vertical(-heading) * world[f];
  }
  return result;
}

Matrix3d world_orientation(const RootTrack& track, long frame, const Matrix3d& aligned) {
  if (track.tumbles) {
    const Quaterniond q(Eigen::Vector4d(track.orientation.row(frame)));
    return q.norm() > 1e-9 ? q.normalized().toRotationMatrix() : Matrix3d::Identity();
  }
  return about_vertical(track.heading[frame]) * aligned;
}

void write_root_channels(const MarkerLayout& layout, const Skeleton& skeleton,
                         const Vector3d& place_y_up, const Matrix3d& world_y_up,
                         std::span<double> channels, std::array<double, 3>& previous) {
  assert(layout.root_aligned);
  const Matrix3d from_y = turn_to_y(skeleton.up).transpose();
  const Vector3d place = from_y * place_y_up;
  const Matrix3d world = from_y * world_y_up;
  const Joint& root = skeleton.joints[layout.choices.root_joint];
  const JointFrame above = frame_above(skeleton, layout.choices.root_joint, channels);
  const Matrix3d local = root.axis.transpose() * above.rotation.transpose() * world * root.axis;
  const auto& order = root.rotation_order;
  previous = nearest_euler_angles(local, {order[0], order[1], order[2]}, previous);
  const auto rotations = rotation_channels(root);
  for (int k = 0; k < 3; ++k) {
    channels[rotations[k].channel] = previous[k] * 180.0 / std::numbers::pi;
  }
  Vector3d moved = above.rotation.transpose() * (place - above.position);
  if (skeleton.format == MotionFormat::asf_amc) {
    // Position channels of a bone add to where its offset puts it, along its own axes.
    moved = root.axis.transpose() * (moved - root.offset * skeleton.millimetres_per_unit);
  }
  for (std::size_t c = 0; c < root.channels.size(); ++c) {
    if (is_position(root.channels[c])) {
      channels[root.first_channel + static_cast<int>(c)] =
          moved[axis_of(root.channels[c])] / skeleton.millimetres_per_unit;
    }
  }
}

}  // namespace reprise
