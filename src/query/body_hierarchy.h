// The joints of a body by where they are, without their names.
#pragma once

#include <optional>

#include "reprise/model/kinematics.h"
#include "reprise/query/body_joints.h"

namespace reprise {

struct BodyHierarchyConstants {
  /// Two limbs are a pair if each of their bones is as long as the other's, up to this part of the
  /// limb.
  static constexpr double equal_part = 0.05;
  /// A limb has at least this part of the longest way below any joint.
  static constexpr double least_limb = 0.25;
  /// Of one joint, and pairs of a skeleton; others are shorter.
  static constexpr std::size_t most_limbs = 16;
  /// Cosine of the greatest angle between the way from hips to shoulders and that from feet to
  /// hips: a body stands. Four-legged ones do not.
  static constexpr double least_upright = 0.7;
  /// Feet reach at least this part of a leg to the front.
  static constexpr double least_foot = 0.05;
};

/// Two equal legs, two equal arms above them and a head, in the rest pose; the feet say what is in
/// front. None where a skeleton has no such body, or several things could be meant.
std::optional<BodyMatch> body_by_hierarchy(const Skeleton& skeleton);

/// The places of a skeleton's joints in its rest pose, mm.
PositionMatrix rest_positions(const Skeleton& skeleton);

}  // namespace reprise
