// Finds the coarsest steps that keep a bound.
#pragma once

#include "refine/channel_quantiser.h"
#include "refine/refinement.h"

namespace reprise {

class Refiner {
 public:
  Refiner(const Take& take, double bound_mm);
  Refinement run();

 private:
  /// Over all joints and frames, in mm.
  double worst_distance(const ChannelMatrix& decoded) const;
  /// Makes steps finer where the bound is missed; true if somewhere. `stubborn`: more of them.
  bool adapt(StepGrid& steps, bool stubborn) const;
  /// One search from a step for all; empty bytes where it comes to nothing.
  Refinement search(double step_mm, TimeScales scales);
  TakeShape shape() const { return {take_.frames(), take_.frame_rate}; }

  const Take& take_;
  double bound_;  ///< mm, less what rounding takes
  PositionMatrix positions_;
  ChannelQuantiser quantiser_;
};

}  // namespace reprise
