// Rounds channels from the root outwards, so that each makes up for the errors before it.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "refine/coded_channels.h"
#include "refine/pose_metric.h"

namespace reprise {

class ChannelQuantiser {
 public:
  /// Measures the take for errors of the size of `bound_mm`; keeps a reference to it.
  ChannelQuantiser(const Take& take, double bound_mm);

  /// Steps that let every channel do the same harm: `step_mm` over the root of its mean weight.
  void set_steps(double step_mm, StepGrid& steps) const;

  /// Fills the knots and stored channels of `coded`, whose steps say how; gives its channels.
  /// Channels whose knots are too large for their step become stored ones.
  ChannelMatrix quantise(CodedChannels& coded);

  /// After `quantise`: how much of a joint's error in a frame, along `direction` (of unit length),
  /// the rounding of each channel that moves it brought in; zero for other channels.
  std::vector<double> shares(std::size_t joint, Eigen::Index frame,
                             const Eigen::Vector3d& direction, const Eigen::Vector3d& place) const;

  const std::vector<int>& order() const { return order_; }

 private:
  using Twists = Eigen::Array<float, Eigen::Dynamic, 6>;
  struct Channel {
    Twists motion, compensation;
    Eigen::ArrayXf weight;
    Eigen::ArrayXf residual;  ///< error that was not made up
    double mean_weight = 0;
  };

  const Take& take_;
  std::vector<int> order_, parents_;
  std::vector<int> last_;  ///< of each joint: the last place that moves it, or -1
  std::vector<Channel> channels_;
};

}  // namespace reprise
