#include "synth/behaviours.h"

#include <algorithm>
#include <initializer_list>

#include "synth/arm_poses.h"

namespace reprise::synth {
namespace {

Side random_side(Random& random) { return random.chance(0.5) ? Side::left : Side::right; }
double random_sign(Random& random) { return random.chance(0.5) ? 1 : -1; }
Side other(Side side) { return side == Side::left ? Side::right : Side::left; }
double sign_of(Side side) { return side == Side::left ? 1 : -1; }

/// add_keys with times as shares of the performance, each a little early or late.
void bend(Performance& performance, Random& random, int track, std::initializer_list<Key> keys) {
  std::vector<Key> curve;
  for (Key key : keys) {
    if (key.time > 0 && key.time < 1) key.time += random.uniform(-0.02, 0.02);
    curve.push_back({key.time * performance.seconds(), key.value});
  }
  performance.add_keys(track, curve);
}

/// Puts the weight on one foot: where the pelvis goes for it, in legs.
double over_foot(Side side) { return sign_of(side) * 0.8 * stance_half_width; }

/// An arm goes through `count` poses, from near rest and back to near rest.
void busy_arm(Performance& performance, Random& random, Side side, int count) {
  count = std::clamp(count, 1, static_cast<int>(performance.seconds() / 0.6));
  std::vector<ArmKey> keys = {{0, arm_pose(ArmPlace::rest, random)}};
  for (int i = 1; i <= count; ++i) {
    const double time = (i + random.uniform(-0.25, 0.25)) / (count + 1) * performance.seconds();
    keys.push_back({time, random_arm_pose(random)});
  }
  keys.push_back({performance.seconds(), arm_pose(ArmPlace::rest, random)});
  set_arm(performance, side, keys);
}

/// One place, held from a share of the time to another.
void hold_arm(Performance& performance, Random& random, Side side, ArmPlace place, double from,
              double to) {
  const double seconds = performance.seconds();
  const ArmPose pose = arm_pose(place, random);
  ArmPose late = pose;
  for (double& angle : late) angle += 3 * random.gaussian();
  const ArmKey keys[] = {{0, arm_pose(ArmPlace::rest, random)},
                         {from * seconds, pose},
                         {to * seconds, late},
                         {seconds, arm_pose(ArmPlace::rest, random)}};
  set_arm(performance, side, keys);
}

/// What everyone does besides: head and torso, and the arms that have nothing else to do.
void add_person(Performance& performance, Random& random, bool arms_are_free) {
  const double size[] = {6, 9, 5, 9, 16, 5};
  for (int i = 0; i < 6; ++i) {
    const double a = size[i] * random.gaussian() * 0.6;
    const double b = size[i] * random.gaussian() * 0.8;
    const double c = size[i] * random.gaussian() * 0.6;
    bend(performance, random, torso_pitch + i, {{0, 0}, {0.3, a}, {0.6, b}, {0.8, c}, {1, 0}});
  }
  if (!arms_are_free) return;
  for (const Side side : {Side::left, Side::right}) {
    if (random.chance(0.75))
      busy_arm(performance, random, side, 1 + static_cast<int>(random.below(2)));
  }
}

/// Feet a little wider, turned or apart, for as long as the performance lasts.
void set_stance(Performance& performance, Random& random) {
  const double wider = random.uniform(-0.03, 0.12), apart = random.uniform(-0.14, 0.14);
  for (const Side side : {Side::left, Side::right}) {
    const double sign = sign_of(side);
    performance.tracks().col(foot_track(side, foot_x)).array() += sign * wider;
    performance.tracks().col(foot_track(side, foot_z)).array() += sign * apart;
    performance.tracks().col(foot_track(side, foot_yaw)).array() += sign * random.uniform(-4, 14);
  }
}

void wave(Performance& p, Random& random, bool both) {
  const Side first = random_side(random);
  for (const Side side : {first, other(first)}) {
    if (side != first && !both) {
      if (random.chance(0.6)) busy_arm(p, random, side, 1);
      continue;
    }
    hold_arm(p, random, side, random.chance(0.7) ? ArmPlace::wave : ArmPlace::overhead, 0.25, 0.74);
    const double frequency = random.uniform(1.2, 2.6);
    const double from = 0.2 * p.seconds(), to = 0.82 * p.seconds();
    p.add_oscillation(arm_track(side, arm_x), {from, to, frequency, random.uniform(6, 16), 0});
    p.add_oscillation(arm_track(side, elbow), {from, to, frequency, random.uniform(8, 22), 0.5});
    p.add_oscillation(arm_track(side, hand_z), {from, to, frequency, random.uniform(8, 25), 1.1});
  }
}

void punch(Performance& p, Random& random) {
  const Side side = random_side(random);
  const double seconds = p.seconds();
  const double hit = random.uniform(0.35, 0.5), reach = random.uniform(0.10, 0.16);
  const ArmPose guard = arm_pose(ArmPlace::guard, random);
  std::vector<ArmKey> keys = {{0, guard},
                              {hit * seconds - reach, guard},
                              {hit * seconds + 0.05, arm_pose(ArmPlace::punch, random)},
                              {hit * seconds + 0.35, arm_pose(ArmPlace::guard, random)}};
  const double over = hit * seconds + 0.35;
  if (seconds - over > 0.8 && random.chance(0.5)) {
    keys.push_back({0.5 * (over + seconds), arm_pose(ArmPlace::across, random)});
  }
  keys.push_back(
      {seconds, arm_pose(seconds - over > 0.4 ? ArmPlace::rest : ArmPlace::guard, random)});
  set_arm(p, side, keys);
  hold_arm(p, random, other(side), ArmPlace::guard, 0.25, 0.65);
  const double twist = -sign_of(side) * random.uniform(15, 30);
  bend(p, random, torso_twist,
       {{0, 0}, {hit - 0.15, -0.6 * twist}, {hit + 0.02, twist}, {0.8, 0.3 * twist}, {1, 0}});
  bend(p, random, pelvis_z, {{0, 0}, {hit - 0.15, -0.05}, {hit + 0.03, 0.09}, {1, 0}});
  bend(p, random, pelvis_rise, {{0, 0}, {hit - 0.1, -0.05}, {0.85, -0.04}, {1, 0}});
}

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

void lower(Performance& p, Random& random, double depth, double from, double to) {
  bend(p, random, pelvis_rise,
       {{0, 0}, {from, -depth}, {to, -depth * random.uniform(0.9, 1)}, {1, 0}});
  bend(p, random, pelvis_z, {{0, 0}, {from, -0.32 * depth}, {to, -0.32 * depth}, {1, 0}});
  const double lean = random.uniform(50, 75) * depth;
  bend(p, random, torso_pitch, {{0, 0}, {from, lean}, {to, lean}, {1, 0}});
  bend(p, random, pelvis_pitch, {{0, 0}, {from, 0.4 * lean}, {to, 0.4 * lean}, {1, 0}});
  bend(p, random, head_pitch, {{0, 0}, {from, -0.6 * lean}, {to, -0.6 * lean}, {1, 0}});
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

void reach_up(Performance& p, Random& random) {
  const Side side = random_side(random);
  hold_arm(p, random, side, ArmPlace::overhead, 0.4, 0.62);
  if (random.chance(0.4)) {
    hold_arm(p, random, other(side), ArmPlace::overhead, 0.45, 0.65);
  } else {
    busy_arm(p, random, other(side), 1);
  }
  const double heel = random.uniform(0, 35);
  for (const Side foot : {Side::left, Side::right}) {
    bend(p, random, foot_track(foot, foot_pitch), {{0.2, 0}, {0.42, heel}, {0.6, heel}, {0.85, 0}});
  }
  bend(p, random, pelvis_rise, {{0.2, 0}, {0.42, heel * 0.0025}, {0.6, heel * 0.0025}, {0.85, 0}});
  bend(p, random, torso_side, {{0, 0}, {0.45, sign_of(side) * random.uniform(0, 18)}, {1, 0}});
  bend(p, random, head_pitch, {{0, 0}, {0.4, -28}, {0.65, -28}, {1, 0}});
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

void arm_circles(Performance& p, Random& random) {
  const double frequency = random.uniform(0.6, 1.3), up = random.uniform(25, 55),
               back = random.uniform(20, 40);
  const bool together = random.chance(0.6);
  for (const Side side : {Side::left, Side::right}) {
    if (!together && side == Side::left) {
      busy_arm(p, random, side, 1);
      continue;
    }
    hold_arm(p, random, side, ArmPlace::side, 0.18, 0.76);
    const double from = 0.1 * p.seconds(), to = 0.93 * p.seconds();
    p.add_oscillation(arm_track(side, arm_z), {from, to, frequency, up, 0});
    p.add_oscillation(arm_track(side, arm_y), {from, to, frequency, back, 0.5 * pi});
  }
  p.add_oscillation(pelvis_rise, {0, p.seconds(), frequency, 0.015, 0});
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

void throw_ball(Performance& p, Random& random) {
  const Side side = random_side(random);
  const Side front = other(side);
  const double seconds = p.seconds(), out = random.uniform(0.3, 0.55);
  const TrackRow home = standing();
  const double x = home[foot_track(front, foot_x)], z = home[foot_track(front, foot_z)];
  apply_footsteps(p, {{front, 0.2 * seconds, 0.42 * seconds, x, z + out,
                       home[foot_track(front, foot_yaw)], 0.1, 25, 8},
                      {front, 0.72 * seconds, 0.93 * seconds, x, z,
                       home[foot_track(front, foot_yaw)], 0.06, 20, 0}});
  bend(p, random, pelvis_z,
       {{0, 0}, {0.25, -0.05}, {0.55, 0.6 * out}, {0.7, 0.6 * out}, {0.98, 0}});
  bend(p, random, pelvis_x, {{0, 0}, {0.2, over_foot(side)}, {0.5, 0}, {1, 0}});
  const double twist = sign_of(side) * random.uniform(22, 38);
  bend(p, random, torso_twist,
       {{0, 0}, {0.35, twist}, {0.55, -0.9 * twist}, {0.7, -twist}, {1, 0}});
  bend(p, random, torso_pitch, {{0, 0}, {0.35, -8}, {0.6, 22}, {1, 0}});
  ArmPose cocked = arm_pose(ArmPlace::wave, random);
  cocked[arm_y] += 35;
  const ArmKey keys[] = {{0, arm_pose(ArmPlace::rest, random)},
                         {0.34 * seconds, cocked},
                         {0.46 * seconds, arm_pose(ArmPlace::overhead, random)},
                         {0.56 * seconds, arm_pose(ArmPlace::reach_front, random)},
                         {0.7 * seconds, arm_pose(ArmPlace::across, random)},
                         {seconds, arm_pose(ArmPlace::rest, random)}};
  set_arm(p, side, keys);
  hold_arm(p, random, front, ArmPlace::front, 0.35, 0.48);
}

void clap(Performance& p, Random& random) {
  const double frequency = random.uniform(1.0, 2.4), open = random.uniform(12, 24);
  const ArmPlace place = random.chance(0.6) ? ArmPlace::front : ArmPlace::overhead;
  for (const Side side : {Side::left, Side::right}) {
    hold_arm(p, random, side, place, 0.2, 0.76);
    p.add_oscillation(arm_track(side, arm_y),
                      {0.15 * p.seconds(), 0.9 * p.seconds(), frequency, open, 0});
    p.add_oscillation(arm_track(side, arm_x),
                      {0.15 * p.seconds(), 0.9 * p.seconds(), frequency, 0.6 * open, 0.3});
  }
}

void swing(Performance& p, Random& random) {
  const Side back = random_side(random);
  const double seconds = p.seconds(), twist = sign_of(back) * random.uniform(25, 42);
  bend(p, random, torso_twist, {{0, 0}, {0.4, twist}, {0.5, 0.8 * twist}, {0.66, -twist}, {1, 0}});
  bend(p, random, pelvis_yaw, {{0, 0}, {0.42, 0.5 * twist}, {0.62, -0.7 * twist}, {1, 0}});
  bend(p, random, pelvis_x,
       {{0, 0}, {0.4, 0.5 * over_foot(back)}, {0.62, 0.6 * over_foot(other(back))}, {1, 0}});
  bend(p, random, torso_pitch, {{0, 0}, {0.3, 18}, {0.6, 14}, {1, 0}});
  bend(p, random, pelvis_rise, {{0, 0}, {0.35, -0.06}, {0.6, -0.03}, {1, 0}});
  const bool high = random.chance(0.5);
  for (const Side side : {Side::left, Side::right}) {
    const bool is_back = side == back;
    const ArmKey keys[] = {
        {0, arm_pose(ArmPlace::low_front, random)},
        {0.42 * seconds,
         arm_pose(is_back ? (high ? ArmPlace::wave : ArmPlace::side) : ArmPlace::across, random)},
        {0.56 * seconds, arm_pose(ArmPlace::low_front, random)},
        {0.7 * seconds, arm_pose(is_back ? ArmPlace::across : ArmPlace::side, random)},
        {seconds, arm_pose(ArmPlace::rest, random)}};
    set_arm(p, side, keys);
  }
}

void stretch(Performance& p, Random& random) {
  const double way = random_sign(random);
  const double lean = way * random.uniform(18, 34);
  bend(p, random, torso_side, {{0, 0}, {0.32, lean}, {0.5, 0.2 * lean}, {0.72, -lean}, {1, 0}});
  bend(p, random, pelvis_x, {{0, 0}, {0.32, 0.0022 * lean}, {0.72, -0.0022 * lean}, {1, 0}});
  hold_arm(p, random, Side::left, ArmPlace::overhead, 0.25, 0.8);
  hold_arm(p, random, Side::right, random.chance(0.6) ? ArmPlace::overhead : ArmPlace::hip, 0.25,
           0.8);
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

/// Steps that take about `seconds`.
int step_count(const GaitStyle& style, double seconds) {
  return std::max(3, static_cast<int>((seconds - 0.48) / style.step_seconds));
}

Performance perform_stepping(Behaviour behaviour, Random& random, double seconds) {
  GaitStyle style =
      behaviour == Behaviour::run ? random_run_style(random) : random_walk_style(random);
  double turn = random.uniform(-70, 70);
  double direction = 0;
  if (behaviour == Behaviour::turn) {
    style.step_length = 0;
    turn = random_sign(random);
    turn *= random.uniform(90, 220);
  } else if (behaviour == Behaviour::side_steps) {
    style.step_length = random.uniform(0.2, 0.36);
    direction = random.chance(0.5) ? 90 : -90;
    turn = random.uniform(-20, 20);
  } else if (behaviour == Behaviour::march) {
    style.step_length = random.uniform(0, 0.3);
    style.lift = random.uniform(0.25, 0.45);
    style.arm_swing = 60;
    turn = random.uniform(-120, 120);
  }
  const int steps = std::max(step_count(style, seconds), behaviour == Behaviour::turn ? 4 : 3);
  Performance p = perform_steps(style, steps, turn, direction, random_side(random));
  if (behaviour != Behaviour::run && random.chance(0.5))
    busy_arm(p, random, random_side(random), 2);
  return p;
}

void perform_standing(Performance& p, Behaviour behaviour, Random& random) {
  switch (behaviour) {
    case Behaviour::wave:
      return wave(p, random, false);
    case Behaviour::wave_both:
      return wave(p, random, true);
    case Behaviour::punch:
      return punch(p, random);
    case Behaviour::kick:
      return kick(p, random);
    case Behaviour::squat:
      return squat(p, random);
    case Behaviour::crouch:
      return crouch(p, random);
    case Behaviour::jump:
      return jump(p, random);
    case Behaviour::reach_down:
      return reach_down(p, random);
    case Behaviour::reach_up:
      return reach_up(p, random);
    case Behaviour::bow:
      return bow(p, random);
    case Behaviour::arm_circles:
      return arm_circles(p, random);
    case Behaviour::lunge:
      return lunge(p, random);
    case Behaviour::throw_ball:
      return throw_ball(p, random);
    case Behaviour::clap:
      return clap(p, random);
    case Behaviour::swing:
      return swing(p, random);
    case Behaviour::stretch:
      return stretch(p, random);
    case Behaviour::dance:
      return dance(p, random);
    case Behaviour::balance:
      return balance(p, random);
    default:
      for (const Side side : {Side::left, Side::right}) busy_arm(p, random, side, 3);
  }
}

bool is_stepping(Behaviour behaviour) {
  return behaviour == Behaviour::turn || behaviour == Behaviour::side_steps ||
         behaviour == Behaviour::march || behaviour == Behaviour::walk ||
         behaviour == Behaviour::run;
}

}  // namespace

Performance perform(Behaviour behaviour, Random& random, double most_seconds) {
  const double most = std::max(1.2, most_seconds);
  double shortest = std::min(1.7, most);
  if (behaviour == Behaviour::punch) shortest = 1.0;
  if (behaviour == Behaviour::jump) shortest = 1.6;
  const double seconds = random.uniform(shortest, std::max(shortest, most - 0.2));
  Performance p(seconds);
  if (is_stepping(behaviour)) {
    p = perform_stepping(behaviour, random, seconds);
    add_person(p, random, false);
  } else {
    add_person(p, random, true);
    perform_standing(p, behaviour, random);
    p.smooth(pelvis_x, foot_tracks, 0.05);
    set_stance(p, random);
  }
  p.smooth(torso_pitch, track_count, 0.035);
  return p;
}

Performance perform_idle(double seconds, Random& random) {
  Performance p(seconds);
  const double slow = random.uniform(0.12, 0.25);
  p.add_oscillation(pelvis_x, {0, seconds, slow, random.uniform(0.01, 0.05), random.uniform(0, 6)});
  p.add_oscillation(pelvis_z,
                    {0, seconds, slow * 1.7, random.uniform(0.004, 0.012), random.uniform(0, 6)});
  p.add_oscillation(pelvis_roll,
                    {0, seconds, slow, random.uniform(0.5, 2.5), random.uniform(0, 6)});
  p.add_oscillation(torso_pitch, {0, seconds, 0.27, random.uniform(0.5, 1.5), 0});  // breathing
  p.add_oscillation(torso_twist,
                    {0, seconds, slow * 0.8, random.uniform(2, 8), random.uniform(0, 6)});
  p.add_oscillation(head_twist,
                    {0, seconds, slow * 1.3, random.uniform(5, 25), random.uniform(0, 6)});
  p.add_oscillation(head_pitch,
                    {0, seconds, slow * 1.1, random.uniform(2, 8), random.uniform(0, 6)});
  for (const Side side : {Side::left, Side::right}) {
    if (seconds > 1.8 && random.chance(0.3))
      hold_arm(p, random, side, random.chance(0.5) ? ArmPlace::hip : ArmPlace::across, 0.25, 0.75);
    p.add_oscillation(arm_track(side, arm_y),
                      {0, seconds, slow, random.uniform(1, 5), random.uniform(0, 6)});
    p.add_oscillation(arm_track(side, elbow),
                      {0, seconds, slow * 1.4, random.uniform(1, 6), random.uniform(0, 6)});
  }
  return p;
}

}  // namespace reprise::synth
