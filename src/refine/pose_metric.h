// How far joints move when channels are off: for small errors, distances of points on a chain of
// rigid bodies. Summing squared distances over joints is a quadratic form in the channels' errors;
// it falls apart into one square a channel when channels are coded from the root outwards and each
// makes up for what those before it did. This is the articulated-body recursion of rigid-body
// dynamics (Featherstone, Rigid Body Dynamics Algorithms, chapter 7), with weights for masses.
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "refine/coding_order.h"
#include "reprise/model/kinematics.h"
#include "reprise/model/take.h"

namespace reprise {

/// A small motion of a rigid body: turn (rad), then the velocity (mm) of the point at the frame's
/// origin.
using Twist = Eigen::Matrix<double, 6, 1>;

/// One channel of one frame, in coding order.
struct ChannelMetric {
  Twist motion;        ///< what one unit of the channel does to all that hangs on it
  Twist compensation;  ///< by its product with the error so far: the channel error to be made up
  double weight = 0;   ///< summed squares (mm^2) for a squared unit of what is not made up
};

class PoseMetric {
 public:
  /// Turns that move no joint are held, too: as if each turning joint carried points
  /// `off_bone_mm` away from it. Channels that are not in the order do not give way. Keeps
  /// references.
  PoseMetric(const Skeleton& skeleton, const CodingOrder& order, double off_bone_mm);

  /// `channels` is a frame; `weights` one number a joint. Fills one metric a place of the order.
  void measure(std::span<const double> channels, std::span<const double> weights,
               std::span<ChannelMetric> metrics);

 private:
  const Skeleton& skeleton_;
  const CodingOrder& order_;
  double off_bone_mm_;
  std::vector<JointFrame> frames_;
  std::vector<Eigen::Matrix<double, 6, 6>> inertia_;
};

}  // namespace reprise
