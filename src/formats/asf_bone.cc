#include "formats/asf_bone.h"

#include "model/angle_units.h"
#include "reprise/model/kinematics.h"

namespace reprise {
namespace {

Eigen::Matrix3d axis_matrix(const AsfBone& bone, bool radians) {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  const double scale = radians ? 1.0 : radians_per_degree;
  for (const int axis : bone.axis_order)
    matrix = axis_rotation(axis, bone.axis_angles[axis] * scale) * matrix;
  return matrix;
}

}  // namespace

Joint joint_of(const AsfBone& bone, bool radians) {
  Joint joint;
  joint.name = bone.name;
  joint.offset = bone.direction * bone.length;
  joint.axis = axis_matrix(bone, radians);
  joint.channels = bone.degrees_of_freedom;
  // The last axis of the order turns last, so it stands outermost.
  for (auto axis = bone.axis_order.rbegin(); axis != bone.axis_order.rend(); ++axis) {
    for (std::size_t c = 0; c < joint.channels.size(); ++c) {
      if (!is_rotation(joint.channels[c]) || axis_of(joint.channels[c]) != *axis) continue;
      joint.rotation_order.push_back(*axis);
      joint.rotation_slots.push_back(static_cast<int>(c));
    }
  }
  return joint;
}

}  // namespace reprise
