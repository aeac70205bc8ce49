// Performances one after the other in one room, with steps and blends between them.
#pragma once

#include "synth/performance.h"

namespace reprise::synth {

/// Frames [first, last) of a take.
struct FrameInterval {
  long first = 0;
  long last = 0;
};

class Stage {
 public:
  Stage(double frame_rate, Random random);

  /// Performs at `speed` times the written one, heading `turn` degrees off the way someone faces
  /// now. The transition comes before the interval that is returned.
  FrameInterval add(const Performance& performance, double speed, double turn);

  long frames() const { return frames_; }
  double seconds() const { return static_cast<double>(frames_) / frame_rate_; }
  /// A turn that leads back to the middle of the room where someone has strayed, else one within 60
  /// degrees.
  double choose_turn();
  /// frames x tracks, in the room's directions.
  TrackMatrix tracks() const { return tracks_.topRows(frames_); }

 private:
  TrackRow placed(TrackRow row) const;
  void place(const TrackRow& first, double turn);
  void add_transition(const TrackRow& from, const TrackRow& to);
  void append(const TrackRow& row);

  double frame_rate_;
  Random random_;
  TrackMatrix tracks_;
  long frames_ = 0;
  double heading_ = 0, x_ = 0, z_ = 0;  ///< where the present performance's own origin is
};

}  // namespace reprise::synth
