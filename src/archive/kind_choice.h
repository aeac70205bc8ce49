// Which kinds of curves the takes of a space are written in: a kind that saves less than its scales
// take is left out.
#pragma once

#include <array>

#include "quant/take_codec.h"

namespace reprise {

/// What a take is before its curves are written as one kind or another.
struct TakeCurves {
  TakeShape shape;
  bool tumbles = false;
  TrajectoryMatrix trajectories;
};

/// Adds the take's scales in every kind that it can have.
void add_scales(const CoefficientSpace& space, const TakeCurves& curves, KnotScales& scales);

/// Bits (and error as bits) of takes where only some kinds are there.
class KindCosts {
 public:
  static constexpr std::array<std::array<bool, curve_kinds>, 3> choices{
      {{true, true}, {true, false}, {false, true}}};

  void add(const KindCosts& take, double weight);
  /// `scales` with the kinds that cost least, the bytes of their scales included.
  KnotScales cheapest(const KnotScales& scales) const;

  std::array<double, choices.size()> bits{};
};

/// One take's at one step, each choice in its best pair of kinds.
KindCosts kind_costs(const CoefficientSpace& space, const KnotModel& model,
                     const TakeCurves& curves, int step_index);

}  // namespace reprise
