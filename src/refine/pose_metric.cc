#include "refine/pose_metric.h"

#include <cmath>
#include <numbers>

#include "model/angle_units.h"

namespace reprise {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Inertia = Eigen::Matrix<double, 6, 6>;

constexpr double least_weight = 1e-9;

Matrix3d cross(const Vector3d& v) {
  Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

void add_point(Inertia& inertia, const Vector3d& place, double weight) {
  Eigen::Matrix<double, 3, 6> moved;
  moved << -cross(place), Matrix3d::Identity();
  inertia.noalias() += weight * moved.transpose() * moved;
}

Twist turning(const Vector3d& axis, const Vector3d& pivot) {
  Twist twist;
  twist << axis, pivot.cross(axis);
  return twist * radians_per_degree;
}

Twist shifting(const Vector3d& direction) {
  Twist twist;
  twist << Vector3d::Zero(), direction;
  return twist;
}

}  // namespace

PoseMetric::PoseMetric(const Skeleton& skeleton, const CodingOrder& order, double off_bone_mm)
    : skeleton_(skeleton),
      order_(order),
      off_bone_mm_(off_bone_mm),
      frames_(skeleton.joints.size()),
      inertia_(skeleton.joints.size()) {}

void PoseMetric::measure(std::span<const double> channels, std::span<const double> weights,
                         std::span<ChannelMetric> metrics) {
  forward_kinematics(skeleton_, channels, frames_);
  // Near the body, so that its inertia is not lost beside its distance from the world's origin.
  const Vector3d origin = frames_.front().position;
  for (Inertia& inertia : inertia_) inertia.setZero();
  const bool bvh = skeleton_.format == MotionFormat::bvh;
  for (std::size_t j = skeleton_.joints.size(); j-- > 0;) {
    const Joint& joint = skeleton_.joints[j];
    Inertia& inertia = inertia_[j];
    const JointFrame world{Matrix3d::Identity(), Vector3d::Zero()};
    const JointFrame& parent = joint.parent < 0 ? world : frames_[joint.parent];
    const Vector3d place = frames_[j].position - origin;
    const Matrix3d base = bvh ? parent.rotation : Matrix3d(parent.rotation * joint.axis);
    const std::vector<CodedSlot>& slots = order_.slots[j];
    // Pivot of an ASF bone: its parent's far end, moved by its own position channels.
    Vector3d pivot = place;
    if (!bvh && joint.parent >= 0) {
      Vector3d shift = Vector3d::Zero();
      for (std::size_t c = 0; c < joint.channels.size(); ++c) {
        if (is_position(joint.channels[c]))
          shift[axis_of(joint.channels[c])] = channels[joint.first_channel + c];
      }
      pivot = parent.position - origin + skeleton_.millimetres_per_unit * (base * shift);
    }
    // Axes of the turns, outermost first.
    std::vector<Vector3d> axes;
    Matrix3d turned = base;
    for (std::size_t k = 0; k < joint.rotation_order.size(); ++k) {
      axes.push_back(turned.col(joint.rotation_order[k]));
      turned *= axis_rotation(
          joint.rotation_order[k],
          channels[joint.first_channel + joint.rotation_slots[k]] * std::numbers::pi / 180.0);
    }
    if (!joint.rotation_order.empty()) {
      inertia.topLeftCorner<3, 3>().diagonal().array() += weights[j] * off_bone_mm_ * off_bone_mm_;
    }
    if (!bvh) add_point(inertia, place, weights[j]);
    std::size_t turn = axes.size();
    bool placed = !bvh;
    for (std::size_t s = slots.size(); s-- > 0;) {
      const Channel channel = joint.channels[static_cast<std::size_t>(slots[s].slot)];
      Twist motion;
      if (is_rotation(channel)) {
        motion = turning(axes[--turn], pivot);
      } else if (is_position(channel)) {
        if (!placed) add_point(inertia, place, weights[j]);
        placed = true;
        motion = shifting(skeleton_.millimetres_per_unit * base.col(axis_of(channel)));
      } else {
        const double length = joint.offset.norm();
        const Vector3d along =
            length > 0 ? Vector3d(joint.offset / length) : Vector3d(Vector3d::Zero());
        motion = shifting(skeleton_.millimetres_per_unit *
                          (joint.parent < 0 ? along : Vector3d(frames_[j].rotation * along)));
      }
      if (slots[s].place < 0) continue;
      ChannelMetric& metric = metrics[static_cast<std::size_t>(slots[s].place)];
      metric.motion = motion;
      const Twist momentum = inertia * motion;
      metric.weight = std::max(motion.dot(momentum), least_weight);
      metric.compensation = momentum / metric.weight;
      inertia.noalias() -= momentum * metric.compensation.transpose();
    }
    if (!placed) add_point(inertia, place, weights[j]);
    if (joint.parent >= 0) inertia_[joint.parent] += inertia;
  }
}

}  // namespace reprise
