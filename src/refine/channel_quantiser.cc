#include "refine/channel_quantiser.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "model/written_channels.h"
#include "quant/catmull_rom.h"
#include "refine/knot_rounding.h"

namespace reprise {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;

/// Turns about a straight limb move nothing, up to some angle: beyond it compensation, which is
/// linear, goes wrong. The arm (mm) that holds them grows with the root of the bound (mm).
constexpr double arm_at_one_mm = 20;
/// Where first order explains less of a distance, turns are too large for it.
constexpr double least_explained = 0.7;
/// Axis times angle of a rotation; a half turn and more count as a little less.
Vector3d turn_vector(const Matrix3d& from, const Matrix3d& to) {
  const Matrix3d relative = to * from.transpose();
  const Vector3d twice(relative(2, 1) - relative(1, 2), relative(0, 2) - relative(2, 0),
                       relative(1, 0) - relative(0, 1));
  // angle / sine as a series of 1 - cosine.
  const double u = std::clamp(1.5 - 0.5 * relative.trace(), 0.0, 1.0);
  return 0.5 * (1 + u * (1.0 / 3 + u * (2.0 / 15 + u * (2.0 / 35)))) * twice;
}

}  // namespace

ChannelQuantiser::ChannelQuantiser(const Take& take, double bound_mm)
    : take_(take),
      order_(coding_order(*take.skeleton)),
      parents_(coding_parents(*take.skeleton)),
      last_(moving_places(*take.skeleton)),
      channels_(order_.size()),
      sources_(take.frames(), take.channels.cols()),
      decoded_(take.frames(), take.channels.cols()),
      bodies_(take.skeleton->joints.size()),
      written_(written_joints(*take.skeleton, take.layout)),
      placement_(take) {
  const Index frames = take.frames();
  for (std::size_t i = 0; i < order_.size(); ++i) {
    Trajectory& channel = channels_[i];
    channel.motion.resize(frames, 6);
    channel.compensation.resize(frames, 6);
    channel.residual.resize(frames);
    channel.weight.resize(frames);
    sources_.col(static_cast<Index>(i)) = take.channels.col(order_[i]);
  }
  for (PlacedJoint& body : bodies_) {
    body.source.resize(index(frames));
    body.decoded.resize(index(frames));
  }
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

std::vector<bool> ChannelQuantiser::settled_joints(const CodedChannels& coded) const {
  std::vector<bool> settled(bodies_.size(), false);
  if (!done_ || done_->scales != coded.scales) return settled;
  const StepGrid &steps = coded.steps, &before = done_->steps;
  std::size_t place = 0;
  for (std::size_t j = 0; j < bodies_.size(); ++j) {
    const Joint& joint = take_.skeleton->joints[j];
    bool same = joint.parent < 0 || settled[static_cast<std::size_t>(joint.parent)];
    for (std::size_t c = 0; c < joint.channels.size(); ++c, ++place) {
      const int group = steps.group(place);
      same = same && steps.base[place] == before.base[place] &&
             steps.offsets.col(group) == before.offsets.col(group);
    }
    settled[j] = same;
  }
  return settled;
}

ChannelMatrix ChannelQuantiser::quantise(CodedChannels& coded) {
  const std::vector<bool> settled = settled_joints(coded);
  std::size_t place = 0;
  for (std::size_t j = 0; j < bodies_.size(); ++j) {
    const std::size_t count = take_.skeleton->joints[j].channels.size();
    if (settled[j]) {
      for (std::size_t i = place; i < place + count; ++i) take_over(i, coded);
    } else {
      quantise_joint(j, place, coded);
    }
    place += count;
  }
  done_ = coded;
  ChannelMatrix result(take_.frames(), take_.channels.cols());
  for (std::size_t i = 0; i < order_.size(); ++i) {
    result.col(order_[i]) = decoded_.col(static_cast<Index>(i));
  }
  return result;
}

void ChannelQuantiser::take_over(std::size_t place, CodedChannels& coded) const {
  const auto column = static_cast<Index>(place);
  coded.knots.col(column) = done_->knots.col(column);
  if (coded.steps.base[place] < 0) store(place, coded);
}

void ChannelQuantiser::store(std::size_t place, CodedChannels& coded) const {
  const auto column = static_cast<Index>(place);
  coded.steps.base[place] = -1;
  coded.knots.col(column).setZero();
  if (coded.stored.cols() == 0) {
    coded.stored = MatrixXd::Zero(take_.frames(), coded.knots.cols());
  }
  coded.stored.col(column) = sources_.col(column);
}

/// In the order of PoseMetric: place, turns, and for ASF the bone and its stretch.
void ChannelQuantiser::quantise_joint(std::size_t j, std::size_t place, CodedChannels& coded) {
  const Joint& joint = take_.skeleton->joints[j];
  placement_.begin(j,
                   joint.parent < 0 ? nullptr : &bodies_[static_cast<std::size_t>(joint.parent)]);
  for (const int slot : slots_outwards(joint)) {
    placement_.come_to(slot);
    expect(place);
    quantise_channel(place, written_[j], coded);
    placement_.apply(slot, place, decoded_.col(static_cast<Index>(place)));
    ++place;
  }
  placement_.end(bodies_[j].decoded);
}

/// The twist of what is placed so far says what the channel had better be off.
void ChannelQuantiser::expect(std::size_t place) {
  const PlacedJoint& progress = placement_.progress();
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

void ChannelQuantiser::quantise_channel(std::size_t i, bool written, CodedChannels& coded) {
  Trajectory& channel = channels_[i];
  const auto place = static_cast<Index>(i);
  const auto source = sources_.col(place);
  MatrixXd column = source - channel.residual.cast<double>();
  // It has no numbers in a file that could make up for others.
  if (!written) column = source;
  NestedKnots::from_frames(column, coded.shape.levels);
  if (coded.steps.base[i] < 0 || !round_knots(column, i, coded)) store(i, coded);
  decoded_.col(place) = coded.trajectory(i);
  channel.residual += (decoded_.col(place) - source).cast<float>();
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
