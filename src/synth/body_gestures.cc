#include <algorithm>

#include "synth/footsteps.h"
#include "synth/gesture_parts.h"
#include "synth/gestures.h"

namespace reprise::synth {
namespace {

/// Sinks by `depth` legs and leans forward for it, held from a share of the time to another.
void lower(Performance& p, Random& random, double depth, double from, double to) {
  bend(p, random, pelvis_rise,
       {{0, 0}, {from, -depth}, {to, -depth * random.uniform(0.9, 1)}, {1, 0}});
  bend(p, random, pelvis_z, {{0, 0}, {from, -0.32 * depth}, {to, -0.32 * depth}, {1, 0}});
  const double lean = random.uniform(50, 75) * depth;
  bend(p, random, torso_pitch, {{0, 0}, {from, lean}, {to, lean}, {1, 0}});
  bend(p, random, pelvis_pitch, {{0, 0}, {from, 0.4 * lean}, {to, 0.4 * lean}, {1, 0}});
  bend(p, random, head_pitch, {{0, 0}, {from, -0.6 * lean}, {to, -0.6 * lean}, {1, 0}});
}

}  // namespace

void kick(Performance& p, Random& random) {
  const Side leg = random_side(random);
  const Side standing_leg = other(leg);
  const double hit = random.uniform(0.45, 0.55), height = random.uniform(0.25, 0.75);
  const double out = random.uniform(0.5, 0.85), aside = sign_of(leg) * random.uniform(-0.1, 0.2);
  bend(p, random, pelvis_x,
       {{0, 0}, {0.2, over_foot(standing_leg)}, {0.78, over_foot(standing_leg)}, {1, 0}});
  bend(p, random, foot_track(leg, foot_z),
       {{0.14, 0}, {0.32, -0.35}, {hit, out}, {0.68, 0.2}, {0.84, 0}});
  bend(p, random, foot_track(leg, foot_x), {{0.14, 0}, {hit, aside}, {0.84, 0}});
  bend(p, random, foot_track(leg, foot_lift),
       {{0.14, 0}, {0.32, 0.22}, {hit, height}, {0.68, 0.25}, {0.84, 0}});
  bend(p, random, foot_track(leg, foot_pitch),
       {{0.1, 0}, {0.32, 60}, {hit, -15}, {0.68, 20}, {0.84, 0}});
  bend(p, random, pelvis_pitch, {{0.1, 0}, {0.32, 8}, {hit, -14}, {0.8, 0}});
  bend(p, random, pelvis_rise, {{0, 0}, {0.2, -0.04}, {hit, -0.03}, {1, 0}});
  bend(p, random, torso_pitch, {{0, 0}, {0.3, -6}, {hit, 16}, {0.9, 0}});
  for (const Side side : {Side::left, Side::right}) {
    hold_arm(p, random, side, random.chance(0.5) ? ArmPlace::guard : ArmPlace::side, 0.3, 0.65);
  }
}

void squat(Performance& p, Random& random) {
  lower(p, random, random.uniform(0.3, 0.5), 0.42, 0.55);
  const ArmPlace place = random.chance(0.6) ? ArmPlace::reach_front : ArmPlace::across;
  for (const Side side : {Side::left, Side::right}) hold_arm(p, random, side, place, 0.4, 0.6);
}

void crouch(Performance& p, Random& random) {
  lower(p, random, random.uniform(0.35, 0.55), 0.3, 0.72);
  for (const Side side : {Side::left, Side::right}) busy_arm(p, random, side, 2);
  const double turn = random.uniform(-35, 35);
  bend(p, random, torso_twist, {{0, 0}, {0.4, turn}, {0.65, -0.5 * turn}, {1, 0}});
}

void jump(Performance& p, Random& random) {
  const double seconds = p.seconds();
  const double flight = random.uniform(0.36, seconds < 1.6 ? 0.38 : 0.52);
  const double landing = 0.42;  // seconds to come to rest after it
  const double up = std::min(random.uniform(0.42, 0.5) * seconds, seconds - flight - landing);
  const double down = up + flight;
  const double height = 9.81 * flight * flight / 8 / 0.85;  // of the ballistic arc, in legs
  const double far = random.chance(0.5) ? random.uniform(0.2, 0.7) : 0;
  const double dip = random.uniform(0.18, 0.3);
  const Key rise[] = {{0, 0},        {up - 0.28, -dip},        {up, 0.0},
                      {down, -0.02}, {down + 0.2, -0.7 * dip}, {seconds, 0}};
  p.add_keys(pelvis_rise, rise);
  for (long i = 0; i < p.samples(); ++i) {
    const double u = (static_cast<double>(i) / Performance::rate - up) / flight;
    const double forward = far * minimum_jerk(u);
    const double air = u > 0 && u < 1 ? 4 * height * u * (1 - u) : 0;
    p.tracks()(i, pelvis_rise) += air;
    p.tracks()(i, pelvis_z) += far * minimum_jerk((u + 0.3) / 1.6);
    for (const Side side : {Side::left, Side::right}) {
      p.tracks()(i, foot_track(side, foot_lift)) += air;
      p.tracks()(i, foot_track(side, foot_z)) += forward;
    }
  }
  const Key pitch[] = {{up - 0.15, 0}, {up + 0.02, 45}, {up + 0.6 * flight, 15}, {down + 0.02, 0}};
  const Key lean[] = {{0, 0}, {up - 0.28, 30}, {up, 2}, {down, 8}, {down + 0.2, 22}, {seconds, 0}};
  p.add_keys(torso_pitch, lean);
  for (const Side side : {Side::left, Side::right}) {
    p.add_keys(foot_track(side, foot_pitch), pitch);
    const ArmKey arms[] = {
        {0, arm_pose(ArmPlace::rest, random)},
        {up - 0.26, arm_pose(ArmPlace::behind, random)},
        {up + 0.08, arm_pose(random.chance(0.5) ? ArmPlace::overhead : ArmPlace::front, random)},
        {down + 0.15, arm_pose(ArmPlace::low_front, random)},
        {seconds, arm_pose(ArmPlace::rest, random)}};
    set_arm(p, side, arms);
  }
}

void reach_down(Performance& p, Random& random) {
  const Side side = random_side(random);
  lower(p, random, random.uniform(0.2, 0.42), 0.42, 0.56);
  const double deep = random.uniform(35, 55);
  bend(p, random, torso_pitch, {{0, 0}, {0.44, deep}, {0.56, deep}, {1, 0}});
  bend(p, random, torso_twist, {{0, 0}, {0.45, -12 * sign_of(side)}, {1, 0}});
  hold_arm(p, random, side, ArmPlace::reach_front, 0.42, 0.55);
  if (random.chance(0.6)) hold_arm(p, random, other(side), ArmPlace::hip, 0.35, 0.7);
}

void bow(Performance& p, Random& random) {
  const double deep = random.uniform(35, 70);
  bend(p, random, torso_pitch, {{0, 0}, {0.4, deep}, {0.6, deep}, {1, 0}});
  bend(p, random, pelvis_pitch, {{0, 0}, {0.4, 0.45 * deep}, {0.6, 0.45 * deep}, {1, 0}});
  bend(p, random, pelvis_z, {{0, 0}, {0.4, -0.0022 * deep}, {0.6, -0.0022 * deep}, {1, 0}});
  bend(p, random, head_pitch, {{0, 0}, {0.4, 0.2 * deep}, {0.6, 0.2 * deep}, {1, 0}});
  const ArmPlace places[] = {ArmPlace::low_front, ArmPlace::across, ArmPlace::behind,
                             ArmPlace::hip};
  const std::size_t choice = random.below(4),
                    second = random.chance(0.6) ? choice : random.below(4);
  hold_arm(p, random, Side::left, places[choice], 0.35, 0.65);
  hold_arm(p, random, Side::right, places[second], 0.35, 0.65);
}

void lunge(Performance& p, Random& random) {
  const Side leg = random_side(random);
  const double out = random.uniform(0.55, 0.85), seconds = p.seconds();
  const double aside = sign_of(leg) * random.uniform(0, 0.35);
  const TrackRow home = standing();
  const double x = home[foot_track(leg, foot_x)], z = home[foot_track(leg, foot_z)];
  apply_footsteps(p, {{leg, 0.12 * seconds, 0.36 * seconds, x + aside, z + out,
                       home[foot_track(leg, foot_yaw)], 0.09, 30, 10},
                      {leg, 0.64 * seconds, 0.88 * seconds, x, z, home[foot_track(leg, foot_yaw)],
                       0.08, 20, 0}});
  bend(p, random, foot_track(other(leg), foot_pitch), {{0.2, 0}, {0.42, 42}, {0.6, 42}, {0.85, 0}});
  bend(p, random, pelvis_z, {{0.05, 0}, {0.42, 0.55 * out}, {0.58, 0.55 * out}, {0.92, 0}});
  bend(p, random, pelvis_x,
       {{0.02, 0}, {0.14, over_foot(other(leg))}, {0.42, 0.5 * aside}, {0.6, 0.5 * aside}, {1, 0}});
  bend(p, random, pelvis_rise,
       {{0, 0}, {0.44, -random.uniform(0.2, 0.34)}, {0.58, -0.24}, {0.95, 0}});
  for (const Side side : {Side::left, Side::right}) busy_arm(p, random, side, 1);
}

void dance(Performance& p, Random& random) {
  const double frequency = random.uniform(0.8, 1.5), seconds = p.seconds();
  p.add_oscillation(pelvis_x, {0, seconds, frequency, random.uniform(0.04, 0.09), 0});
  p.add_oscillation(pelvis_roll, {0, seconds, frequency, random.uniform(3, 8), 0.2});
  p.add_oscillation(torso_twist,
                    {0, seconds, frequency, random.uniform(6, 16), random.uniform(0, 2)});
  bend(p, random, pelvis_rise, {{0, 0}, {0.15, -0.06}, {0.85, -0.06}, {1, 0}});
  p.add_oscillation(pelvis_rise, {0, seconds, 2 * frequency, random.uniform(0.02, 0.045), 1});
  for (const Side side : {Side::left, Side::right}) {
    busy_arm(p, random, side, 2);
    p.add_oscillation(arm_track(side, arm_y),
                      {0, seconds, frequency, random.uniform(8, 25), random.uniform(0, 6)});
    p.add_oscillation(arm_track(side, elbow),
                      {0, seconds, frequency, random.uniform(5, 12), random.uniform(0, 6)});
  }
}

void balance(Performance& p, Random& random) {
  const Side leg = random_side(random);
  const Side standing_leg = other(leg);
  const double height = random.uniform(0.2, 0.55), forward = random.uniform(-0.3, 0.3);
  bend(p, random, pelvis_x,
       {{0, 0}, {0.2, over_foot(standing_leg)}, {0.8, over_foot(standing_leg)}, {1, 0}});
  bend(p, random, pelvis_rise, {{0, 0}, {0.25, -0.03}, {0.75, -0.03}, {1, 0}});
  bend(p, random, foot_track(leg, foot_lift), {{0.16, 0}, {0.4, height}, {0.6, height}, {0.84, 0}});
  bend(p, random, foot_track(leg, foot_z), {{0.16, 0}, {0.4, forward}, {0.6, forward}, {0.84, 0}});
  bend(p, random, foot_track(leg, foot_pitch), {{0.12, 0}, {0.4, 30}, {0.6, 30}, {0.84, 0}});
  bend(p, random, torso_pitch,
       {{0, 0}, {0.4, forward < 0 ? 25.0 : 0.0}, {0.65, forward < 0 ? 25.0 : 0.0}, {1, 0}});
  for (const Side side : {Side::left, Side::right})
    hold_arm(p, random, side, ArmPlace::side, 0.3, 0.7);
}

}  // namespace reprise::synth
