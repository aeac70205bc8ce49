#include "archive/space_training.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace reprise {

using Eigen::Index;

void ConstantValues::add(const TakeHeader& header) {
  for (std::size_t c = 0; c < header.constants.size(); ++c) {
    if (header.constants[c]) values_.emplace_back(c, *header.constants[c]);
    if (!header.first_frame.empty()) values_.emplace_back(c, header.first_frame[c]);
  }
}

void ConstantValues::add(const ConstantValues& other) {
  values_.insert(values_.end(), other.values_.begin(), other.values_.end());
}

KnownValues ConstantValues::known_values(std::size_t channels) const {
  std::vector<std::map<double, long>> counts(channels);
  for (const auto& [channel, value] : values_) ++counts[channel][value];
  KnownValues known;
  for (const auto& values : counts) {
    std::vector<std::pair<long, double>> by_count;
    for (const auto& [value, count] : values) {
      if (count > 1) by_count.emplace_back(-count, value);
    }
    std::ranges::sort(by_count);
    known.emplace_back();
    for (const auto& [count, value] : by_count) {
      if (known.back().size() < KnownValueLimits::values) known.back().push_back(value);
    }
  }
  return known;
}

void LayoutEvidence::add(const LayoutEvidence& other) {
  if (active.empty()) {
    *this = other;
    return;
  }
  for (std::size_t c = 0; c < active.size(); ++c) {
    active[c] = active[c] || other.active[c];
  }
  for (std::size_t j = 0; j < travel.size(); ++j) {
    travel[j] += other.travel[j];
    orientations[j] += other.orientations[j];
  }
  first_frames.insert(first_frames.end(), other.first_frames.begin(), other.first_frames.end());
  values.add(other.values);
}

void LayoutEvidence::read_as(const Skeleton& skeleton, double millimetres_per_unit, UpAxis up) {
  for (double& range : travel) range *= millimetres_per_unit / skeleton.millimetres_per_unit;
  const Eigen::Matrix3d turn = turn_to_y(up) * turn_to_y(skeleton.up).transpose();
  for (Eigen::Matrix3d& sum : orientations) sum = (turn * sum * turn.transpose()).eval();
}

LayoutEvidence layout_evidence(const PreparedTake& prepared) {
  const Take& take = prepared.take;
  const Skeleton& skeleton = *take.skeleton;
  LayoutEvidence evidence;
  evidence.values.add(prepared.header);
  if (take.frames() > 0) {
    const auto first = take.channels.row(0);
    evidence.first_frames.emplace_back(first.begin(), first.end());
  }
  const Eigen::RowVectorXd low = take.channels.colwise().minCoeff();
  const Eigen::RowVectorXd high = take.channels.colwise().maxCoeff();
  for (int c = 0; c < skeleton.channel_count; ++c) {
    evidence.active.push_back(high[c] - low[c] > TrainingConstants::least_change);
  }
  std::vector<JointFrame> frames(skeleton.joints.size());
  evidence.orientations.assign(skeleton.joints.size(), Eigen::Matrix3d::Zero());
  const Eigen::Matrix3d to_y = turn_to_y(skeleton.up);
  const Index stride =
      std::max<Index>(1, std::lround(take.frame_rate / TrainingConstants::frames_a_second));
  for (Index f = 0; f < take.frames(); f += stride) {
    forward_kinematics(skeleton, {take.channels.row(f).data(), std::size_t(skeleton.channel_count)},
                       frames);
    for (std::size_t j = 0; j < frames.size(); ++j) {
      evidence.orientations[j] += to_y * frames[j].rotation * to_y.transpose();
    }
  }
  for (const Joint& joint : skeleton.joints) {
    double travel = 0;
    for (std::size_t c = 0; c < joint.channels.size(); ++c) {
      const Index channel = joint.first_channel + static_cast<Index>(c);
      if (is_position(joint.channels[c])) {
        travel += (high[channel] - low[channel]) * skeleton.millimetres_per_unit;
      }
    }
    evidence.travel.push_back(travel);
  }
  return evidence;
}

