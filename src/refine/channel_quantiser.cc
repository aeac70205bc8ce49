#include "refine/channel_quantiser.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "quant/catmull_rom.h"
#include "refine/knot_rounding.h"

namespace reprise {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;

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

ChannelQuantiser::ChannelQuantiser(const PreparedTake& prepared, double arm_mm)
    : take_(prepared.take),
      constants_(prepared.header.constants),
      order_(*take_.skeleton, moving_channels(constants_)),
      channels_(order_.size()),
      sources_(take_.frames(), static_cast<Index>(order_.size())),
      decoded_(take_.frames(), static_cast<Index>(order_.size())),
      source_poses_(pose_track(*take_.skeleton, take_.channels)),
      decoded_poses_(source_poses_),
      placement_(take_, order_) {
  const Take& take = take_;
  const Index frames = take.frames();
  for (std::size_t i = 0; i < order_.size(); ++i) {
    Trajectory& channel = channels_[i];
    channel.motion.resize(frames, 6);
    channel.compensation.resize(frames, 6);
    channel.residual.resize(frames);
    channel.weight.resize(frames);
    sources_.col(static_cast<Index>(i)) = take.channels.col(order_.channels[i]);
  }
  PoseMetric metric(*take.skeleton, order_, arm_mm);
  const std::vector<double> weights(source_poses_.size(), 1.0);
  std::vector<ChannelMetric> metrics(order_.size());
  for (Index f = 0; f < frames; ++f) {
    const std::span<const double> frame(take.channels.row(f).data(),
                                        static_cast<std::size_t>(take.channels.cols()));
    metric.measure(frame, weights, metrics);
    for (std::size_t i = 0; i < order_.size(); ++i) {
      Trajectory& channel = channels_[i];
      channel.motion.row(f) = metrics[i].motion.cast<float>().transpose();
      channel.compensation.row(f) = metrics[i].compensation.cast<float>().transpose();
      channel.weight[f] = static_cast<float>(metrics[i].weight);
      channel.mean_weight += metrics[i].weight / static_cast<double>(frames);
    }
  }
}

void ChannelQuantiser::set_steps(double step_mm, StepGrid& steps) const {
  for (std::size_t i = 0; i < order_.size(); ++i) {
    steps.base[i] = step_index(step_mm / std::sqrt(channels_[i].mean_weight));
  }
}

std::vector<bool> ChannelQuantiser::settled_joints(const CodedChannels& coded) const {
  std::vector<bool> settled(source_poses_.size(), false);
  if (!done_ || done_->scales != coded.scales) return settled;
  const StepGrid &steps = coded.steps, &before = done_->steps;
  for (std::size_t j = 0; j < source_poses_.size(); ++j) {
    const Joint& joint = take_.skeleton->joints[j];
    bool same = joint.parent < 0 || settled[static_cast<std::size_t>(joint.parent)];
    for (const CodedSlot& slot : order_.slots[j]) {
      if (slot.place < 0) continue;
      const auto place = static_cast<std::size_t>(slot.place);
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
  for (std::size_t j = 0; j < source_poses_.size(); ++j) {
    if (!settled[j]) {
      quantise_joint(j, coded);
      continue;
    }
    for (const CodedSlot& slot : order_.slots[j]) {
      if (slot.place >= 0) take_over(static_cast<std::size_t>(slot.place), coded);
    }
  }
  done_ = coded;
  ChannelMatrix result(take_.frames(), take_.channels.cols());
  for (std::size_t i = 0; i < order_.size(); ++i) {
    result.col(order_.channels[i]) = decoded_.col(static_cast<Index>(i));
  }
  set_constants(constants_, result);
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
void ChannelQuantiser::quantise_joint(std::size_t j, CodedChannels& coded) {
  const Joint& joint = take_.skeleton->joints[j];
  if (joint.parent < 0) {
    placement_.begin(j);
  } else {
    const auto parent = static_cast<std::size_t>(joint.parent);
    placement_.begin(j, source_poses_[parent], decoded_poses_[parent]);
  }
  for (const CodedSlot& slot : order_.slots[j]) {
    placement_.come_to(slot.slot);
    if (slot.place < 0) {
      placement_.apply_constant(slot.slot);
      continue;
    }
    const auto place = static_cast<std::size_t>(slot.place);
    expect(place);
    quantise_channel(place, coded);
    placement_.apply(slot.slot, place, decoded_.col(slot.place));
  }
  placement_.end(decoded_poses_[j]);
}

/// The twist of what is placed so far says what the channel had better be off.
void ChannelQuantiser::expect(std::size_t place) {
  const PlacedJoint& progress = placement_.progress();
  Trajectory& channel = channels_[place];
  for (Index f = 0; f < take_.frames(); ++f) {
    const JointFrame& source = progress.source[index(f)];
    const JointFrame& decoded = progress.decoded[index(f)];
    const Vector3d origin = source_poses_.front()[index(f)].position;
    Twist twist;
    twist.head<3>() = turn_vector(source.rotation, decoded.rotation);
    twist.tail<3>() =
        decoded.position - source.position - twist.head<3>().cross(source.position - origin);
    channel.residual[f] = channel.compensation.row(f).matrix().dot(twist.cast<float>().transpose());
  }
}

void ChannelQuantiser::quantise_channel(std::size_t i, CodedChannels& coded) {
  Trajectory& channel = channels_[i];
  const auto place = static_cast<Index>(i);
  const auto source = sources_.col(place);
  MatrixXd column = source - channel.residual.cast<double>();
  NestedKnots::from_frames(column, coded.shape.levels);
  if (coded.steps.base[i] < 0 || !round_knots(column, i, coded)) store(i, coded);
  decoded_.col(place) = coded.trajectory(i);
  channel.residual += (decoded_.col(place) - source).cast<float>();
}

std::vector<double> ChannelQuantiser::shares(std::size_t joint, Index frame) const {
  const Vector3d away = displacement(joint, frame);
  const Vector3d direction = away.normalized();
  const Vector3d place =
      source_poses_[joint][index(frame)].position - source_poses_.front()[index(frame)].position;
  Twist effect;
  effect << place.cross(direction), direction;
  return shares_of(effect, order_.last_moving[joint], frame, away.norm());
}

std::vector<double> ChannelQuantiser::shares_of_turn(std::size_t joint, Index frame) const {
  const Vector3d turn = turn_vector(source_poses_[joint][index(frame)].rotation,
                                    decoded_poses_[joint][index(frame)].rotation);
  Twist effect = Twist::Zero();
  effect.head<3>() = turn.normalized();
  return shares_of(effect, order_.last_turning[joint], frame, turn.norm());
}

std::vector<double> ChannelQuantiser::shares_of(Twist effect, int last, Index frame,
                                                double size) const {
  std::vector<double> result(order_.size(), 0.0);
  // How much a twist at some place along the chain does after all later channels have made up for
  // it, as a row vector.
  for (int i = last; i >= 0; i = order_.parents[static_cast<std::size_t>(i)]) {
    const Trajectory& channel = channels_[static_cast<std::size_t>(i)];
    const Twist motion = channel.motion.row(frame).matrix().cast<double>().transpose();
    const Twist compensation = channel.compensation.row(frame).matrix().cast<double>().transpose();
    const double reach = effect.dot(motion);
    result[static_cast<std::size_t>(i)] = reach * static_cast<double>(channel.residual[frame]);
    effect -= compensation * reach;
  }
  // Large turns that first order does not know of: what rounding did to the pose as a whole.
  const double explained = std::accumulate(result.begin(), result.end(), 0.0);
  if (explained < least_explained * size) {
    for (int i = last; i >= 0; i = order_.parents[static_cast<std::size_t>(i)]) {
      const Trajectory& channel = channels_[static_cast<std::size_t>(i)];
      const double residual = channel.residual[frame];
      result[static_cast<std::size_t>(i)] = channel.weight[frame] * residual * residual;
    }
  }
  return result;
}

}  // namespace reprise
