// Finds the coarsest steps that keep a bound.
#pragma once

#include "refine/channel_quantiser.h"
#include "refine/pose_bounds.h"
#include "refine/refinement.h"

namespace reprise {

class Refiner {
 public:
  Refiner(const PreparedTake& prepared, const RefinementOptions& options);
  Refinement run();

 private:
  struct Candidate {
    CodedChannels coded;
    Refinement refinement;
  };
  /// Steps that have to become finer, gathered over a whole pass.
  class FinerSteps;
  /// Makes steps finer where `reached` misses a bound; true if somewhere. `stubborn`: more of them.
  bool adapt(StepGrid& steps, bool stubborn, const PoseTrack& reached) const;
  /// Places and turns of one joint.
  void find_misses(std::size_t joint, const PoseTrack& reached, FinerSteps& finer) const;
  void find_pops(std::size_t joint, const PoseTrack& reached, FinerSteps& finer) const;
  /// One search from a step for all; empty bytes where it comes to nothing.
  Candidate search(double step_mm, TimeScales scales);
  bool keeps_bounds(const ChannelMatrix& decoded) const;
  /// Measures what is decoded; bytes if it keeps the bounds.
  void finish(Candidate& candidate) const;
  /// The smallest of some searches, or all channels as they are.
  Candidate best_search();
  /// Adds contacts, as far as feet need them and the bound allows; nothing where they do not pay.
  void hold_feet(Candidate& best);
  CodedChannels empty_channels(TimeScales scales) const;
  TakeShape shape() const { return {take_.frames(), take_.frame_rate}; }

  const PreparedTake& prepared_;
  const Take& take_;
  bool contacts_;
  PoseBounds bounds_;  ///< less what rounding takes
  ChannelQuantiser quantiser_;
};

}  // namespace reprise
