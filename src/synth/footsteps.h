// Stepping: where each foot is put down, and what the rest of the body does with it.
#pragma once

#include <vector>

#include "synth/performance.h"

namespace reprise::synth {

/// One foot goes from where it stands to a new place.
struct Footstep {
  Side side = Side::left;
  double start = 0;  ///< seconds: the foot leaves the floor
  double end = 0;    ///< seconds: it touches the floor
  double x = 0;
  double z = 0;
  double yaw = 0;
  double lift = 0.06;
  double push_off = 35;  ///< degrees of heel rise when the foot leaves the floor
  double strike = 12;    ///< degrees of toe rise when it touches the floor
};

/// How someone walks or runs. Shares of the leg's length, degrees, seconds.
struct GaitStyle {
  double step_seconds = 0.54;
  double step_length = 0.78;
  double step_width = 0.10;
  double swing_share = 0.80;  ///< of the time of a step that a foot is in the air; over 1: running
  double lift = 0.07;
  double push_off = 40;
  double strike = 14;
  double bob = 0;         ///< rise of the pelvis between steps, for running
  double sway = 0.2;      ///< share of the way to the standing foot
  double arm_swing = 22;  ///< degrees for a step of one leg's length
  double elbow_bend = 12;
  double pelvis_turn = 7;
  double lean = 3;
  double crouch = 0;
};

GaitStyle random_walk_style(Random& random);
GaitStyle random_run_style(Random& random);

/// Writes the feet's tracks; steps of one foot are in order of time and do not overlap.
void apply_footsteps(Performance& performance, const std::vector<Footstep>& steps);

/// Puts the pelvis over the feet, and swings arms, pelvis and torso against the legs.
void follow_feet(Performance& performance, const GaitStyle& style);

/// Steps along an arc: starts and ends at rest. `turn` is the change of heading in degrees,
/// `direction` the way that is walked relative to the heading (0 forward, 90 to the left, 180
/// back).
Performance perform_steps(const GaitStyle& style, int steps, double turn, double direction,
                          Side first);

}  // namespace reprise::synth
