#include "synth/gesture_parts.h"

#include <algorithm>

namespace reprise::synth {

Side random_side(Random& random) { return random.chance(0.5) ? Side::left : Side::right; }

double random_sign(Random& random) { return random.chance(0.5) ? 1 : -1; }

void bend(Performance& performance, Random& random, int track, std::initializer_list<Key> keys) {
  std::vector<Key> curve;
  for (Key key : keys) {
    if (key.time > 0 && key.time < 1) key.time += random.uniform(-0.02, 0.02);
    curve.push_back({key.time * performance.seconds(), key.value});
  }
  performance.add_keys(track, curve);
}

double over_foot(Side side) { return sign_of(side) * 0.8 * stance_half_width; }

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

void set_stance(Performance& performance, Random& random) {
  const double wider = random.uniform(-0.03, 0.12), apart = random.uniform(-0.14, 0.14);
  for (const Side side : {Side::left, Side::right}) {
    const double sign = sign_of(side);
    performance.tracks().col(foot_track(side, foot_x)).array() += sign * wider;
    performance.tracks().col(foot_track(side, foot_z)).array() += sign * apart;
    performance.tracks().col(foot_track(side, foot_yaw)).array() += sign * random.uniform(-4, 14);
  }
}

}  // namespace reprise::synth
