// Which points stand for a skeleton's posture. lin-2011 section 3: joint angles become points in
// space, because principal component analysis is close to linear there.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "reprise/model/skeleton.h"

namespace reprise {

/// Constants of the marker layout.
struct MarkerConstants {
  /// Distance of an off-bone marker from its joint (mm). lin-2011 leaves it open; see
  /// docs/findings/2026-11-24-preview-coder.md.
  static constexpr double off_bone_mm = 60.0;
  /// A bone shorter than this (mm) carries no direction; its joint gets markers of its own.
  static constexpr double short_bone_mm = 15.0;
  /// Two directions closer than this (sine of their angle) count as one.
  static constexpr double parallel_sine = 0.4;
};

/// A point that moves with the skeleton: the place of a joint, or a point off the bone.
struct Marker {
  int joint = 0;
  bool off_bone = false;
  Eigen::Vector3d local{0, 0, 0};  ///< off-bone: in the joint's frame, from the joint's centre, mm
};

/// One direction that is fixed in a joint's frame and seen as a marker.
struct OrientationTarget {
  int marker = 0;
  Eigen::Vector3d local;  ///< from the joint's centre, in the joint's frame, mm
};

/// One rotation channel of a joint, in the order of the product of rotations.
struct RotationChannel {
  int axis = 0;
  int channel = 0;      ///< index in a frame
  bool active = false;  ///< it changes; else it keeps its value of the layout
};

/// A joint whose orientation the markers carry.
struct DrivenJoint {
  int joint = 0;
  std::vector<RotationChannel> rotations;  ///< outermost first
  std::vector<OrientationTarget> targets;
};

/// What a set of takes decides about the layout of its skeleton; stored with the space.
struct LayoutChoices {
  bool through_markers = true;  ///< else every channel is coded as it is
  std::vector<bool> active;     ///< of each channel: it changes in some take
  int root_joint = 0;           ///< the joint that carries the motion through space
  int up_axis =
      1;  ///< axis of the root joint that points up: 0..2 for X, Y, Z, 3..5 for their opposites
};

/// Markers of one skeleton with one set of proportions (the reference), and how to get back.
struct MarkerLayout {
  Skeleton reference;
  std::vector<Eigen::Vector3d>
      offsets;  ///< of each joint, mm; joints with position channels keep `offset`
  LayoutChoices choices;
  bool root_aligned = false;  ///< the root joint has all six degrees of freedom
  std::vector<Marker> markers;
  std::vector<DrivenJoint> driven;   ///< parents before children
  std::vector<bool> under_root;      ///< of each joint: the root joint or below it
  std::vector<int> root_channels;    ///< of the aligned root joint: its channels
  std::vector<int> direct_channels;  ///< channels that are coded as they are, not through markers
  std::vector<double>
      direct_weight;             ///< of each: mm of all points together for one unit (mm or radian)
  double heading_weight_mm = 1;  ///< the same for a radian of heading
  double point_count = 1;        ///< joints and end sites that a step of the root moves

  int dimensions() const { return static_cast<int>(markers.size()) * 3; }
};

MarkerLayout make_marker_layout(const Skeleton& reference, const LayoutChoices& choices);

/// The rotation channels of a joint, outermost first, none active.
std::vector<RotationChannel> rotation_channels(const Joint& joint);

/// True for three active rotations about three different axes: Euler angles that any rotation has.
bool turns_about_three_axes(const std::vector<RotationChannel>& rotations);

}  // namespace reprise
