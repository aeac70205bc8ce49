#include "refine/channel_quantiser.h"

#include <cmath>

#include "quant/catmull_rom.h"

namespace reprise {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// A knot is rounded up from 0.5 + this part of its step on: zeros cost least.
constexpr double dead_zone = 0.2;
/// Turns about a straight limb move nothing, up to some angle: beyond it compensation, which is
/// linear, goes wrong. The arm (mm) that holds them grows with the root of the bound (mm).
constexpr double arm_at_one_mm = 20;

}  // namespace

ChannelQuantiser::ChannelQuantiser(const Take& take, double bound_mm)
    : take_(take),
      order_(coding_order(*take.skeleton)),
      parents_(coding_parents(*take.skeleton)),
      last_(moving_places(*take.skeleton)),
      channels_(order_.size()) {
  const Index frames = take.frames();
  for (Channel& channel : channels_) {
    channel.motion.resize(frames, 6);
    channel.compensation.resize(frames, 6);
    channel.weight.resize(frames);
  }
  PoseMetric metric(*take.skeleton, arm_at_one_mm * std::sqrt(bound_mm));
  const std::vector<double> weights(take.skeleton->joints.size(), 1.0);
  std::vector<ChannelMetric> metrics(order_.size());
  for (Index f = 0; f < frames; ++f) {
    metric.measure({take.channels.row(f).data(), order_.size()}, weights, metrics);
    for (std::size_t i = 0; i < order_.size(); ++i) {
      Channel& channel = channels_[i];
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

ChannelMatrix ChannelQuantiser::quantise(CodedChannels& coded) {
  const Index frames = take_.frames();
  const int levels = coded.shape.levels;
  ChannelMatrix decoded(frames, take_.channels.cols());
  std::vector<Twists> twists(order_.size());
  MatrixXd column(frames, 1);
  for (std::size_t i = 0; i < order_.size(); ++i) {
    Channel& channel = channels_[i];
    const auto place = static_cast<Index>(i);
    if (parents_[i] < 0) {
      twists[i] = Twists::Zero(frames, 6);
    } else {
      twists[i] = twists[static_cast<std::size_t>(parents_[i])];
    }
    channel.residual = (channel.compensation * twists[i]).rowwise().sum();
    column = take_.channels.col(order_[i]) - channel.residual.matrix().cast<double>();
    NestedKnots::from_frames(column, levels);
    double coarsest = 0;
    bool wild = coded.steps.base[i] < 0;
    for (Index f = 0; f < frames && !wild; ++f) {
      const bool follows = knot_level(f, levels) == levels;
      const double step = coded.steps.step(i, f);
      const double value = (column(f, 0) - (follows ? coarsest : 0.0)) / step;
      const double magnitude = std::floor(std::abs(value) + (follows ? 0.5 : 0.5 - dead_zone));
      if (!(magnitude < most_knot)) {
        wild = true;
        break;
      }
      coded.knots(f, place) = static_cast<std::int32_t>(value < 0 ? -magnitude : magnitude);
      if (follows) coarsest += coded.knots(f, place) * step;
    }
    if (wild) {
      coded.steps.base[i] = -1;
      coded.knots.col(place).setZero();
      if (coded.stored.cols() == 0) coded.stored = MatrixXd::Zero(frames, coded.knots.cols());
      coded.stored.col(place) = take_.channels.col(order_[i]);
    }
    decoded.col(order_[i]) = coded.trajectory(i);
    const Eigen::ArrayXf error =
        (decoded.col(order_[i]) - take_.channels.col(order_[i])).cast<float>();
    channel.residual += error;
    twists[i] += channel.motion.colwise() * error;
  }
  return decoded;
}

std::vector<double> ChannelQuantiser::shares(std::size_t joint, Index frame,
                                             const Eigen::Vector3d& direction,
                                             const Eigen::Vector3d& place) const {
  std::vector<double> result(order_.size(), 0.0);
  // How much a twist at some place along the chain moves the joint after all later channels have
  // made up for it, as a row vector, from the joint inwards.
  Twist row;
  row << place.cross(direction), direction;
  for (int i = last_[joint]; i >= 0; i = parents_[static_cast<std::size_t>(i)]) {
    const Channel& channel = channels_[static_cast<std::size_t>(i)];
    const Twist motion = channel.motion.row(frame).matrix().cast<double>().transpose();
    const Twist compensation = channel.compensation.row(frame).matrix().cast<double>().transpose();
    const double reach = row.dot(motion);
    result[static_cast<std::size_t>(i)] = reach * channel.residual[frame];
    row -= compensation * reach;
  }
  return result;
}

}  // namespace reprise
