#include "ingest/channel_weights.h"

#include <algorithm>
#include <cmath>

namespace reprise {
namespace {

using Eigen::Vector3d;

/// Places of the joints at rest, mm, relative to the first.
std::vector<Vector3d> rest_places(const MarkerLayout& layout) {
  std::vector<Vector3d> places(layout.offsets.size(), Vector3d::Zero());
  for (std::size_t j = 1; j < places.size(); ++j) {
    const int parent = layout.reference.joints[j].parent;
    places[j] = (parent >= 0 ? places[parent] : Vector3d::Zero()) + layout.offsets[j];
  }
  return places;
}

/// How far all points together move for one unit of a channel of joint `j` (root of the sum of
/// squares).
double channel_weight(const MarkerLayout& layout, const std::vector<Vector3d>& places, int j,
                      Channel channel) {
  const std::vector<bool> moved = joints_under(layout.reference, j);
  const bool above_root = layout.root_aligned && !layout.under_root[j];
  double squares = 0;
  for (std::size_t k = 0; k < places.size(); ++k) {
    // Above the aligned root, whose place in the world is coded by itself, only the other points
    // move.
    if (!moved[k] || (above_root && layout.under_root[k])) continue;
    squares += is_rotation(channel) ? (places[k] - places[j]).squaredNorm() : 1.0;
  }
  const double least = is_rotation(channel) ? MarkerConstants::off_bone_mm : 1.0;
  return std::max(std::sqrt(squares), least);
}

void list_direct_channels(MarkerLayout& layout, const std::vector<Vector3d>& places) {
  const Skeleton& skeleton = layout.reference;
  std::vector<bool> through_markers(skeleton.channel_count, false);
  for (const DrivenJoint& driven : layout.driven) {
    for (const RotationChannel& rotation : driven.rotations) {
      if (rotation.active) through_markers[rotation.channel] = true;
    }
  }
  for (const int channel : layout.root_channels) through_markers[channel] = true;
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    const Joint& joint = skeleton.joints[j];
    for (std::size_t c = 0; c < joint.channels.size(); ++c) {
      const int channel = joint.first_channel + static_cast<int>(c);
      if (through_markers[channel]) continue;
      layout.direct_channels.push_back(channel);
      layout.direct_weight.push_back(
          channel_weight(layout, places, static_cast<int>(j), joint.channels[c]));
    }
  }
}

}  // namespace

std::vector<bool> joints_under(const Skeleton& skeleton, int root) {
  std::vector<bool> under(skeleton.joints.size(), false);
  for (std::size_t j = 0; j < under.size(); ++j) {
    const int parent = skeleton.joints[j].parent;
    under[j] = static_cast<int>(j) == root || (parent >= 0 && under[parent]);
  }
  return under;
}

void weigh_channels(MarkerLayout& layout) {
  const std::vector<Vector3d> places = rest_places(layout);
  list_direct_channels(layout, places);
  double points = 0, squares = 0;
  for (std::size_t j = 0; j < places.size(); ++j) {
    if (!layout.under_root[j]) continue;
    ++points;
    // A radian of heading moves a point by its distance from the vertical axis; half the squared
    // distance at rest is what the three axes give on average.
    squares += 0.5 * (places[j] - places[layout.choices.root_joint]).squaredNorm();
  }
  layout.point_count = points;
  layout.heading_weight_mm = std::max(std::sqrt(squares), MarkerConstants::off_bone_mm);
}

}  // namespace reprise
