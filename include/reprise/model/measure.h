// The error measures that every figure of the project uses (docs/measures.md).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reprise/model/kinematics.h"

namespace reprise {

/// Distances between the same joints of two motions, over all joints, end sites and frames;
/// millimetres.
struct PositionErrors {
  double mean = 0;
  double rms = 0;
  double p99 = 0;
  double max = 0;
};

/// Geodesic angles between the world orientations of the same joints of two motions, over all
/// joints, end sites (which are turned as their joints) and frames; degrees.
struct RotationErrors {
  double mean = 0;
  double p99 = 0;
  double max = 0;
};

/// A joint (index in the skeleton) in a frame.
struct JointAt {
  int joint = 0;
  long frame = 0;

  bool operator==(const JointAt&) const = default;
};

/// How far a decoded motion is from its source, and where it is furthest.
struct MotionErrors {
  PositionErrors places;
  RotationErrors turns;
  JointAt worst_place, worst_turn;
};

/// Distances (mm) and turns (degrees) of all joints in all frames; frames x joints, row-major.
struct MotionDistances {
  std::vector<float> places, turns;
  std::vector<float> local_turns;  ///< of each joint against its parent, empty if not asked for
};

/// Mean horizontal speed of the foot joints (mm/s) while the original's are in contact with the
/// floor.
struct FootSkate {
  double original = 0;
  double decoded = 0;
};

struct Comparison {
  long frames = 0;          ///< frames that both have
  long missing_frames = 0;  ///< frames that only one of them has
  PositionErrors errors;
  RotationErrors turns, local_turns;  ///< of world orientations, and against each joint's parent
  JointAt worst_place, worst_turn;
  double d_percent = 0;  ///< 100 |A - A'|_F / |A - E(A)|_F; 0 where the original does not move
  std::optional<FootSkate> foot_skate;  ///< none without foot joints or contacts
};

/// Both frames x 3*joints in millimetres with the same number of columns; compares the frames that
/// both have.
PositionErrors position_errors(const PositionMatrix& original, const PositionMatrix& decoded);

/// Distance of each joint in each frame (frames x joints, row-major order), the frames that both
/// have.
std::vector<float> joint_distances(const PositionMatrix& original, const PositionMatrix& decoded);

/// Compares the frames that both have. Both are of this skeleton, or `decoded` of `other`, whose
/// joints hang as its do.
MotionDistances motion_distances(const Skeleton& skeleton, const ChannelMatrix& original,
                                 const ChannelMatrix& decoded, bool local_turns = false,
                                 const Skeleton* other = nullptr);
/// Of distances of a skeleton with so many joints, which are reordered.
MotionErrors summarise_motion(MotionDistances& distances, std::size_t joints);
/// mean, p99 and max of angles, which are reordered.
RotationErrors summarise_turns(std::vector<float>& turns);

/// mean, rms, p99 and max of a set of distances, which is reordered. p99 is interpolated linearly.
PositionErrors summarise_distances(std::vector<float>& distances);

/// True for a joint whose name has foot, toe or ankle in it, in any case.
bool is_foot_joint(const Joint& joint);

/// Contact of a foot joint: within 50 mm of the floor (5th percentile of the heights of
/// all foot joints of the original) and slower than 150 mm/s; speeds are central differences over
/// 50 ms. Heights are along the axis that the skeleton says points up.
std::optional<FootSkate> foot_skate(const Skeleton& skeleton, const PositionMatrix& original,
                                    const PositionMatrix& decoded, double frame_rate);

/// All of the above. Throws Error (failed) where the two have different joints.
Comparison compare_takes(const Take& original, const Take& decoded);

}  // namespace reprise
