// How far joints move when channels are off: for small errors, distances of points on a chain of
// rigid bodies. Summing squared distances over joints is a quadratic form in the channels' errors;
// it falls apart into one square a channel when channels are coded from the root outwards and each
// makes up for what those before it did. This is the articulated-body recursion of rigid-body
// dynamics (Featherstone, Rigid Body Dynamics Algorithms, chapter 7), with weights for masses.
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "reprise/model/kinematics.h"
#include "reprise/model/take.h"

namespace reprise {

/// A small motion of a rigid body: turn (rad), then the velocity (mm) of the point at the frame's
/// origin.
using Twist = Eigen::Matrix<double, 6, 1>;

/// One channel of one frame, in the order of `coding_order`.
struct ChannelMetric {
  Twist motion;        ///< what one unit of the channel does to all that hangs on it
  Twist compensation;  ///< by its product with the error so far: the channel error to be made up
  double weight = 0;   ///< summed squares (mm^2) for a squared unit of what is not made up
};

/// Indices of a joint's channels from the root outwards: places, turns, stretch.
std::vector<int> slots_outwards(const Joint& joint);

/// Channels from the root outwards: a channel comes after all that it hangs on.
std::vector<int> coding_order(const Skeleton& skeleton);

/// For each place in the coding order, the last place before it that it hangs on, or -1.
std::vector<int> coding_parents(const Skeleton& skeleton);

/// For each joint, the last place in the coding order that moves it, or -1.
std::vector<int> moving_places(const Skeleton& skeleton);

class PoseMetric {
 public:
  /// Turns that move no joint are held, too: as if each turning joint carried points
  /// `off_bone_mm` away from it.
  PoseMetric(const Skeleton& skeleton, double off_bone_mm);

  /// `channels` is a frame; `weights` one number a joint. Fills one metric a channel.
  void measure(std::span<const double> channels, std::span<const double> weights,
               std::span<ChannelMetric> metrics);

 private:
  const Skeleton& skeleton_;
  double off_bone_mm_;
  std::vector<std::vector<int>> places_;  ///< of each joint's channels in the coding order
  std::vector<JointFrame> frames_;
  std::vector<Eigen::Matrix<double, 6, 6>> inertia_;
};

}  // namespace reprise
