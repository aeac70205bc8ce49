// Rounds channels from the root outwards, so that each makes up for the errors before it.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "quant/take_header.h"
#include "refine/coded_channels.h"
#include "refine/coding_order.h"
#include "refine/joint_placement.h"
#include "refine/pose_bounds.h"
#include "refine/pose_metric.h"

namespace reprise {

class ChannelQuantiser {
 public:
  /// Measures the take; keeps a reference to it. Turns of a joint weigh as if it carried a point
  /// `arm_mm` away from it.
  ChannelQuantiser(const PreparedTake& prepared, double arm_mm);

  /// Steps that let every channel do the same harm: `step_mm` over the root of its mean weight.
  void set_steps(double step_mm, StepGrid& steps) const;

  /// Fills the knots and stored channels of `coded`, whose steps say how; gives its channels.
  /// Channels whose knots are too large for their step become stored ones. Joints up to which no
  /// step is another one than last time are as they were then.
  ChannelMatrix quantise(CodedChannels& coded);

  /// After `quantise`: where a joint came to be in a frame, less where it was (mm).
  Eigen::Vector3d displacement(std::size_t joint, Eigen::Index frame) const {
    return decoded_poses_[joint][index(frame)].position -
           source_poses_[joint][index(frame)].position;
  }

  /// Where joints were, and after `quantise` where they came to be.
  const PoseTrack& source() const { return source_poses_; }
  const PoseTrack& decoded() const { return decoded_poses_; }

  /// After `quantise`: how much of a joint's displacement in a frame, along the displacement, the
  /// rounding of each channel that moves it brought in; zero for other channels. One number a place
  /// of the coding order.
  std::vector<double> shares(std::size_t joint, Eigen::Index frame) const;
  /// The same of how far the joint is turned away from its orientation.
  std::vector<double> shares_of_turn(std::size_t joint, Eigen::Index frame) const;

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
  void quantise_joint(std::size_t joint, CodedChannels& coded);
  void expect(std::size_t place);
  void quantise_channel(std::size_t place, CodedChannels& coded);
  /// Follows an effect, a linear function of twists, from its last place inwards; where first order
  /// explains too little of `size`, how much rounding weighs in the pose as a whole.
  std::vector<double> shares_of(Twist effect, int last, Eigen::Index frame, double size) const;

  const Take& take_;
  ChannelConstants constants_;
  CodingOrder order_;
  std::vector<Trajectory> channels_;
  Eigen::MatrixXd sources_, decoded_;  ///< frames x channels in coding order
  PoseTrack source_poses_, decoded_poses_;
  JointPlacement placement_;
  std::optional<CodedChannels> done_;  ///< what `quantise` made last
};

}  // namespace reprise
