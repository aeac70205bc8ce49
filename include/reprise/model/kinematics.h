// From channels to places in the world.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "reprise/model/skeleton.h"
#include "reprise/model/take.h"

namespace reprise {

/// Where a joint is and how it is turned, in world axes; the place in millimetres.
struct JointFrame {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

/// frames x 3*joints, row-major, in millimetres: x, y, z of each joint and end site in file order.
using PositionMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Rotation about a coordinate axis (0, 1, 2 for X, Y, Z) by an angle in radians.
Eigen::Matrix3d axis_rotation(int axis, double radians);

/// The rotation that brings an axis to Y: of the world's, what points up.
Eigen::Matrix3d turn_to_y(UpAxis axis);

/// One frame without rotations, with the position channels of a BVH at the offsets of their joints:
/// how the skeleton's text says that the body stands.
ChannelMatrix rest_channels(const Skeleton& skeleton);

/// The product E of a joint's rotation channels (skeleton.h); `channels` is a whole frame.
Eigen::Matrix3d local_rotation(const Joint& joint, std::span<const double> channels);

/// Forward kinematics of one joint below its parent (below the world: JointFrame{}). `channels` is
/// a whole frame. `axes` is empty, or receives for each of the joint's rotations, outermost first,
/// the unit vector in the world that it turns about.
JointFrame place_joint(const Skeleton& skeleton, const Joint& joint,
                       std::span<const double> channels, const JointFrame& parent,
                       std::span<Eigen::Vector3d> axes = {});

/// Forward kinematics of one frame. `channels` has skeleton.channel_count numbers, `joints`
/// receives one frame a joint.
void forward_kinematics(const Skeleton& skeleton, std::span<const double> channels,
                        std::span<JointFrame> joints);

/// Forward kinematics of every frame.
PositionMatrix joint_positions(const Skeleton& skeleton, const ChannelMatrix& channels);

}  // namespace reprise
