#include "refine/joint_placement.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "model/angle_units.h"

namespace reprise {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

void turn(Matrix3d& rotation, int axis, double sine, double cosine) {
  const int j = (axis + 1) % 3, k = (axis + 2) % 3;
  const Vector3d old_j = rotation.col(j);
  rotation.col(j) = cosine * old_j + sine * rotation.col(k);
  rotation.col(k) = cosine * rotation.col(k) - sine * old_j;
}

/// The bone of an ASF joint, stretched; in the file's unit.
Vector3d bone_of(const Joint& joint, std::span<const double> channels) {
  const double length = joint.offset.norm();
  if (length <= 0) return joint.offset;
  for (std::size_t c = 0; c < joint.channels.size(); ++c) {
    if (joint.channels[c] == Channel::length) {
      return joint.offset *
             (1 + channels[static_cast<std::size_t>(joint.first_channel) + c] / length);
    }
  }
  return joint.offset;
}

/// Where a joint is in its parent's frame before its own turns; in the file's unit.
Vector3d translation(const Joint& joint, MotionFormat format, std::span<const double> channels) {
  Vector3d result = format == MotionFormat::bvh ? joint.offset : Vector3d(Vector3d::Zero());
  for (std::size_t c = 0; c < joint.channels.size(); ++c) {
    if (is_position(joint.channels[c])) {
      result[axis_of(joint.channels[c])] =
          channels[static_cast<std::size_t>(joint.first_channel) + c];
    }
  }
  return result;
}

std::span<const double> frame_of(const Take& take, Index f) {
  return {take.channels.row(f).data(), static_cast<std::size_t>(take.channels.cols())};
}

}  // namespace

JointPlacement::JointPlacement(const Take& take, const CodingOrder& order)
    : take_(take),
      order_(order),
      sine_(take.frames(), static_cast<Index>(order.size())),
      cosine_(take.frames(), static_cast<Index>(order.size())) {
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto radians = take.channels.col(order.channels[i]).array() * radians_per_degree;
    sine_.col(static_cast<Index>(i)) = radians.sin().cast<float>();
    cosine_.col(static_cast<Index>(i)) = radians.cos().cast<float>();
  }
  progress_.source.resize(static_cast<std::size_t>(take.frames()));
  progress_.decoded.resize(static_cast<std::size_t>(take.frames()));
}

void JointPlacement::begin(std::size_t j) { begin(j, {}, {}); }

void JointPlacement::begin(std::size_t j, std::span<const JointFrame> source,
                           std::span<const JointFrame> decoded) {
  joint_ = j;
  const Skeleton& skeleton = *take_.skeleton;
  const Joint& joint = skeleton.joints[j];
  const bool asf = skeleton.format == MotionFormat::asf_amc, root = joint.parent < 0;
  has_bone_ = !asf || root;
  const bool moves = std::ranges::any_of(joint.channels, is_position);
  // Most bones of an ASF skeleton begin where their parent ends.
  const bool apart = !asf || root || moves;
  Vector3d shift = moves ? Vector3d(Vector3d::Zero()) : translation(joint, skeleton.format, {});
  for (Index f = 0; f < take_.frames(); ++f) {
    const std::span<const double> frame = frame_of(take_, f);
    if (moves) shift = translation(joint, skeleton.format, frame);
    const Vector3d bone = asf && root ? bone_of(joint, frame) : Vector3d(Vector3d::Zero());
    const auto at = static_cast<std::size_t>(f);
    const auto start = [&](const JointFrame* above) {
      JointFrame result{Matrix3d::Identity(), Vector3d::Zero()};
      if (above != nullptr) result = *above;
      if (asf) result.rotation *= joint.axis;
      if (apart) {
        result.position += skeleton.millimetres_per_unit * (result.rotation * shift + bone);
      }
      return result;
    };
    progress_.source[at] = start(source.empty() ? nullptr : &source[at]);
    progress_.decoded[at] = start(decoded.empty() ? nullptr : &decoded[at]);
  }
}

