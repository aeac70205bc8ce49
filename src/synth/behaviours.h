// The vocabulary: what a synthetic subject can do.
#pragma once

#include "synth/footsteps.h"

namespace reprise::synth {

enum class Behaviour {
  wave,
  wave_both,
  punch,
  kick,
  squat,
  crouch,
  jump,
  reach_down,
  reach_up,
  bow,
  arm_circles,
  turn,
  side_steps,
  lunge,
  throw_ball,
  clap,
  swing,
  stretch,
  dance,
  march,
  walk,
  run,
  gesture,
  balance,
  count
};

/// A performance of 1 to 4 s with details of its own; it starts and ends at rest, arms at any
/// place. `most_seconds` shortens it,
/// as far as the behaviour can be done in that time.
Performance perform(Behaviour behaviour, Random& random, double most_seconds = 4);

/// Someone who stands and shifts the weight.
Performance perform_idle(double seconds, Random& random);

}  // namespace reprise::synth
