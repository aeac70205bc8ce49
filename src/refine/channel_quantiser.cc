#include "refine/channel_quantiser.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "quant/catmull_rom.h"

namespace reprise {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;

/// A knot is rounded up from 0.5 + this part of its step on: zeros cost least.
constexpr double dead_zone = 0.14;
/// Turns about a straight limb move nothing, up to some angle: beyond it compensation, which is
/// linear, goes wrong. The arm (mm) that holds them grows with the root of the bound (mm).
constexpr double arm_at_one_mm = 20;
/// Where first order explains less of a distance, turns are too large for it.
constexpr double least_explained = 0.7;
constexpr double degree = std::numbers::pi / 180.0;

void turn(Matrix3d& rotation, int axis, double sine, double cosine) {
  const int j = (axis + 1) % 3, k = (axis + 2) % 3;
  const Vector3d old_j = rotation.col(j);
  rotation.col(j) = cosine * old_j + sine * rotation.col(k);
  rotation.col(k) = cosine * rotation.col(k) - sine * old_j;
}

/// Axis times angle of a rotation; a half turn and more count as a little less.
Vector3d turn_vector(const Matrix3d& from, const Matrix3d& to) {
  const Matrix3d relative = to * from.transpose();
  const Vector3d twice(relative(2, 1) - relative(1, 2), relative(0, 2) - relative(2, 0),
                       relative(1, 0) - relative(0, 1));
  // angle / sine as a series of 1 - cosine.
  const double u = std::clamp(1.5 - 0.5 * relative.trace(), 0.0, 1.0);
  return 0.5 * (1 + u * (1.0 / 3 + u * (2.0 / 15 + u * (2.0 / 35)))) * twice;
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

}  // namespace

ChannelQuantiser::ChannelQuantiser(const Take& take, double bound_mm)
    : take_(take),
      order_(coding_order(*take.skeleton)),
      parents_(coding_parents(*take.skeleton)),
      last_(moving_places(*take.skeleton)),
      channels_(order_.size()),
      bodies_(take.skeleton->joints.size()) {
  const Index frames = take.frames();
  for (std::size_t i = 0; i < order_.size(); ++i) {
    Trajectory& channel = channels_[i];
    channel.motion.resize(frames, 6);
    channel.compensation.resize(frames, 6);
    channel.residual.resize(frames);
    channel.weight.resize(frames);
    channel.sine = (take.channels.col(order_[i]).array() * degree).sin().cast<float>();
    channel.cosine = (take.channels.col(order_[i]).array() * degree).cos().cast<float>();
  }
  const auto make_room = [&](Body& body) {
    body.source.resize(index(frames));
    body.decoded.resize(index(frames));
  };
  std::ranges::for_each(bodies_, make_room);
  make_room(progress_);
  PoseMetric metric(*take.skeleton, arm_at_one_mm * std::sqrt(bound_mm));
  const std::vector<double> weights(bodies_.size(), 1.0);
  std::vector<ChannelMetric> metrics(order_.size());
  std::vector<JointFrame> joints(bodies_.size());
  for (Index f = 0; f < frames; ++f) {
    const std::span<const double> frame(take.channels.row(f).data(), order_.size());
    metric.measure(frame, weights, metrics);
    for (std::size_t i = 0; i < order_.size(); ++i) {
      Trajectory& channel = channels_[i];
      channel.motion.row(f) = metrics[i].motion.cast<float>().transpose();
      channel.compensation.row(f) = metrics[i].compensation.cast<float>().transpose();
      channel.weight[f] = static_cast<float>(metrics[i].weight);
      channel.mean_weight += metrics[i].weight / static_cast<double>(frames);
    }
    forward_kinematics(*take.skeleton, frame, joints);
    for (std::size_t j = 0; j < joints.size(); ++j) bodies_[j].source[index(f)] = joints[j];
  }
}

void ChannelQuantiser::set_steps(double step_mm, StepGrid& steps) const {
  for (std::size_t i = 0; i < order_.size(); ++i) {
    steps.base[i] = step_index(step_mm / std::sqrt(channels_[i].mean_weight));
  }
}

ChannelMatrix ChannelQuantiser::quantise(CodedChannels& coded) {
  ChannelMatrix decoded(take_.frames(), take_.channels.cols());
  std::size_t place = 0;
  for (std::size_t j = 0; j < bodies_.size(); ++j) {
    place_joint(j, place, coded, decoded);
    place += take_.skeleton->joints[j].channels.size();
  }
  return decoded;
}

/// In the order of PoseMetric: place, turns, and for ASF the bone and its stretch.
void ChannelQuantiser::place_joint(std::size_t j, std::size_t place, CodedChannels& coded,
                                   ChannelMatrix& decoded) {
  const Skeleton& skeleton = *take_.skeleton;
  const Joint& joint = skeleton.joints[j];
  const bool asf = skeleton.format == MotionFormat::asf_amc, root = joint.parent < 0;
  const double scale = skeleton.millimetres_per_unit;
  // Most bones of an ASF skeleton begin where their parent ends.
  const bool apart = !asf || root || std::ranges::any_of(joint.channels, is_position);
  Body& progress = progress_;
  for (Index f = 0; f < take_.frames(); ++f) {
    const std::span<const double> frame(take_.channels.row(f).data(), order_.size());
    const Vector3d shift =
        apart ? translation(joint, skeleton.format, frame) : Vector3d(Vector3d::Zero());
    const Vector3d bone = asf && root ? bone_of(joint, frame) : Vector3d(Vector3d::Zero());
    const auto start = [&](const std::vector<JointFrame>* parent) {
      JointFrame result{Matrix3d::Identity(), Vector3d::Zero()};
      if (parent != nullptr) result = (*parent)[index(f)];
      if (asf) result.rotation *= joint.axis;
      if (apart) result.position += scale * (result.rotation * shift + bone);
      return result;
    };
    const Body* parent = root ? nullptr : &bodies_[static_cast<std::size_t>(joint.parent)];
    progress.source[index(f)] = start(root ? nullptr : &parent->source);
    progress.decoded[index(f)] = start(root ? nullptr : &parent->decoded);
  }
  bool has_bone = !asf || root;
  for (const int slot : slots_outwards(joint)) {
    if (joint.channels[static_cast<std::size_t>(slot)] == Channel::length && !has_bone) {
      add_bone(j, progress);
      has_bone = true;
    }
    expect(place, progress);
    quantise_channel(place, coded, decoded);
    apply(j, slot, place, decoded, progress);
    ++place;
  }
  if (!has_bone) add_bone(j, progress);
  for (JointFrame& frame : progress.decoded) {
    if (asf) frame.rotation *= joint.axis.transpose();
  }
  std::swap(bodies_[j].decoded, progress.decoded);
}

void ChannelQuantiser::add_bone(std::size_t j, Body& progress) const {
  const Joint& joint = take_.skeleton->joints[j];
  for (Index f = 0; f < take_.frames(); ++f) {
    const Vector3d bone =
        take_.skeleton->millimetres_per_unit *
        (joint.axis.transpose() * bone_of(joint, {take_.channels.row(f).data(), order_.size()}));
    for (auto* frames : {&progress.source, &progress.decoded}) {
      JointFrame& frame = (*frames)[index(f)];
      frame.position += frame.rotation * bone;
    }
  }
}

/// The twist of what is placed so far says what the channel had better be off.
void ChannelQuantiser::expect(std::size_t place, const Body& progress) {
  Trajectory& channel = channels_[place];
  for (Index f = 0; f < take_.frames(); ++f) {
    const JointFrame& source = progress.source[index(f)];
    const JointFrame& decoded = progress.decoded[index(f)];
    const Vector3d origin = bodies_.front().source[index(f)].position;
    Twist twist;
    twist.head<3>() = turn_vector(source.rotation, decoded.rotation);
    twist.tail<3>() =
        decoded.position - source.position - twist.head<3>().cross(source.position - origin);
    channel.residual[f] = channel.compensation.row(f).matrix().dot(twist.cast<float>().transpose());
  }
}

void ChannelQuantiser::quantise_channel(std::size_t i, CodedChannels& coded,
                                        ChannelMatrix& decoded) {
  const Index frames = take_.frames();
  const int levels = coded.shape.levels;
  Trajectory& channel = channels_[i];
  const auto place = static_cast<Index>(i);
  const auto source = take_.channels.col(order_[i]);
  MatrixXd column = source - channel.residual.cast<double>();
  NestedKnots::from_frames(column, levels);
  double coarsest = 0;
  bool wild = coded.steps.base[i] < 0;
  for (Index f = 0; f < frames && !wild; ++f) {
    const bool follows = knot_level(f, levels) == levels;
    const double step = coded.steps.step(i, f);
    const double value = (column(f, 0) - (follows ? coarsest : 0.0)) / step;
    const double magnitude = std::floor(std::abs(value) + (follows ? 0.5 : 0.5 - dead_zone));
    wild = !(magnitude < most_knot);
    if (wild) break;
    coded.knots(f, place) = static_cast<std::int32_t>(value < 0 ? -magnitude : magnitude);
    if (follows) coarsest += coded.knots(f, place) * step;
  }
  if (wild) {
    coded.steps.base[i] = -1;
    coded.knots.col(place).setZero();
    if (coded.stored.cols() == 0) coded.stored = MatrixXd::Zero(frames, coded.knots.cols());
    coded.stored.col(place) = source;
  }
  decoded.col(order_[i]) = coded.trajectory(i);
  channel.residual += (decoded.col(order_[i]) - source).cast<float>();
}

void ChannelQuantiser::apply(std::size_t j, int slot, std::size_t place,
                             const ChannelMatrix& decoded, Body& progress) const {
  const Skeleton& skeleton = *take_.skeleton;
  const Joint& joint = skeleton.joints[j];
  const Trajectory& own = channels_[place];
  const auto kind = joint.channels[static_cast<std::size_t>(slot)];
  Vector3d along = Vector3d::Zero();
  if (is_position(kind)) along[axis_of(kind)] = 1;
  if (kind == Channel::length && joint.offset.norm() > 0) {
    along = joint.offset.normalized();
    if (joint.parent >= 0) along = joint.axis.transpose() * along;
  }
  const bool fixed = kind == Channel::length && joint.parent < 0;
  for (Index f = 0; f < take_.frames(); ++f) {
    JointFrame& frame = progress.decoded[index(f)];
    const double value = decoded(f, order_[place]);
    if (is_rotation(kind)) {
      const double radians = value * degree;
      turn(frame.rotation, axis_of(kind), std::sin(radians), std::cos(radians));
      turn(progress.source[index(f)].rotation, axis_of(kind), static_cast<double>(own.sine[f]),
           static_cast<double>(own.cosine[f]));
      continue;
    }
    const Vector3d moved =
        skeleton.millimetres_per_unit * (value - take_.channels(f, order_[place])) * along;
    frame.position += fixed ? moved : Vector3d(frame.rotation * moved);
  }
}

PositionMatrix ChannelQuantiser::positions() const {
  PositionMatrix result(take_.frames(), 3 * static_cast<Index>(bodies_.size()));
  for (Index f = 0; f < take_.frames(); ++f) {
    for (std::size_t j = 0; j < bodies_.size(); ++j) {
      result.row(f).segment<3>(3 * static_cast<Index>(j)) =
          bodies_[j].decoded[index(f)].position.transpose();
    }
  }
  return result;
}

std::vector<double> ChannelQuantiser::shares(std::size_t joint, Index frame) const {
  std::vector<double> result(order_.size(), 0.0);
  const Vector3d direction = displacement(joint, frame).normalized();
  const Vector3d place =
      bodies_[joint].source[index(frame)].position - bodies_.front().source[index(frame)].position;
  // How much a twist at some place along the chain moves the joint after all later channels have
  // made up for it, as a row vector, from the joint inwards.
  Twist row;
  row << place.cross(direction), direction;
  for (int i = last_[joint]; i >= 0; i = parents_[static_cast<std::size_t>(i)]) {
    const Trajectory& channel = channels_[static_cast<std::size_t>(i)];
    const Twist motion = channel.motion.row(frame).matrix().cast<double>().transpose();
    const Twist compensation = channel.compensation.row(frame).matrix().cast<double>().transpose();
    const double reach = row.dot(motion);
    result[static_cast<std::size_t>(i)] = reach * static_cast<double>(channel.residual[frame]);
    row -= compensation * reach;
  }
  // Large turns that first order does not know of: what rounding did to the pose as a whole.
  const double explained = std::accumulate(result.begin(), result.end(), 0.0);
  if (explained < least_explained * displacement(joint, frame).norm()) {
    for (int i = last_[joint]; i >= 0; i = parents_[static_cast<std::size_t>(i)]) {
      const Trajectory& channel = channels_[static_cast<std::size_t>(i)];
      const double residual = channel.residual[frame];
      result[static_cast<std::size_t>(i)] = channel.weight[frame] * residual * residual;
    }
  }
  return result;
}

}  // namespace reprise
