// Gestures of someone who stands. Each is written over a performance of 1 to 4 s, with details of
// its own.
#pragma once

#include "synth/performance.h"

namespace reprise::synth {

// arm_gestures.cc
void wave(Performance& performance, Random& random, bool both);
void punch(Performance& performance, Random& random);
void reach_up(Performance& performance, Random& random);
void arm_circles(Performance& performance, Random& random);
void throw_ball(Performance& performance, Random& random);
void clap(Performance& performance, Random& random);
void swing(Performance& performance, Random& random);
void stretch(Performance& performance, Random& random);

// body_gestures.cc
void kick(Performance& performance, Random& random);
void squat(Performance& performance, Random& random);
void crouch(Performance& performance, Random& random);
void jump(Performance& performance, Random& random);
void reach_down(Performance& performance, Random& random);
void bow(Performance& performance, Random& random);
void lunge(Performance& performance, Random& random);
void dance(Performance& performance, Random& random);
void balance(Performance& performance, Random& random);

}  // namespace reprise::synth
