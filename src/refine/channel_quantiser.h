// Rounds channels from the root outwards, so that each makes up for the errors before it.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "refine/coded_channels.h"
#include "refine/joint_placement.h"
#include "refine/pose_metric.h"

namespace reprise {

class ChannelQuantiser {
 public:
  /// Measures the take for errors of the size of `bound_mm`; keeps a reference to it.
  ChannelQuantiser(const Take& take, double bound_mm);

  /// Steps that let every channel do the same harm: `step_mm` over the root of its mean weight.
  void set_steps(double step_mm, StepGrid& steps) const;

  /// Fills the knots and stored channels of `coded`, whose steps say how; gives its channels.
  /// Channels whose knots are too large for their step become stored ones. Joints up to which no
  /// step is another one than last time are as they were then.
  ChannelMatrix quantise(CodedChannels& coded);

  /// After `quantise`: where a joint came to be in a frame, less where it was (mm).
  Eigen::Vector3d displacement(std::size_t joint, Eigen::Index frame) const {
    return bodies_[joint].decoded[index(frame)].position -
           bodies_[joint].source[index(frame)].position;
  }

  /// After `quantise`: where all joints came to be, frames x 3*joints (mm).
  PositionMatrix positions() const;

  /// After `quantise`: how much of a joint's displacement in a frame, along the displacement, the
  /// rounding of each channel that moves it brought in; zero for other channels.
  std::vector<double> shares(std::size_t joint, Eigen::Index frame) const;

 private:
  using Twists = Eigen::Array<float, Eigen::Dynamic, 6>;
  /// A channel over all frames.
  struct Trajectory {
    Twists motion, compensation;
    Eigen::VectorXf residual;  ///< error that was not made up
    Eigen::VectorXf weight;
    double mean_weight = 0;
  };
  static std::size_t index(Eigen::Index frame) { return static_cast<std::size_t>(frame); }
  /// Of each joint: `coded` asks for what `done_` asked for, from the root to it.
  std::vector<bool> settled_joints(const CodedChannels& coded) const;
  void take_over(std::size_t place, CodedChannels& coded) const;
  /// Stores a channel's numbers as they are.
  void store(std::size_t place, CodedChannels& coded) const;
  void quantise_joint(std::size_t joint, std::size_t first_place, CodedChannels& coded);
  void expect(std::size_t place);
  void quantise_channel(std::size_t place, bool written, CodedChannels& coded);

  const Take& take_;
  std::vector<int> order_, parents_;
  std::vector<int> last_;  ///< of each joint: the last place that moves it, or -1
  std::vector<Trajectory> channels_;
  Eigen::MatrixXd sources_, decoded_;  ///< frames x channels in coding order
  std::vector<PlacedJoint> bodies_;
  std::vector<bool> written_;  ///< of each joint: a file has numbers for its channels
  JointPlacement placement_;
  std::optional<CodedChannels> done_;  ///< what `quantise` made last
};

}  // namespace reprise
