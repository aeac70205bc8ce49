#include "synth/arm_poses.h"

#include <algorithm>

namespace reprise::synth {
namespace {

//                           clavicle y, z; arm x (turn), y (back), z (up); elbow; hand x, z
constexpr std::array<ArmPose, static_cast<std::size_t>(ArmPlace::count)> poses = {{
    {0, 0, 0, -4, -75, 15, 0, 0},       // rest
    {-4, 2, 10, -62, -25, 35, 0, 5},    // front
    {-8, 4, 0, -82, -8, 10, 0, 0},      // reach_front
    {0, 6, 0, -8, 2, 12, 0, 0},         // side
    {0, 14, -20, -28, 68, 18, 0, 0},    // overhead
    {0, 8, -75, -28, 12, 75, 0, 0},     // wave
    {-4, 2, 15, -40, -58, 115, 0, 0},   // guard
    {-10, 4, 10, -84, -6, 8, 0, 0},     // punch
    {-4, 4, 25, -55, -35, 125, 0, 10},  // face
    {4, 2, 50, 22, -48, 85, 0, -20},    // hip
    {6, 0, 10, 38, -62, 25, 0, 0},      // behind
    {-8, 2, 20, -98, -25, 55, 0, 0},    // across
    {-6, -2, 0, -35, -72, 12, 0, 0},    // low_front
}};
constexpr std::array<AngleLimits, arm_angles> limits = {
    {{-14, 14}, {-8, 20}, {-95, 75}, {-112, 48}, {-85, 85}, {4, 138}, {-60, 60}, {-50, 50}}};

}  // namespace

ArmPose arm_pose(ArmPlace place, Random& random, double spread) {
  ArmPose pose = poses[static_cast<std::size_t>(place)];
  for (std::size_t i = 0; i < pose.size(); ++i) {
    const double share = i < 2 ? 0.25 : 1.0;  // a clavicle moves less
    pose[i] =
        std::clamp(pose[i] + share * spread * random.gaussian(), limits[i].low, limits[i].high);
  }
  return pose;
}

ArmPose random_arm_pose(Random& random) {
  const std::size_t choice = 1 + random.below(static_cast<std::size_t>(ArmPlace::count) - 1);
  return arm_pose(static_cast<ArmPlace>(choice), random, 14);
}

void set_arm(Performance& performance, Side side, std::span<const ArmKey> keys) {
  std::vector<Key> curve(keys.size());
  for (int angle = 0; angle < arm_angles; ++angle) {
    for (std::size_t i = 0; i < keys.size(); ++i) {
      curve[i] = {keys[i].time, keys[i].pose[static_cast<std::size_t>(angle)]};
    }
    performance.set_keys(arm_track(side, clavicle_y) + angle, curve);
  }
}

}  // namespace reprise::synth
