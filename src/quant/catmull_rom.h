// Curves through nested knots (lin-2011 section 5.1). Half-way between its knots a curve is
// (3, -25, 150, 150, -25, 3)/256 of the six around it, where a Catmull-Rom curve is
// (-1, 9, 9, -1)/16 of four; a knot of the next finer level is stored as what it differs from that.
// A knot exists where that is not zero, so knots are dense where the motion asks for them. An
// update step fits the coarser knots to the frames around them instead of sampling them.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace reprise {

/// Knots of one trajectory in place of its frames: frame i holds the detail of level
/// min(trailing zeros of i, levels); frames at multiples of 2^levels hold the coarsest knots.
struct NestedKnots {
  /// Analysis: frames to knots, in place, column by column. Each number is scaled so that an error
  /// of e in it is an error of about e^2 in the summed squares of the trajectory.
  static void from_frames(Eigen::MatrixXd& trajectories, int levels);
  /// Synthesis, the exact inverse.
  static void to_frames(Eigen::MatrixXd& knots, int levels);
};

/// The level of frame i: 0 for the finest details, `levels` for the coarsest knots.
int knot_level(long frame, int levels);

/// Levels so that the coarsest knots are about this far apart (s).
constexpr double coarsest_knot_seconds = 0.53;
int knot_levels(double frame_rate, long frames);

}  // namespace reprise
