// A take summed up in a few poses.
#pragma once

#include <vector>

#include "reprise/model/take.h"
#include "reprise/query/body_joints.h"

namespace reprise {

/// A run of similar postures, and the time in it when the posture is nearest to their mean;
/// seconds.
struct KeyPose {
  double start = 0;
  double end = 0;  ///< where the next one starts
  double time = 0;
};

/// The partition of a take into `count` runs (fewer for a shorter take) with the least squared
/// distance of postures to the mean of their run: Fisher's optimal partition, exact over postures
/// at 10 Hz, or for a long take at as many times as 1500. The take has at least one frame.
std::vector<KeyPose> key_poses(const Take& take, const JointMap& map = {}, int count = 8);

}  // namespace reprise
