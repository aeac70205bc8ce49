#include "ingest/joint_angles.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "ingest/axis_turns.h"
#include "ingest/rotation_angles.h"
#include "ingest/virtual_markers.h"
#include "model/angle_units.h"
#include "reprise/model/kinematics.h"

namespace reprise {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Orthonormal axes with `first` along the first and `second` in the plane of the first two.
/// Vectors too short or too alike to say so (a coarse decode may bring any) get some axes all the
/// same.
Matrix3d basis(const Vector3d& first, const Vector3d& second) {
  constexpr double too_short = 1e-9;
  Matrix3d result;
  const double length = first.norm();
  result.col(0) = length > too_short ? Vector3d((1 / length) * first) : Vector3d::UnitX();
  Vector3d rest = second - second.dot(result.col(0)) * result.col(0);
  double rest_length = rest.norm();
  if (rest_length <= too_short) {
    rest = result.col(0).unitOrthogonal();
    rest_length = 1;
  }
  result.col(1) = (1 / rest_length) * rest;
  result.col(2) = result.col(0).cross(result.col(1));
  return result;
}

/// One target along the bone and one off it, which gives the turn about the bone.
bool off_bone_pair(const MarkerLayout& layout, const DrivenJoint& driven) {
  return driven.targets.size() == 2 && layout.markers[driven.targets[1].marker].off_bone;
}

}  // namespace

JointAngleSolver::JointAngleSolver(const MarkerLayout& layout, std::span<const double> start,
                                   const ChannelConstants& constants)
    : layout_(layout),
      angles_(start.begin(), start.end()),
      rotations_(layout.reference.joints.size(), Matrix3d::Identity()),
      positions_(layout.reference.joints.size(), Vector3d::Zero()),
      driven_of_joint_(layout.reference.joints.size(), -1) {
  for (std::size_t c = 0; c < constants.size(); ++c) {
    if (constants[c]) angles_[c] = *constants[c];
  }
  for (double& angle : angles_) angle /= degrees_per_radian;
  for (const DrivenJoint& driven : layout.driven) {
    rotation_channels_.push_back(driven.rotations);
    for (RotationChannel& rotation : rotation_channels_.back()) {
      const auto channel = static_cast<std::size_t>(rotation.channel);
      if (channel < constants.size() && constants[channel]) rotation.active = false;
    }
  }
  for (std::size_t d = 0; d < layout.driven.size(); ++d) {
    const DrivenJoint& driven = layout.driven[d];
    driven_of_joint_[driven.joint] = static_cast<int>(d);
    const Matrix3d to_axes = layout.reference.joints[driven.joint].axis.transpose();
    TargetsAtRest rest;
    for (const OrientationTarget& target : driven.targets) {
      rest.directions.emplace_back(to_axes * target.local);
    }
    if (off_bone_pair(layout, driven)) {
      rest.to_basis = basis(rest.directions[0], rest.directions[1]).transpose();
    }
    at_rest_.push_back(std::move(rest));
  }
}

void JointAngleSolver::look_near(std::size_t index, std::span<const double> degrees) {
  const DrivenJoint& driven = layout_.driven[index];
  // Chains of more rotations than that are not told where to look, but by damaged bytes.
  const std::size_t count = std::min(degrees.size(), driven.rotations.size());
  for (std::size_t k = 0; k < count; ++k) {
    angles_[driven.rotations[k].channel] = degrees[k] / degrees_per_radian;
  }
}

Matrix3d JointAngleSolver::seen_rotation(std::size_t index, std::span<const double> markers,
                                         const Matrix3d& to_local, const Vector3d& centre) const {
  const DrivenJoint& driven = layout_.driven[index];
  const TargetsAtRest& rest = at_rest_[index];
  const auto seen = [&](const OrientationTarget& target) -> Vector3d {
    const Vector3d place = Eigen::Map<const Vector3d>(markers.data() + 3 * target.marker);
    return to_local * (layout_.markers[target.marker].off_bone ? place : Vector3d(place - centre));
  };
  const auto& targets = driven.targets;
  if (off_bone_pair(layout_, driven)) {
    return basis(seen(targets[0]), seen(targets[1])) * rest.to_basis;
  }
  Matrix3d correlation = Matrix3d::Zero();
  for (std::size_t t = 0; t < targets.size(); ++t) {
    correlation += seen(targets[t]) * rest.directions[t].transpose();
  }
  return targets.size() > 1 ? nearest_rotation(correlation) : correlation;
}

