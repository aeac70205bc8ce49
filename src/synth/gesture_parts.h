// What gestures are made of.
#pragma once

#include <initializer_list>

#include "synth/arm_poses.h"

namespace reprise::synth {

Side random_side(Random& random);
/// 1 or -1.
double random_sign(Random& random);

/// Performance::add_keys with times as shares of the performance, each a little early or late.
void bend(Performance& performance, Random& random, int track, std::initializer_list<Key> keys);

/// Where the pelvis goes to put the weight on one foot, in legs.
double over_foot(Side side);

/// An arm goes through up to `count` poses, from near rest and back to near rest.
void busy_arm(Performance& performance, Random& random, Side side, int count);

/// An arm goes to one place and holds it from a share of the time to another.
void hold_arm(Performance& performance, Random& random, Side side, ArmPlace place, double from,
              double to);

/// What everyone does besides: head and torso, and the arms that have nothing else to do.
void add_person(Performance& performance, Random& random, bool arms_are_free);

/// Feet a little wider, turned or apart, for as long as the performance lasts.
void set_stance(Performance& performance, Random& random);

}  // namespace reprise::synth
