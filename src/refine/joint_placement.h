// A joint of a take on the way to its place, channel by channel, as its source has it and as
// decoded.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "reprise/model/kinematics.h"
#include "reprise/model/take.h"

namespace reprise {

/// A joint over all frames.
struct PlacedJoint {
  std::vector<JointFrame> source, decoded;
};

class JointPlacement {
 public:
  /// Keeps a reference to the take.
  explicit JointPlacement(const Take& take);

  /// Starts where a joint's parent is; the root's (null) is the world.
  void begin(std::size_t joint, const PlacedJoint* parent);
  /// Comes to a channel (`slot` in the joint) without applying it: one that stretches the joint's
  /// bone finds it in its place.
  void come_to(int slot);
  /// Applies it; `place`: its place in coding order, `decoded`: its numbers, frames (degrees or the
  /// file's unit).
  void apply(int slot, std::size_t place, const Eigen::Ref<const Eigen::VectorXd>& decoded);
  /// Ends a joint whose channels were all applied: gives its decoded frames.
  void end(std::vector<JointFrame>& decoded);

  /// Turned and placed as far as channels were applied.
  const PlacedJoint& progress() const { return progress_; }

 private:
  void add_bone();
  void turn_by(std::size_t place, int axis, const Eigen::Ref<const Eigen::VectorXd>& degrees);

  const Take& take_;
  std::vector<int> order_;
  Eigen::MatrixXf sine_, cosine_;  ///< of the source, frames x channels in coding order
  std::size_t joint_ = 0;
  bool has_bone_ = false;  ///< the joint's bone is in its place, or it has none
  PlacedJoint progress_;
};

}  // namespace reprise
