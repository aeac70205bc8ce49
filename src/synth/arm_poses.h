// Places that hands go to, and curves that take them there.
#pragma once

#include <array>
#include <span>

#include "synth/performance.h"

namespace reprise::synth {

constexpr int arm_angles = 8;
using ArmPose = std::array<double, arm_angles>;  ///< degrees, in the order of ArmTrack

enum class ArmPlace {
  rest,
  front,
  reach_front,
  side,
  overhead,
  wave,
  guard,
  punch,
  face,
  hip,
  behind,
  across,
  low_front,
  count
};

/// A pose with every angle off by a Gaussian of `spread` degrees, within the joint limits.
ArmPose arm_pose(ArmPlace place, Random& random, double spread = 8);
/// Any pose but rest.
ArmPose random_arm_pose(Random& random);

struct ArmKey {
  double time = 0;
  ArmPose pose;
};

/// Moves an arm through poses; replaces what the arm did before.
void set_arm(Performance& performance, Side side, std::span<const ArmKey> keys);

}  // namespace reprise::synth
