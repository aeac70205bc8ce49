#include "refine/pose_metric.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "reprise/synth/library.h"

namespace reprise {
namespace {

class PoseMetrics : public testing::TestWithParam<MotionFormat> {
 protected:
  PoseMetrics() {
    SynthOptions options;
    options.takes = 1;
    options.seconds = 2;
    options.format = GetParam();
    take_ = make_synthetic_library(options).takes.at(0);
    const auto channels = static_cast<std::size_t>(take_.skeleton->channel_count);
    order_ = CodingOrder(*take_.skeleton, std::vector<bool>(channels, true));
    metrics_.resize(static_cast<std::size_t>(take_.skeleton->channel_count));
  }

  std::span<const double> frame(const ChannelMatrix& channels, long f) const {
    return {channels.row(f).data(), static_cast<std::size_t>(channels.cols())};
  }

  Take take_;
  CodingOrder order_{Skeleton{}, {}};
  std::vector<ChannelMetric> metrics_;
};

TEST_P(PoseMetrics, ChannelsComeAfterWhatTheyHangOn) {
  const std::vector<int>&order = order_.channels, &parents = order_.parents;
  std::vector<int> sorted = order;
  std::sort(sorted.begin(), sorted.end());
  std::vector<int> all(static_cast<std::size_t>(take_.skeleton->channel_count));
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(sorted, all);
  ASSERT_EQ(parents.size(), order.size());
  for (std::size_t i = 0; i < parents.size(); ++i) EXPECT_LT(parents[i], static_cast<int>(i));
}

/// A channel's motion is what forward kinematics does, to first order.
TEST_P(PoseMetrics, MotionsAreDerivativesOfPlaces) {
  PoseMetric metric(*take_.skeleton, order_, 20);
  const std::vector<double> weights(take_.skeleton->joints.size(), 1.0);
  const std::vector<int>&order = order_.channels, &parents = order_.parents;
  const long f = take_.frames() / 2;
  metric.measure(frame(take_.channels, f), weights, metrics_);
  std::vector<JointFrame> before(take_.skeleton->joints.size()), after = before;
  forward_kinematics(*take_.skeleton, frame(take_.channels, f), before);
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  ChannelMatrix moved = take_.channels.row(f);
  std::vector<Twist> twists(order.size(), Twist::Zero());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const double error = 1e-5 * normal(random);
    moved(0, order[i]) += error;
    if (parents[i] >= 0) twists[i] = twists[static_cast<std::size_t>(parents[i])];
    twists[i] += metrics_[i].motion * error;
  }
  forward_kinematics(*take_.skeleton, frame(moved, 0), after);
  const std::vector<int>& last = order_.last_moving;
  for (std::size_t j = 0; j < last.size(); ++j) {
    const Joint& joint = take_.skeleton->joints[j];
    const int moves = last[j];
    if (moves < 0) continue;
    const Twist& twist = twists[static_cast<std::size_t>(moves)];
    const Eigen::Vector3d place_of_joint = before[j].position - before[0].position;
    const Eigen::Vector3d expected = twist.tail<3>() + twist.head<3>().cross(place_of_joint);
    EXPECT_LT((after[j].position - before[j].position - expected).norm(), 1e-6) << joint.name;
  }
}

TEST_P(PoseMetrics, WeightsArePositiveAndGrowWithTheJoints) {
  PoseMetric metric(*take_.skeleton, order_, 20);
  std::vector<double> weights(take_.skeleton->joints.size(), 1.0);
  metric.measure(frame(take_.channels, 0), weights, metrics_);
  const std::vector<ChannelMetric> light = metrics_;
  for (double& weight : weights) weight = 4;
  metric.measure(frame(take_.channels, 0), weights, metrics_);
  for (std::size_t i = 0; i < light.size(); ++i) {
    EXPECT_GT(light[i].weight, 0);
    EXPECT_NEAR(metrics_[i].weight / light[i].weight, 4, 1e-6);
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, PoseMetrics,
                         testing::Values(MotionFormat::bvh, MotionFormat::asf_amc));

}  // namespace
}  // namespace reprise
