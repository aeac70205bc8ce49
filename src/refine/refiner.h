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
  struct Distances {
    Eigen::MatrixXf squared;  ///< frames x joints, mm^2
    double worst = 0;         ///< mm
  };
  Distances distances(const ChannelMatrix& decoded) const;
  /// Makes steps finer where the bound is missed; true if somewhere.
  bool adapt(const Distances& distances, const ChannelMatrix& decoded, StepGrid& steps,
             bool stubborn) const;
  /// One search from a step for all.
  bool search(double step_mm, Refinement& best);

  const Take& take_;
  double bound_;  ///< mm, less what rounding takes
  PositionMatrix positions_;
  ChannelQuantiser quantiser_;
};

}  // namespace reprise
