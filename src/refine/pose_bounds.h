// What a bounded layer promises of a pose, and how far a decoded motion is from it.
#pragma once

#include <vector>

#include "model/rotation_distance.h"
#include "reprise/model/kinematics.h"
#include "reprise/model/take.h"

namespace reprise {

/// Of each joint, where it is in every frame.
using PoseTrack = std::vector<std::vector<JointFrame>>;
PoseTrack pose_track(const Skeleton& skeleton, const ChannelMatrix& channels);
/// frames x 3*joints, mm.
PositionMatrix positions_of(const PoseTrack& track);

/// Limits on each joint of each frame: how far it is from its place, how far it is turned from its
/// world orientation, and by how much its turn against its parent from one frame to the next may
/// exceed the source's.
class PoseBounds {
 public:
  PoseBounds(double mm, double degrees)
      : mm_(mm),
        degrees_(degrees),
        squared_mm_(mm * mm),
        squared_chord_(squared_chord_of(degrees)) {}

  double mm() const { return mm_; }
  double degrees() const { return degrees_; }
  /// A part of these.
  PoseBounds part(double of) const { return {of * mm_, of * degrees_}; }

  /// Squared error over squared limit, of the place and of the turn: more than 1 is a miss.
  double place_ratio(const JointFrame& source, const JointFrame& decoded) const {
    return (decoded.position - source.position).squaredNorm() / squared_mm_;
  }
  double turn_ratio(const JointFrame& source, const JointFrame& decoded) const {
    return squared_chord(source.rotation, decoded.rotation) / squared_chord_;
  }

  /// Degrees by which a joint's turn against its parent from frame f - 1 to f exceeds the source's;
  /// a joint without a parent turns against the world.
  double pop_degrees(const Skeleton& skeleton, const PoseTrack& source, const PoseTrack& decoded,
                     std::size_t joint, std::size_t f) const;
  bool pops(const Skeleton& skeleton, const PoseTrack& source, const PoseTrack& decoded,
            std::size_t joint, std::size_t f) const {
    return pop_degrees(skeleton, source, decoded, joint, f) > degrees_;
  }

 private:
  double mm_, degrees_, squared_mm_, squared_chord_;
};

}  // namespace reprise
