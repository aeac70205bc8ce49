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

std::vector<int> slots_outwards(const Joint& joint) {
  std::vector<int> slots;
  for (std::size_t c = 0; c < joint.channels.size(); ++c) {
    if (is_position(joint.channels[c])) slots.push_back(static_cast<int>(c));
  }
  slots.insert(slots.end(), joint.rotation_slots.begin(), joint.rotation_slots.end());
  for (std::size_t c = 0; c < joint.channels.size(); ++c) {
    if (joint.channels[c] == Channel::length) slots.push_back(static_cast<int>(c));
  }
  return slots;
}

std::vector<int> coding_order(const Skeleton& skeleton) {
  std::vector<int> order;
  for (const Joint& joint : skeleton.joints) {
    for (const int slot : slots_outwards(joint)) order.push_back(joint.first_channel + slot);
  }
  return order;
}

std::vector<int> coding_parents(const Skeleton& skeleton) {
  std::vector<int> parents, last(skeleton.joints.size(), -1);
  int place = 0;
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    const Joint& joint = skeleton.joints[j];
    int before = joint.parent < 0 ? -1 : last[joint.parent];
    for (std::size_t c = 0; c < joint.channels.size(); ++c) {
      parents.push_back(before);
      before = place++;
    }
    last[j] = before;
  }
  return parents;
}

std::vector<int> moving_places(const Skeleton& skeleton) {
  const std::vector<int> parents = coding_parents(skeleton);
  std::vector<int> result, last;
  int place = 0;
  for (const Joint& joint : skeleton.joints) {
    const auto count = static_cast<int>(joint.channels.size());
    const int above = joint.parent < 0 ? -1 : last[static_cast<std::size_t>(joint.parent)];
    // A BVH joint and a root turn about themselves.
    int moves = count > 0 ? place + count - 1 : above;
    if (skeleton.format == MotionFormat::bvh) {
      const auto turns = static_cast<int>(joint.rotation_order.size());
      moves = count > turns ? place + count - turns - 1 : above;
    }
    place += count;
    last.push_back(count > 0 ? place - 1 : above);
    result.push_back(moves);
  }
  return result;
}

PoseMetric::PoseMetric(const Skeleton& skeleton, double off_bone_mm)
    : skeleton_(skeleton),
      off_bone_mm_(off_bone_mm),
      frames_(skeleton.joints.size()),
      inertia_(skeleton.joints.size()) {
  int place = 0;
  for (const Joint& joint : skeleton.joints) {
    places_.emplace_back();
    for (std::size_t c = 0; c < joint.channels.size(); ++c) places_.back().push_back(place++);
  }
}

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
    const std::vector<int> slots = slots_outwards(joint);
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
      const Channel channel = joint.channels[slots[s]];
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
      ChannelMetric& metric = metrics[places_[j][s]];
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
