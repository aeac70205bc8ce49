// Which joints of a skeleton may stand on the floor, and which joints carry them.
#pragma once

#include <vector>

#include "reprise/model/skeleton.h"

namespace reprise {

struct LegConstants {
  /// Joints with rotations above a foot that belong to its leg: hip, knee, and one that twists.
  static constexpr int most_joints_above_foot = 3;
  /// Where no name says what a foot is, feet are the ends of the skeleton that are this near to its
  /// lowest end in the rest pose (part of its height).
  static constexpr double lowest_part = 0.1;
};

/// A leg turns a foot about the hip. `points` are what may touch the floor: the foot's first joint
/// (the ankle of a BVH skeleton, the ball of an ASF one), then all joints beyond it together (the
/// toes), where there are some.
struct Leg {
  std::vector<std::vector<int>> points;  ///< indices of joints, never empty
  std::vector<int> joints;               ///< those that turn `points`, parents first
};

/// The legs of a skeleton, in file order; none without feet. Foot joints are those of the foot
/// skate measure (measure.h); without any, the lowest ends of the rest pose. A joint that carries
/// feet of two legs belongs to none.
std::vector<Leg> find_legs(const Skeleton& skeleton);

/// Number of points of all legs. Points are counted through, leg by leg.
int count_points(const std::vector<Leg>& legs);

}  // namespace reprise