Matrix3d JointAngleSolver::solve_joint(std::size_t index, std::span<const double> markers,
                                       const Matrix3d& parent, const Vector3d& centre,
                                       std::span<double> channels) {
  const DrivenJoint& driven = layout_.driven[index];
  // Joints of a BVH have no axes of their own.
  const bool has_axis = layout_.reference.format == MotionFormat::asf_amc;
  const Matrix3d& axis = layout_.reference.joints[driven.joint].axis;
  const Matrix3d to_world = has_axis ? Matrix3d(parent * axis) : parent;
  Matrix3d local = seen_rotation(index, markers, to_world.transpose(), centre);
  const std::vector<RotationChannel>& rotations = rotation_channels_[index];
  if (turns_about_three_axes(rotations)) {
    const auto& r = rotations;
    const EulerAngles previous = {angles_[r[0].channel], angles_[r[1].channel],
                                  angles_[r[2].channel]};
    const EulerAngles now =
        nearest_euler_angles(local, {r[0].axis, r[1].axis, r[2].axis}, previous);
    for (int k = 0; k < 3; ++k) angles_[r[k].channel] = now[k];
  } else {
    local = fit_axis_turns(rotations, local, angles_);
  }
  for (const RotationChannel& rotation : rotations) {
    channels[rotation.channel] = angles_[rotation.channel] * degrees_per_radian;
  }
  const Matrix3d turned = to_world * local;
  return has_axis ? Matrix3d(turned * axis.transpose()) : turned;
}

Matrix3d JointAngleSolver::solve(std::span<const double> markers, const Matrix3d* known_root,
                                 std::span<double> channels) {
  const auto& joints = layout_.reference.joints;
  const bool asf = layout_.reference.format == MotionFormat::asf_amc;
  const auto root = static_cast<std::size_t>(layout_.choices.root_joint);
  for (const int channel : layout_.direct_channels) {
    angles_[channel] = channels[channel] / degrees_per_radian;
  }
  for (std::size_t j = root; j < joints.size(); ++j) {
    if (!layout_.under_root[j]) continue;
    const int d = driven_of_joint_[j];
    if (j == root) {
      rotations_[j].setIdentity();
      if (known_root != nullptr) {
        rotations_[j] = *known_root;
      } else if (d >= 0) {
        // Seen without the root's own axes: its channels are found once the heading is known.
        const Matrix3d& axis = joints[j].axis;
        rotations_[j] = axis *
                        seen_rotation(static_cast<std::size_t>(d), markers, axis.transpose(),
                                      Vector3d::Zero()) *
                        axis.transpose();
      }
      continue;
    }
    const Matrix3d& parent = rotations_[joints[j].parent];
    const Vector3d& parent_place = positions_[joints[j].parent];
    const Vector3d centre =
        asf ? parent_place : Vector3d(parent_place + parent * layout_.offsets[j]);
    if (d >= 0) {
      rotations_[j] = solve_joint(static_cast<std::size_t>(d), markers, parent, centre, channels);
    } else {
      Matrix3d local = Matrix3d::Identity();
      for (const RotationChannel& rotation : rotation_channels(joints[j])) {
        local *= axis_rotation(rotation.axis, angles_[rotation.channel]);
      }
      rotations_[j] = parent * joints[j].axis * local * joints[j].axis.transpose();
    }
    positions_[j] = asf ? Vector3d(parent_place + rotations_[j] * layout_.offsets[j]) : centre;
  }
  return rotations_[root];
}

}  // namespace reprise