void JointPlacement::come_to(int slot) {
  const Joint& joint = take_.skeleton->joints[joint_];
  if (joint.channels[static_cast<std::size_t>(slot)] == Channel::length && !has_bone_) add_bone();
}

void JointPlacement::add_bone() {
  const Joint& joint = take_.skeleton->joints[joint_];
  for (Index f = 0; f < take_.frames(); ++f) {
    const Vector3d bone = take_.skeleton->millimetres_per_unit *
                          (joint.axis.transpose() * bone_of(joint, frame_of(take_, f)));
    for (auto* frames : {&progress_.source, &progress_.decoded}) {
      JointFrame& frame = (*frames)[static_cast<std::size_t>(f)];
      frame.position += frame.rotation * bone;
    }
  }
  has_bone_ = true;
}

void JointPlacement::turn_by(std::size_t place, int axis,
                             const Eigen::Ref<const Eigen::VectorXd>& degrees) {
  const auto column = static_cast<Index>(place);
  // Many channels hardly ever move.
  double last = std::numeric_limits<double>::quiet_NaN(), sine = 0, cosine = 1;
  for (Index f = 0; f < take_.frames(); ++f) {
    if (degrees[f] != last) {
      last = degrees[f];
      sine = std::sin(last * radians_per_degree);
      cosine = std::cos(last * radians_per_degree);
    }
    const auto at = static_cast<std::size_t>(f);
    turn(progress_.decoded[at].rotation, axis, sine, cosine);
    turn(progress_.source[at].rotation, axis, static_cast<double>(sine_(f, column)),
         static_cast<double>(cosine_(f, column)));
  }
}

void JointPlacement::apply(int slot, std::size_t place,
                           const Eigen::Ref<const Eigen::VectorXd>& decoded) {
  const Joint& joint = take_.skeleton->joints[joint_];
  const auto kind = joint.channels[static_cast<std::size_t>(slot)];
  if (is_rotation(kind)) {
    turn_by(place, axis_of(kind), decoded);
    return;
  }
  Vector3d along = Vector3d::Zero();
  if (is_position(kind)) along[axis_of(kind)] = 1;
  if (kind == Channel::length && joint.offset.norm() > 0) {
    along = joint.offset.normalized();
    if (joint.parent >= 0) along = joint.axis.transpose() * along;
  }
  const bool fixed = kind == Channel::length && joint.parent < 0;
  for (Index f = 0; f < take_.frames(); ++f) {
    JointFrame& frame = progress_.decoded[static_cast<std::size_t>(f)];
    const Vector3d moved = take_.skeleton->millimetres_per_unit *
                           (decoded[f] - take_.channels(f, order_.channels[place])) * along;
    frame.position += fixed ? moved : Vector3d(frame.rotation * moved);
  }
}

void JointPlacement::apply_constant(int slot) {
  const Joint& joint = take_.skeleton->joints[joint_];
  const auto kind = joint.channels[static_cast<std::size_t>(slot)];
  // A place or a stretch is that of the source already.
  if (!is_rotation(kind) || take_.frames() == 0) return;
  const double radians = take_.channels(0, joint.first_channel + slot) * radians_per_degree;
  const double sine = std::sin(radians), cosine = std::cos(radians);
  for (auto* frames : {&progress_.source, &progress_.decoded}) {
    for (JointFrame& frame : *frames) turn(frame.rotation, axis_of(kind), sine, cosine);
  }
}

void JointPlacement::end(std::vector<JointFrame>& decoded) {
  if (!has_bone_) add_bone();
  const Joint& joint = take_.skeleton->joints[joint_];
  if (take_.skeleton->format == MotionFormat::asf_amc) {
    for (JointFrame& frame : progress_.decoded) frame.rotation *= joint.axis.transpose();
  }
  std::swap(decoded, progress_.decoded);
}

}  // namespace reprise
