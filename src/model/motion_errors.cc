// How far the places and turns of a motion are from those of another.
#include <algorithm>
#include <numeric>

#include "model/rotation_distance.h"
#include "reprise/model/measure.h"

namespace reprise {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;

std::span<const double> frame_of(const ChannelMatrix& channels, Index f) {
  return {channels.row(f).data(), static_cast<std::size_t>(channels.cols())};
}

/// A joint's rotation against its parent's.
Matrix3d local_turn(const Skeleton& skeleton, const std::vector<JointFrame>& frames,
                    std::size_t joint) {
  const int parent = skeleton.joints[joint].parent;
  if (parent < 0) return frames[joint].rotation;
  return frames[static_cast<std::size_t>(parent)].rotation.transpose() * frames[joint].rotation;
}

JointAt place_of_greatest(const std::vector<float>& values, std::size_t joints) {
  if (values.empty()) return {};
  const auto at = static_cast<std::size_t>(std::ranges::max_element(values) - values.begin());
  return {static_cast<int>(at % joints), static_cast<long>(at / joints)};
}

}  // namespace

MotionDistances motion_distances(const Skeleton& skeleton, const ChannelMatrix& original,
                                 const ChannelMatrix& decoded, bool local_turns,
                                 const Skeleton* other) {
  const Skeleton& decoded_skeleton = other == nullptr ? skeleton : *other;
  const Index frames = std::min(original.rows(), decoded.rows());
  const std::size_t joints = skeleton.joints.size();
  std::vector<JointFrame> a(joints), b(joints);
  MotionDistances distances;
  distances.places.reserve(static_cast<std::size_t>(frames) * joints);
  distances.turns.reserve(distances.places.capacity());
  for (Index f = 0; f < frames; ++f) {
    forward_kinematics(skeleton, frame_of(original, f), a);
    forward_kinematics(decoded_skeleton, frame_of(decoded, f), b);
    for (std::size_t j = 0; j < joints; ++j) {
      distances.places.push_back(static_cast<float>((a[j].position - b[j].position).norm()));
      distances.turns.push_back(static_cast<float>(degrees_between(a[j].rotation, b[j].rotation)));
      if (!local_turns) continue;
      distances.local_turns.push_back(static_cast<float>(
          degrees_between(local_turn(skeleton, a, j), local_turn(decoded_skeleton, b, j))));
    }
  }
  return distances;
}

RotationErrors summarise_turns(std::vector<float>& turns) {
  const PositionErrors as_distances = summarise_distances(turns);
  return {as_distances.mean, as_distances.p99, as_distances.max};
}

MotionErrors summarise_motion(MotionDistances& distances, std::size_t joints) {
  MotionErrors errors;
  errors.worst_place = place_of_greatest(distances.places, joints);
  errors.worst_turn = place_of_greatest(distances.turns, joints);
  errors.places = summarise_distances(distances.places);
  errors.turns = summarise_turns(distances.turns);
  return errors;
}

}  // namespace reprise
