// One leg of a skeleton, so that it can be turned without the rest of the body.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "contacts/legs.h"
#include "contacts/normal_equations.h"
#include "reprise/model/kinematics.h"

namespace reprise {

struct LegChainConstants {
  /// Bounds the size of the systems that are solved; further channels keep their angles.
  static constexpr std::size_t most_angles = NormalEquations::most_unknowns;
  /// How far the foot has to move (mm) to be worth a radian: small enough not to hold the foot back
  /// (a leg's own is 200 to 900), large enough for a stretched leg to bend smoothly.
  static constexpr double stiffness_mm = 12;
  /// Damping of a round's steps by the squared distance (mm^2) that is still missing: a round turns
  /// no angle by more than 1 / (2 sqrt(caution)) radians, however far away a goal is. (Chan and
  /// Lawrence 1988 damp by the error, too.)
  static constexpr double caution = 0.25;
  static constexpr int rounds = 2;
  static constexpr int rounds_nearby = 1;  ///< where goals are a few millimetres away
};

/// Where one joint should be (world, mm).
struct JointGoal {
  int joint = 0;  ///< index in the skeleton
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  double weight = 1;  ///< of its squared distance
};

/// Inverse kinematics by damped least squares over a leg's own rotation channels.
class LegChain {
 public:
  /// Only channels with `moves` are turned.
  LegChain(const Skeleton& skeleton, const Leg& leg, const std::vector<bool>& moves);

  bool can_turn() const { return !angles_.empty(); }
  /// Places of the joints of the leg's points, in the order of `point_joints`, one frame.
  void place(std::span<const double> channels, std::span<Eigen::Vector3d> places);
  const std::vector<int>& point_joints() const { return point_joints_; }

  /// Turns the leg in a frame of channels (degrees) so that joints come to their goals as near as
  /// they can, with as little turning as that takes. What comes out depends smoothly on what goes
  /// in, and is as finite.
  void reach(std::span<double> channels, std::span<const JointGoal> goals, int rounds);

 private:
  struct Angle {
    std::size_t joint = 0;  // index in chain_
    std::size_t axis = 0;   // index in axes_
    int channel = 0;        // index in a frame
    int centre = 0;         // index in chain_ of the joint whose place it turns about
  };

  /// Fills frames_ and axes_ from joint `first` of chain_ on.
  void place_joints(std::size_t first, std::span<const double> channels);
  /// Adds the turns of the angles that would bring a joint to its goal; returns the weighted square
  /// of how far it is from there.
  double pull(const JointGoal& goal, NormalEquations& turns) const;
  std::size_t chain_index(int joint) const;

  Skeleton chain_;                // the joints from the root to the leg's points
  std::vector<int> chain_joint_;  // of each: its index in the skeleton
  std::size_t first_turning_ = 0;
  std::vector<Angle> angles_;
  std::vector<int> point_joints_;
  std::vector<std::size_t> point_index_;  // of each of them: its index in chain_
  std::vector<std::vector<bool>> turns_;  // of each angle and each joint of chain_
  std::vector<std::size_t> first_axis_;   // of each joint of chain_: index in axes_
  std::vector<JointFrame> frames_;
  std::vector<Eigen::Vector3d> axes_;  // of each rotation of the joints of chain_, in the world
};

}  // namespace reprise
