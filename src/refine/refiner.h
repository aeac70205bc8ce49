// Finds the coarsest steps that keep a bound.
#pragma once

#include "refine/channel_quantiser.h"
#include "refine/refinement.h"

namespace reprise {

class Refiner {
 public:
  Refiner(const Take& take, const RefinementOptions& options);
  Refinement run();

 private:
  struct Candidate {
    CodedChannels coded;
    Refinement refinement;
  };
  /// Over all joints and frames, in mm.
  double worst_distance(const PositionMatrix& reached) const;
  /// Makes steps finer where the bound is missed; true if somewhere. `displacement(joint, frame)`
  /// in mm. `stubborn`: more of them.
  template <class Displacement>
  bool adapt(StepGrid& steps, bool stubborn, const Displacement& displacement) const;
  /// One search from a step for all; empty bytes where it comes to nothing.
  Candidate search(double step_mm, TimeScales scales);
  /// Measures what is decoded; bytes if it keeps the bound.
  void finish(Candidate& candidate) const;
  /// The smallest of some searches, or all channels as they are.
  Candidate best_search();
  /// Adds contacts, as far as feet need them and the bound allows; nothing where they do not pay.
  void hold_feet(Candidate& best);
  TakeShape shape() const { return {take_.frames(), take_.frame_rate}; }

  const Take& take_;
  bool contacts_;
  double bound_;  ///< mm, less what rounding takes
  PositionMatrix positions_;
  ChannelQuantiser quantiser_;
};

}  // namespace reprise