LayoutChoices choose_layout(const Skeleton& skeleton, const LayoutEvidence& evidence) {
  LayoutChoices choices;
  choices.active = evidence.active;
  // The motion of the root may sit below the first joint: take the joint that travels most.
  double furthest = 0;
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    if (evidence.travel[j] > furthest * 1.0001) {
      furthest = evidence.travel[j];
      choices.root_joint = static_cast<int>(j);
    }
  }
  double highest = -1;
  for (int a = 0; a < 6; ++a) {
    const double up = evidence.orientations[choices.root_joint](1, a % 3) * (a < 3 ? 1 : -1);
    if (a == 0 || up > highest) {
      highest = up;
      choices.up_axis = a;
    }
  }
  return choices;
}

MarkerMatrix sampled_markers(const MarkerLayout& layout, const Take& take) {
  const Index stride =
      std::max<Index>(1, std::lround(take.frame_rate / TrainingConstants::frames_a_second));
  Take sampled = take;
  sampled.channels.resize((take.frames() + stride - 1) / stride, take.channels.cols());
  for (Index f = 0; f < sampled.channels.rows(); ++f) {
    sampled.channels.row(f) = take.channels.row(f * stride);
  }
  return mark_take(layout, sampled).markers;
}

namespace {

/// Of each channel; 0 where there are no frames.
std::vector<double> median_frame(const std::vector<std::vector<double>>& frames,
                                 std::size_t channels) {
  std::vector<double> medians(channels, 0.0);
  if (frames.empty()) return medians;
  std::vector<double> values(frames.size());
  for (std::size_t c = 0; c < channels; ++c) {
    std::ranges::transform(frames, values.begin(), [&](const auto& frame) { return frame[c]; });
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    medians[c] = *middle;
  }
  return medians;
}

double allowed_residual(const MarkerLayout& layout, double mean_mm) {
  const double residual = TrainingConstants::residual_share * mean_mm;
  return layout.point_count * residual * residual;
}

}  // namespace

CoefficientSpace train_space(MarkerLayout layout, const MarkerMoments& moments,
                             const LayoutEvidence& evidence, double mean_mm) {
  CoefficientSpace space;
  space.layout = std::move(layout);
  space.start = median_frame(evidence.first_frames, evidence.active.size());
  space.mean = moments.mean();
  PrincipalAxes axes =
      principal_axes(moments.covariance(space.mean), Eigen::MatrixXd(space.layout.dimensions(), 0),
                     allowed_residual(space.layout, mean_mm));
  space.axes = std::move(axes.axes);
  space.variance = std::move(axes.variance);
  return space;
}

CoefficientSpace extend_space(const CoefficientSpace& base, const MarkerMoments& moments,
                              double mean_mm) {
  PrincipalAxes more = principal_axes(moments.covariance(base.mean), base.axes,
                                      allowed_residual(base.layout, mean_mm));
  CoefficientSpace space = base;
  space.axes.conservativeResize(base.axes.rows(), base.axes.cols() + more.axes.cols());
  space.axes.rightCols(more.axes.cols()) = more.axes;
  space.variance.conservativeResize(base.variance.size() + more.variance.size());
  space.variance.tail(more.variance.size()) = more.variance;
  return space;
}

double axis_share(double entries, double curve_bits) {
  constexpr double worth = 0.7;
  const double share = std::sqrt(worth * entries / std::max(curve_bits, 1.0));
  return std::clamp(share, TrainingConstants::least_axis_share, TrainingConstants::most_axis_share);
}

SpacePrecision space_precision(const CoefficientSpace& space, double mean_mm, double share) {
  const double points = space.layout.point_count;
  const double axes = static_cast<double>(std::max<Index>(space.axes.cols(), 1));
  const double dimensions = std::max(space.layout.dimensions(), 1);
  // An axis of deviation s with entries rounded to e / s adds e^2 / 12 to each of the dimensions.
  return {TrainingConstants::mean_share * mean_mm * std::sqrt(12.0 * points / dimensions),
          share * mean_mm * std::sqrt(12.0 * points / (dimensions * axes))};
}

}  // namespace reprise
