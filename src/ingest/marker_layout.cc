#include "ingest/marker_layout.h"

#include <Eigen/Geometry>
#include <cmath>

#include "ingest/channel_weights.h"

namespace reprise {
namespace {

using Eigen::Vector3d;

/// Points that are fixed in the frame of joint `j`: (joint of the point, place in j's frame).
std::vector<std::pair<int, Vector3d>> rigid_points(const MarkerLayout& layout, int j) {
  std::vector<std::pair<int, Vector3d>> points;
  if (layout.reference.format == MotionFormat::asf_amc && layout.reference.joints[j].parent >= 0) {
    points.emplace_back(j, layout.offsets[j]);
  } else if (layout.reference.format == MotionFormat::bvh) {
    for (int c = j + 1; c < static_cast<int>(layout.reference.joints.size()); ++c) {
      if (layout.reference.joints[c].parent == j) points.emplace_back(c, layout.offsets[c]);
    }
  } else {
    // The far ends of bones that cannot turn are fixed in the ASF root's frame.
    for (int c = j + 1; c < static_cast<int>(layout.reference.joints.size()); ++c) {
      const Joint& bone = layout.reference.joints[c];
      if (bone.parent == j && bone.channels.empty()) points.emplace_back(c, layout.offsets[c]);
    }
  }
  std::erase_if(points, [](const auto& point) {
    return point.second.norm() < MarkerConstants::short_bone_mm;
  });
  return points;
}

/// Axes about which the joint can turn at rest, in its own frame.
std::vector<Vector3d> turning_axes(const Joint& joint, const DrivenJoint& driven) {
  std::vector<Vector3d> axes;
  for (const RotationChannel& rotation : driven.rotations) {
    if (rotation.active) axes.push_back(joint.axis.col(rotation.axis));
  }
  return axes;
}

/// True if turning about `direction` is something that the joint can do.
bool can_twist_about(const std::vector<Vector3d>& axes, const Vector3d& direction) {
  if (axes.size() >= 3) return true;
  if (axes.size() == 1) return axes[0].cross(direction).norm() < MarkerConstants::parallel_sine;
  const Vector3d normal = axes[0].cross(axes[1]).normalized();
  return std::abs(normal.dot(direction)) < MarkerConstants::parallel_sine;
}

/// A unit vector across `direction`, as far as possible from the axis that is most along it.
Vector3d across(const Vector3d& direction) {
  int least = 0;
  direction.cwiseAbs().minCoeff(&least);
  return direction.cross(Vector3d::Unit(least)).normalized();
}

class LayoutBuilder {
 public:
  explicit LayoutBuilder(MarkerLayout& layout)
      : layout_(layout), point_marker_(layout.reference.joints.size(), -1) {}

  void add_joint(int j) {
    const Joint& joint = layout_.reference.joints[j];
    DrivenJoint driven{j, rotation_channels(joint), {}};
    for (RotationChannel& rotation : driven.rotations) {
      rotation.active = layout_.choices.active[rotation.channel];
    }
    if (j == layout_.choices.root_joint) {
      // The aligned root keeps a tilt, whatever its channels do.
      for (RotationChannel& rotation : driven.rotations) rotation.active = true;
    }
    const std::vector<Vector3d> axes = turning_axes(joint, driven);
    // Angles about axes that repeat are coded as they are: markers would give them back in another
    // way.
    if (axes.empty() || (axes.size() > 2 && !turns_about_three_axes(driven.rotations))) return;
    add_targets(driven, axes);
    layout_.driven.push_back(std::move(driven));
  }

 private:
  void add_targets(DrivenJoint& driven, const std::vector<Vector3d>& axes) {
    const auto points = rigid_points(layout_, driven.joint);
    Vector3d first = Vector3d::Zero();
    bool spans_a_plane = false;
    for (const auto& [joint, local] : points) {
      driven.targets.push_back({point_marker(joint), local});
      if (first.isZero()) first = local.normalized();
      spans_a_plane |= first.cross(local.normalized()).norm() > MarkerConstants::parallel_sine;
    }
    if (spans_a_plane) return;
    if (!first.isZero()) {
      if (can_twist_about(axes, first)) add_off_bone(driven, across(first));
      return;
    }
    // No bone to carry direction: markers b and c across the joint's axes.
    const Vector3d b = axes.size() == 1 ? across(axes[0]) : Vector3d(axes[0].normalized());
    add_off_bone(driven, b);
    if (axes.size() > 1) add_off_bone(driven, across(b));
  }

  int point_marker(int joint) {
    if (point_marker_[joint] < 0) {
      point_marker_[joint] = static_cast<int>(layout_.markers.size());
      layout_.markers.push_back({joint, false, Vector3d::Zero()});
    }
    return point_marker_[joint];
  }

  void add_off_bone(DrivenJoint& driven, const Vector3d& direction) {
    const Vector3d local = MarkerConstants::off_bone_mm * direction;
    driven.targets.push_back({static_cast<int>(layout_.markers.size()), local});
    layout_.markers.push_back({driven.joint, true, local});
  }

  MarkerLayout& layout_;
  std::vector<int> point_marker_;
};

bool has_six_degrees_of_freedom(const Joint& joint) {
  int positions = 0;
  for (const Channel channel : joint.channels) positions += is_position(channel);
  return positions == 3 && joint.rotation_order.size() == 3 &&
         joint.rotation_order[0] != joint.rotation_order[1] &&
         joint.rotation_order[1] != joint.rotation_order[2] &&
         joint.rotation_order[0] != joint.rotation_order[2];
}

}  // namespace

bool turns_about_three_axes(const std::vector<RotationChannel>& rotations) {
  if (rotations.size() != 3) return false;
  const bool active = rotations[0].active && rotations[1].active && rotations[2].active;
  return active && rotations[0].axis != rotations[1].axis &&
         rotations[1].axis != rotations[2].axis && rotations[0].axis != rotations[2].axis;
}

std::vector<RotationChannel> rotation_channels(const Joint& joint) {
  std::vector<RotationChannel> result;
  for (std::size_t k = 0; k < joint.rotation_order.size(); ++k) {
    result.push_back(
        {joint.rotation_order[k], joint.first_channel + joint.rotation_slots[k], false});
  }
  return result;
}

MarkerLayout make_marker_layout(const Skeleton& reference, const LayoutChoices& choices) {
  MarkerLayout layout;
  layout.reference = reference;
  layout.choices = choices;
  for (const Joint& joint : reference.joints) {
    layout.offsets.push_back(joint.offset * reference.millimetres_per_unit);
  }
  const Joint& root = reference.joints[choices.root_joint];
  layout.root_aligned = choices.through_markers && has_six_degrees_of_freedom(root);
  layout.under_root = joints_under(reference, choices.root_joint);
  LayoutBuilder builder(layout);
  for (std::size_t j = 0; j < reference.joints.size(); ++j) {
    const bool is_root = static_cast<int>(j) == choices.root_joint;
    if (choices.through_markers && layout.under_root[j] && (layout.root_aligned || !is_root)) {
      builder.add_joint(static_cast<int>(j));
    }
  }
  if (layout.root_aligned) {
    for (std::size_t c = 0; c < root.channels.size(); ++c) {
      layout.root_channels.push_back(root.first_channel + static_cast<int>(c));
    }
  }
  weigh_channels(layout);
  return layout;
}

}  // namespace reprise
