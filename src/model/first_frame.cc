#include "model/first_frame.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "model/rotation_distance.h"
#include "reprise/model/kinematics.h"

namespace reprise {
namespace {

using Eigen::Index;
using Constants = FirstFrameConstants;

/// How far a pose moves from one frame to the next.
struct Step {
  double degrees = 0;  ///< of the joint that turns most against its parent
  double mm = 0;       ///< of the first joint that has position channels

  bool far_beyond(const Step& other) const {
    return degrees > std::max(Constants::least_degrees, Constants::times_more * other.degrees) ||
           mm > std::max(Constants::least_mm, Constants::times_more * other.mm);
  }
};

Step step_from(const Take& take, Index f) {
  const auto count = static_cast<std::size_t>(take.channels.cols());
  const std::span<const double> a(take.channels.row(f).data(), count);
  const std::span<const double> b(take.channels.row(f + 1).data(), count);
  Step step;
  bool carried = false;
  for (const Joint& joint : take.skeleton->joints) {
    if (!joint.rotation_order.empty()) {
      step.degrees = std::max(step.degrees,
                              degrees_between(local_rotation(joint, a), local_rotation(joint, b)));
    }
    if (carried || !std::ranges::any_of(joint.channels, is_position)) continue;
    const JointFrame world;
    const Eigen::Vector3d way = place_joint(*take.skeleton, joint, b, world).position -
                                place_joint(*take.skeleton, joint, a, world).position;
    step.mm = std::max(step.mm, way.norm());
    // A joint that carries nothing, as a fixed root above the hips, is followed by one that does.
    carried = step.mm > 0;
  }
  return step;
}

}  // namespace

bool first_frame_is_apart(const Take& take) {
  if (take.frames() < Constants::least_frames) return false;
  const Step first = step_from(take, 0);
  if (!first.far_beyond({})) return false;
  const long compared = std::max(2L, std::lround(Constants::compared_s * take.frame_rate));
  Step most;
  for (Index f = 1; f + 1 < take.frames() && f <= compared; ++f) {
    const Step step = step_from(take, f);
    most.degrees = std::max(most.degrees, step.degrees);
    most.mm = std::max(most.mm, step.mm);
  }
  return first.far_beyond(most);
}

}  // namespace reprise
