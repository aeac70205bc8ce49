// A joint of a take on the way to its place, channel by channel, as its source has it and as
// decoded.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "refine/coding_order.h"
#include "reprise/model/kinematics.h"
#include "reprise/model/take.h"

namespace reprise {

/// A joint over all frames.
struct PlacedJoint {
  std::vector<JointFrame> source, decoded;
};

class JointPlacement {
 public:
  /// Keeps references.
  JointPlacement(const Take& take, const CodingOrder& order);

  /// Starts a joint without a parent.
  void begin(std::size_t joint);
  /// Starts where a joint's parent is.
  void begin(std::size_t joint, std::span<const JointFrame> source,
             std::span<const JointFrame> decoded);
  /// Comes to a channel (`slot` in the joint) without applying it: one that stretches the joint's
  /// bone finds it in its place.
  void come_to(int slot);
  /// Applies a channel that moves; `place`: its place in coding order, `decoded`: its numbers,
  /// frames (degrees or the file's unit).
  void apply(int slot, std::size_t place, const Eigen::Ref<const Eigen::VectorXd>& decoded);
  /// Applies a channel that does not move, which is decoded as the source has it.
  void apply_constant(int slot);
  /// Ends a joint whose channels were all applied: gives its decoded frames.
  void end(std::vector<JointFrame>& decoded);

  /// Turned and placed as far as channels were applied.
  const PlacedJoint& progress() const { return progress_; }

 private:
  void add_bone();
  void turn_by(std::size_t place, int axis, const Eigen::Ref<const Eigen::VectorXd>& degrees);

  const Take& take_;
  const CodingOrder& order_;
  Eigen::MatrixXf sine_, cosine_;  ///< of the source, frames x channels in coding order
  std::size_t joint_ = 0;
  bool has_bone_ = false;  ///< the joint's bone is in its place, or it has none
  PlacedJoint progress_;
};

}  // namespace reprise
