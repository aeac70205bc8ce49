#include <vector>

#include "synth/footsteps.h"
#include "synth/gesture_parts.h"
#include "synth/gestures.h"

namespace reprise::synth {

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

}  // namespace reprise::synth
