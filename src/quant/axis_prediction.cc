#include "quant/axis_prediction.h"

#include <algorithm>
#include <cassert>

namespace reprise {
namespace {

using Constants = AxisPredictionConstants;

MarkerEntries cross(const MarkerEntries& a, const MarkerEntries& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace

AxisPredictor::AxisPredictor(const MarkerLayout& layout, std::span<const std::int32_t> mean) {
  const std::vector<Joint>& joints = layout.reference.joints;
  for (const Joint& joint : joints) parents_.push_back(joint.parent);
  std::vector<int> marker_at(joints.size(), -1);
  std::vector<bool> has_marker(joints.size(), false);
  const auto mean_of = [&](int marker, std::size_t axis) -> std::int64_t {
    return mean.empty() ? 0 : mean[3 * static_cast<std::size_t>(marker) + axis];
  };
  assert(mean.empty() || mean.size() == 3 * layout.markers.size());
  for (int m = 0; m < static_cast<int>(layout.markers.size()); ++m) {
    const Marker& marker = layout.markers[static_cast<std::size_t>(m)];
    const auto joint = static_cast<std::size_t>(marker.joint);
    Part part;
    part.body = marker.off_bone ? marker.joint : parents_[joint];
    for (int j = part.body; !marker.off_bone && j >= 0 && part.anchor < 0;
         j = parents_[static_cast<std::size_t>(j)]) {
      part.anchor = marker_at[static_cast<std::size_t>(j)];
    }
    part.neighbour = marker.off_bone ? m - 1 : part.anchor;
    part.kind = marker.off_bone ? 2 : 0;
    if (part.body >= 0) {
      const auto body = static_cast<std::size_t>(part.body);
      part.kind += has_marker[body] ? 1 : 0;
      has_marker[body] = true;
    }
    for (std::size_t a = 0; a < 3; ++a) {
      const std::int64_t from = part.anchor < 0 ? 0 : mean_of(part.anchor, a);
      part.arm[a] = std::clamp(mean_of(m, a) - from, -Constants::most_arm, Constants::most_arm);
    }
    if (!marker.off_bone && marker_at[joint] < 0) marker_at[joint] = m;
    parts_.push_back(part);
  }
  entries_.resize(parts_.size());
  begin();
}

void AxisPredictor::begin() {
  turns_.assign(parents_.size(), {});
  turns_known_.assign(parents_.size(), false);
}

/// A body of which nothing is known turns as the one that carries it.
MarkerEntries& AxisPredictor::turn_of(int body) {
  const auto own = static_cast<std::size_t>(body);
  if (!turns_known_[own]) {
    int above = parents_[own];
    while (above >= 0 && !turns_known_[static_cast<std::size_t>(above)])
      above = parents_[static_cast<std::size_t>(above)];
    if (above >= 0) turns_[own] = turns_[static_cast<std::size_t>(above)];
    turns_known_[own] = true;
  }
  return turns_[own];
}

AxisPredictor::Foretold AxisPredictor::foretell(std::size_t marker) {
  const Part& part = parts_[marker];
  Foretold foretold;
  if (part.anchor >= 0) foretold.base = entries_[static_cast<std::size_t>(part.anchor)];
  if (part.body >= 0) foretold.turn = cross(turn_of(part.body), part.arm);
  return foretold;
}

/// The least change of the body's turn that explains where the marker went.
void AxisPredictor::learn(std::size_t marker, const MarkerEntries& entries) {
  const Foretold foretold = foretell(marker);
  entries_[marker] = entries;
  const Part& part = parts_[marker];
  if (part.body < 0) return;
  MarkerEntries missed;
  std::int64_t squared = Constants::arm_noise;
  for (std::size_t a = 0; a < 3; ++a) {
    missed[a] = (entries[a] - foretold.base[a]) * (std::int64_t{1} << Constants::turn_bits) -
                foretold.turn[a];
    squared += part.arm[a] * part.arm[a];
  }
  const MarkerEntries change = cross(part.arm, missed);
  MarkerEntries& turn = turn_of(part.body);
  for (std::size_t a = 0; a < 3; ++a) {
    turn[a] =
        std::clamp(turn[a] + change[a] / squared, -Constants::most_turn, Constants::most_turn);
  }
}

}  // namespace reprise
